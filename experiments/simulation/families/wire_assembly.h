#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiments/simulation/objects.h"

namespace curvefusion {

/// Wires under construction, in millimetres. What is to be welded shares a point: those of
/// different wires within a micrometre become one when the object is finished.
class WireAssembly {
 public:
  /// An open wire; returns its number.
  int Add(const Polyline& points, double diameter);

  /// An open wire whose diameter changes evenly along it.
  int AddTapered(const Polyline& points, double first_diameter, double last_diameter);

  /// A wire welded into a loop; the first point is not repeated in the argument.
  int AddLoop(const Polyline& points, double diameter);

  /// Another assembly, moved.
  void Append(const WireAssembly& other, const Vec3& shift);

  /// The point of a wire nearest to `near`, made one of its vertices unless it is one to within
  /// half a millimetre.
  Vec3 VertexNear(int wire, const Vec3& near);

  /// The same at a share of the wire's length.
  Vec3 VertexAt(int wire, double share);

  /// The wire's direction at a share of its length.
  Vec3 DirectionAt(int wire, double share) const;
  double DiameterAt(int wire, double share) const;
  double LengthOf(int wire) const;

  /// The least gap between a wire of that diameter along points and the wires but `except`; the
  /// part within `start` of its first point does not count. Infinite where there is nothing.
  double Clearance(const Polyline& points, double diameter, double start, int except = -1) const;

  /// Bends all: no segment stays longer than 8 mm.
  void Warp(const std::function<Vec3(const Vec3&)>& map);

  /// Bounding box of the centre lines.
  Eigen::AlignedBox3d Bounds() const;

  /// The object in metres, welded where points are shared.
  WireObject Finished(const std::string& name) const;

 private:
  std::vector<WireCurve> wires_;  // in millimetres
};

}  // namespace curvefusion
