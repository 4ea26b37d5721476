#pragma once

#include <array>
#include <cstdint>

#include "kernel/geometry.h"

namespace curvefusion {

/// Directions from which something was seen, in how many frames each: on the faces of a cube, 18
/// degrees apart on average.
class ViewDirections {
 public:
  /// Chosen: bins of 18 degrees, less than the 30 and 45 that ArcAround reckons with.
  static constexpr int kFaceSide = 5;
  static constexpr int kBins = 6 * kFaceSide * kFaceSide;

  /// `towards_camera` need not have unit length.
  void Add(const Vec3& towards_camera);
  ViewDirections& operator+=(const ViewDirections& other);

  int count(int bin) const { return counts_[bin]; }
  /// Of unit length.
  static Vec3 Direction(int bin);

 private:
  std::array<uint16_t, kBins> counts_{};
};

/// How a curve was looked at, around its tangent.
struct ViewArc {
  double spread = 0;  ///< radians between the outermost views, less than 2 pi
  /// Where a view would add most, towards the camera, of unit length and square to the tangent:
  /// beside the outermost views on the side that fewer frames saw. Zero where there are none.
  Vec3 least_seen = Vec3::Zero();
};

/// Of the directions of at least two frames each; those nearly along the tangent (unit length) show
/// nothing of a curve and do not count.
ViewArc ArcAround(const ViewDirections& views, const Vec3& tangent);

}  // namespace curvefusion
