#pragma once

#include <array>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// What a depth image shows at a place of a curve.
enum class Sight {
  kOutside,  ///< the place is not in the image
  kHidden,   ///< something stands before it
  kPast,     ///< what is behind it was measured, but nothing at the curve's depth
  kNothing,  ///< nothing was measured
  kSeen,     ///< a depth that agrees with the curve's
};

/// How what was seen of a curve ends on one of its sides.
enum class Beside {
  kUnknown,  ///< nothing measured, another curve of the skeleton, or something nearer
  kOpen,     ///< what lies beside it is farther away
  kSame,     ///< its surface goes on, farther than any wire is wide
};

/// One depth image across a curve at one of its places.
struct DepthProfile {
  Sight sight = Sight::kOutside;
  std::array<Beside, 2> sides = {Beside::kUnknown, Beside::kUnknown};
  double width = 0;  ///< metres across, of the connected depth; where seen
};

/// A place of a curve.
struct CurvePlace {
  EdgeId edge = 0;
  double arc_length = 0;  ///< metres from the front of the edge
  double radius = 0;      ///< metres
  Vec3 position;
  Vec3 tangent;  ///< unit
};

/// Where the curves of a skeleton lie in one image, so that none is taken for the surface beside
/// another.
class CurveMap {
 public:
  /// `places` (world frame) are so dense that they leave few pixels of a curve out.
  CurveMap(const std::vector<CurvePlace>& places, const PinholeCamera& camera,
           const RigidTransform& T_camera_world);

  /// Whether a curve other than that of `place` runs through a pixel of the image; `distance`
  /// (metres) is how far from the place the pixel lies across the curve.
  bool IsOther(int u, int v, const CurvePlace& place, double distance) const;

 private:
  const std::vector<CurvePlace>& places_;
  Image<int> nearest_;  // index of the place nearest to the camera; -1 = none
};

/// Looks across the curve at `place` (world frame). The curve is searched for by as much as poses
/// err. Cost: some 100 pixels.
DepthProfile LookAcross(const DepthImage& depth, const PinholeCamera& camera,
                        const RigidTransform& T_camera_world, const CurvePlace& place,
                        const CurveMap& curves);

}  // namespace curvefusion
