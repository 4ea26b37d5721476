#pragma once

#include <array>
#include <limits>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/camera.h"

namespace curvefusion {

/// A point of a curve with its direction.
struct CurveSample {
  EdgeId edge = 0;
  double arc_length = 0;  ///< metres from the front of the edge
  Vec3 position;
  Vec3 tangent;  ///< unit
};

/// Points of all edges at equal arc-length steps as near to `step` (metres) as divides each edge,
/// in the middle of their steps, so that ends are half a step away.
std::vector<CurveSample> SampleStrips(const SkeletonGraph& skeleton, double step);

/// A sample of a curve as one camera sees it.
struct ProjectedSample {
  int index = 0;  ///< among the samples that were projected
  EdgeId edge = 0;
  double arc_length = 0;
  Vec2 pixel;
  Vec2 tangent;              ///< unit, in the image
  Vec2 normal;               ///< unit, in the image
  double depth = 0;          ///< metres along the optical axis
  double metres_per_px = 0;  ///< diameter of the cylinder whose strip is one pixel wide
  double clearance_px = 0;   ///< to the nearest curve that is not this piece of curve
  /// With StripSight::by_side, of the side against `normal` and of that along it.
  std::array<double, 2> side_clearance_px = {};

  /// Of the strip of a wire of this radius, metres.
  double WidthPx(double radius) const { return 2 * radius / metres_per_px; }
};

/// The derivative of the pixel by the point in the camera's frame.
Eigen::Matrix<double, 2, 3> ProjectionJacobian(const PinholeCamera& camera, const Vec3& p_camera);

/// Which samples can be looked at, and which other curves are in the way.
struct StripSight {
  /// Curves farther away than this along the sample's curve do not count, pixels: those that cross
  /// it beside the sample are not in the way of what is read across it.
  double max_along_px = std::numeric_limits<double>::infinity();
  /// Whether each side's clearance is wanted, exact up to 16 px: to the curves that cross the
  /// curve or leave it on that side, less than 6 px along it, and to those beside it on either side
  /// or behind it, of which edges may be mistaken for the curve's own. A curve that goes on with
  /// the curve is none.
  bool by_side = false;
};

/// Projects `samples` into a camera. Left out are samples behind or outside the image (or nearer to
/// its border than `border_px`) and those seen nearly end on.
/// `neighbours` are samples of the same skeleton at a step of a few millimetres; clearances look at
/// them and are exact up to 40 px. A neighbour on the same edge belongs to another curve when it is
/// much farther along the curve than across the image.
std::vector<ProjectedSample> ProjectSamples(const std::vector<CurveSample>& samples,
                                            const std::vector<CurveSample>& neighbours,
                                            const PinholeCamera& camera,
                                            const RigidTransform& T_camera_world, double border_px,
                                            const StripSight& sight = {});

}  // namespace curvefusion
