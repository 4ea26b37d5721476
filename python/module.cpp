// The exceptions of the module, what its parts share, and the module itself.
#include <fmt/format.h>

#include <exception>
#include <system_error>
#include <utility>

#include "kernel/error.h"
#include "python/bindings.h"

namespace curvefusion {

namespace py = pybind11;

namespace {

// Handles of classes that live as long as the interpreter.
struct ErrorClasses {
  PyObject* any = nullptr;
  PyObject* usage = nullptr;
  PyObject* bad_input = nullptr;
  PyObject* resource = nullptr;
};
ErrorClasses error_classes;

PyObject* AddError(py::module_& module, const char* name, const py::tuple& bases,
                   const char* docs) {
  const std::string full_name = std::string("curvefusion.") + name;
  PyObject* type = PyErr_NewExceptionWithDoc(full_name.c_str(), docs, bases.ptr(), nullptr);
  if (type == nullptr) throw py::error_already_set();
  module.add_object(name, type);
  return type;
}

PyObject* ErrorClass(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return error_classes.usage;
    case ErrorKind::kBadInput:
      return error_classes.bad_input;
    case ErrorKind::kResource:
      return error_classes.resource;
    default:
      return error_classes.any;
  }
}

void Raise(PyObject* type, const std::string& message) {
  PyErr_SetObject(type, Text(message).ptr());
}

// Lacks of memory become Python's MemoryError without this.
void Translate(std::exception_ptr failure) {
  try {
    std::rethrow_exception(std::move(failure));
  } catch (const Error& error) {
    Raise(ErrorClass(error.kind()), error.what());
  } catch (const std::system_error& error) {
    Raise(error_classes.resource, error.what());
  }
}

void BindErrors(py::module_& module) {
  const py::handle exception(PyExc_Exception);
  const py::handle value_error(PyExc_ValueError);
  error_classes.any =
      AddError(module, "Error", py::make_tuple(exception),
               "Base class of the errors of this module.\n\n"
               "The message names the file, the frame or the value and what to do.");
  const py::handle any(error_classes.any);
  error_classes.usage = AddError(module, "UsageError", py::make_tuple(any, value_error),
                                 "An argument or a setting that cannot be.");
  error_classes.bad_input = AddError(module, "BadInputError", py::make_tuple(any, value_error),
                                     "A file, a scan or a graph that cannot be used.");
  error_classes.resource = AddError(module, "ResourceError", py::make_tuple(any),
                                    "Out of disk or threads, or a place that cannot be written.");
  py::register_exception_translator(Translate);
}

py::array_t<double> EmptyMatrices(std::vector<py::ssize_t> shape) {
  return py::array_t<double>(std::move(shape));
}

void CopyMatrix(const RigidTransform& motion, double* target) {
  Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(target);
  matrix = motion.matrix();
}

std::string ShapeText(const Numbers& array) {
  return py::str(array.attr("shape")).cast<std::string>();
}

}  // namespace

std::vector<Vec3> Points(const Numbers& array, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) != 3) {
    throw Error(ErrorKind::kUsage, fmt::format("{}: has shape {}; it must be (N, 3), in metres",
                                               name, ShapeText(array)));
  }
  std::vector<Vec3> points(static_cast<size_t>(array.shape(0)));
  for (size_t i = 0; i < points.size(); ++i) {
    points[i] = Eigen::Map<const Vec3>(array.data(static_cast<py::ssize_t>(i), 0));
  }
  return points;
}

py::str Text(const std::string& text) {
  PyObject* decoded =
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape");
  if (decoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::list Texts(const std::vector<std::string>& texts) {
  py::list list;
  for (const std::string& text : texts) list.append(Text(text));
  return list;
}

py::object FromJson(const std::string& text) {
  return py::module_::import("json").attr("loads")(Text(text));
}

py::array Matrices(const std::vector<RigidTransform>& motions) {
  const auto count = static_cast<py::ssize_t>(motions.size());
  py::array_t<double> array = EmptyMatrices({count, 4, 4});
  for (py::ssize_t i = 0; i < count; ++i) {
    CopyMatrix(motions[static_cast<size_t>(i)], array.mutable_data(i, 0, 0));
  }
  return array;
}

py::array Matrix(const RigidTransform& motion) {
  py::array_t<double> array = EmptyMatrices({4, 4});
  CopyMatrix(motion, array.mutable_data());
  return array;
}

std::shared_ptr<SkeletonGraph> Shared(const SkeletonGraph& graph) {
  auto shared = std::make_shared<SkeletonGraph>();
  const std::vector<NodeId> nodes = graph.Nodes();
  shared->Reserve(nodes.size(), static_cast<size_t>(graph.edge_count()));
  std::vector<NodeId> renumbered(nodes.empty() ? 0 : static_cast<size_t>(nodes.back()) + 1);
  for (const NodeId node : nodes) renumbered[node] = shared->AddNode(graph.position(node));
  for (const EdgeId id : graph.Edges()) {
    SkeletonEdge edge = graph.edge(id);
    for (NodeId& node : edge.nodes) node = renumbered[node];
    shared->AddEdge(std::move(edge));
  }
  return shared;
}

void RequireWithin(const std::string& name, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("{}: {} is not within {} and {}", name, value, min, max));
}

}  // namespace curvefusion

PYBIND11_MODULE(_curvefusion, module) {
  module.attr("__version__") = CURVEFUSION_VERSION;
  curvefusion::BindErrors(module);
  curvefusion::BindSequence(module);
  curvefusion::BindSkeleton(module);
  curvefusion::BindMesh(module);
  curvefusion::BindReconstruction(module);
}
