#include "fusion/best/scale_of_poses.h"

#include <Eigen/Geometry>
#include <optional>
#include <utility>
#include <vector>

#include "capture/content/geometry_check.h"

namespace curvefusion {

namespace {

using Centers = Eigen::Matrix3Xd;

Centers CentersOf(const Sequence& sequence) {
  Centers centers(3, sequence.frame_count());
  for (int i = 0; i < sequence.frame_count(); ++i)
    centers.col(i) = sequence.frames[i].T_world_camera.translation();
  return centers;
}

SkeletonGraph Scaled(const SkeletonGraph& skeleton, const AffineTransform& motion, double scale) {
  SkeletonGraph scaled = Transformed(skeleton, motion);
  for (const EdgeId id : scaled.Edges()) {
    const SkeletonEdge edge = scaled.edge(id);
    std::vector<double> radii = edge.radii;
    for (double& radius : radii) radius *= scale;
    scaled.SetCurve(id, edge.points, std::move(radii), edge.observations);
  }
  return scaled;
}

void Scale(double scale, RadiusEstimate& radii) {
  radii.global_radius *= scale;
  radii.unmeasured_radius *= scale;
  for (EdgeRadius& edge : radii.edges) {
    edge.radius *= scale;
    edge.error *= scale;
  }
}

// About the middle of its curves.
void ScaleBy(double scale, Reconstruction& result) {
  const Vec3 middle = BoundsOf(result.skeleton).center();
  const AffineTransform motion =
      Eigen::Translation3d(middle) * Eigen::Scaling(scale) * Eigen::Translation3d(-middle);
  result.skeleton = Scaled(result.skeleton, motion, scale);
  result.uncertain.graph = Scaled(result.uncertain.graph, motion, scale);
  for (Vec3& p : result.points.positions) p = motion * p;
  Scale(scale, result.radii);
  for (SequenceFrame& frame : result.sequence.frames)
    frame.T_world_camera.translation() = motion * Vec3(frame.T_world_camera.translation());
}

}  // namespace

void HoldToScaleOf(const Sequence& given, Reconstruction& result) {
  if (result.skeleton.empty()) return;
  const Centers from = CentersOf(result.sequence), to = CentersOf(given);
  if ((from.colwise() - from.col(0)).isZero() || (to.colwise() - to.col(0)).isZero()) return;
  const Eigen::Matrix4d fitted = Eigen::umeyama(from, to, true);
  ScaleBy(fitted.block<3, 1>(0, 0).norm(), result);
}

void HoldToScaleOfDepth(Reconstruction& result) {
  if (result.skeleton.empty()) return;
  if (const std::optional<double> scale = ScaleByDepth(result.sequence)) {
    ScaleBy(*scale, result);
  } else {
    result.warnings.push_back(
        "the depth images do not tell the size of the curves, which is that of the poses: measure "
        "one length");
  }
}

}  // namespace curvefusion
