#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

// Each file adds its part to the module.
void BindSequence(pybind11::module_& module);
void BindSkeleton(pybind11::module_& module);
void BindMesh(pybind11::module_& module);
void BindReconstruction(pybind11::module_& module);

/// Numbers as Python gives them: any array or nested sequence.
using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// The rows of an (N, 3) array. Throws Error(kUsage) for another shape; `name` is the argument.
std::vector<Vec3> Points(const Numbers& array, const std::string& name);

/// A text of the library. File names in it need not be UTF-8: other bytes become surrogates, as
/// Python does with file names.
pybind11::str Text(const std::string& text);
pybind11::list Texts(const std::vector<std::string>& texts);

/// The value of a text in JSON.
pybind11::object FromJson(const std::string& text);

/// Motions as an (N, 4, 4) array, or one as (4, 4).
pybind11::array Matrices(const std::vector<RigidTransform>& motions);
pybind11::array Matrix(const RigidTransform& motion);

/// A graph as the module holds it: its handles count up from 0 in the order of the given one.
/// It does not change any more, so arrays may refer to its memory.
std::shared_ptr<SkeletonGraph> Shared(const SkeletonGraph& graph);

/// Throws Error(kUsage) where the argument is not within [min, max].
void RequireWithin(const std::string& name, double value, double min, double max);

/// An array over memory that `owner` keeps, not writable. No copy.
template <class T>
pybind11::array View(const T* data, std::vector<pybind11::ssize_t> shape,
                     const pybind11::object& owner) {
  pybind11::array_t<T> array(std::move(shape), data, owner);
  pybind11::detail::array_proxy(array.ptr())->flags &=
      ~pybind11::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// Points as an (N, 3) array over memory that `owner` keeps.
inline pybind11::array PointView(const std::vector<Vec3>& points, const pybind11::object& owner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return View(points.empty() ? nullptr : points.front().data(),
              {static_cast<pybind11::ssize_t>(points.size()), 3}, owner);
}

/// Values as an (N,) array over memory that `owner` keeps; None where there are none.
inline pybind11::object ValueView(const std::vector<double>& values,
                                  const pybind11::object& owner) {
  if (values.empty()) return pybind11::none();
  return View(values.data(), {static_cast<pybind11::ssize_t>(values.size())}, owner);
}

}  // namespace curvefusion
