#include "fusion/best/scale_of_poses.h"

#include <Eigen/Geometry>
#include <optional>

#include "capture/content/geometry_check.h"
#include "fusion/best/world_scale.h"

namespace curvefusion {

namespace {

using Centers = Eigen::Matrix3Xd;

Centers CentersOf(const Sequence& sequence) {
  Centers centers(3, sequence.frame_count());
  for (int i = 0; i < sequence.frame_count(); ++i)
    centers.col(i) = sequence.frames[i].T_world_camera.translation();
  return centers;
}

// The fixed point: poses were adjusted about those of the tracker, curves at some distance were
// not.
Vec3 MiddleOfCameras(const Reconstruction& result) {
  return CentersOf(result.sequence).rowwise().mean();
}

}  // namespace

void HoldToScaleOf(const Sequence& given, Reconstruction& result) {
  if (result.skeleton.empty()) return;
  const Centers from = CentersOf(result.sequence), to = CentersOf(given);
  if ((from.colwise() - from.col(0)).isZero() || (to.colwise() - to.col(0)).isZero()) return;
  const Eigen::Matrix4d fitted = Eigen::umeyama(from, to, true);
  ScaleAbout(MiddleOfCameras(result), fitted.block<3, 1>(0, 0).norm(), result);
}

void HoldToScaleOfDepth(Reconstruction& result) {
  if (result.skeleton.empty()) return;
  if (const std::optional<double> scale = ScaleByDepth(result.sequence)) {
    ScaleAbout(MiddleOfCameras(result), *scale, result);
  } else {
    result.warnings.push_back(
        "the depth images do not tell the size of the curves, which is that of the poses: measure "
        "one length");
  }
}

}  // namespace curvefusion
