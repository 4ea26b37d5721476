#include "fusion/registration/close_wires.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace curvefusion {

namespace {

// Chosen: so arrays of 7 mm get the 14 mm that contraction resolves; those of 8 mm are the closest
// that were measured (docs/close_wires.md).
constexpr double kMaxMagnification = 2;
// Of the wire array's spacing: points this near to the curves agree with them. Chosen: less than
// the half at which the next wire is as near.
constexpr double kAgreeing = 1.0 / 3;
// Of all points: so many more must agree to leave the nearest start. Chosen: less than one wire of
// ten.
constexpr double kClearlyMore = 0.05;

Vec3 PrincipalDirection(const Mat3& moments) {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(moments);
  return solver.eigenvectors().col(2);
}

// The direction in which the wires of an array follow one another: that of the greatest spread of
// their points across the wires.
Vec3 AcrossRow(const RidgePoints& ridges) {
  Mat3 directions = Mat3::Zero();
  Vec3 mean = Vec3::Zero();
  for (size_t i = 0; i < ridges.size(); ++i) {
    directions += ridges.directions[i] * ridges.directions[i].transpose();
    mean += ridges.positions[i] / static_cast<double>(ridges.size());
  }
  const Vec3 along = PrincipalDirection(directions);
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : ridges.positions) {
    const Vec3 across = (p - mean) - along.dot(p - mean) * along;
    spread += across * across.transpose();
  }
  return PrincipalDirection(spread);
}

double AgreeingShare(const std::vector<Vec3>& points, const RigidTransform& T,
                     const AlignmentTarget& target, double distance) {
  size_t agreeing = 0;
  for (const Vec3& p : points) agreeing += target.grid().Nearest(T * p, distance) >= 0;
  return static_cast<double>(agreeing) / static_cast<double>(points.size());
}

}  // namespace

double Magnification(double array_spacing, double resolved) {
  if (!(array_spacing > 0)) return 1;
  return std::clamp(resolved / array_spacing, 1.0, kMaxMagnification);
}

RidgeProjectionOptions ForCloseWires(RidgeProjectionOptions options, double magnification) {
  for (double* length : {&options.kernel_sigma, &options.max_sigma, &options.equalization_radius,
                         &options.spacing, &options.strength_radius, &options.contrast.ball_radius,
                         &options.contrast.flank_distance, &options.contrast.neighbourhood}) {
    *length /= magnification;
  }
  return options;
}

AlignmentResult AlignArrays(const RidgePoints& ridges, const AlignmentTarget& target,
                            const AlignmentOptions& options, double array_spacing) {
  AlignmentResult best = AlignPoints(ridges.positions, target, options);
  if (!(array_spacing > 0) || ridges.size() == 0) return best;
  const double distance = kAgreeing * array_spacing;
  double most = AgreeingShare(ridges.positions, best.T_target_source, target, distance);
  most += kClearlyMore;
  const Vec3 across = AcrossRow(ridges);
  for (const int side : {-1, 1}) {
    RigidTransform start = RigidTransform::Identity();
    start.translation() = side * array_spacing * across;
    std::vector<Vec3> points = ridges.positions;
    for (Vec3& p : points) p = start * p;
    AlignmentResult result = AlignPoints(points, target, options);
    result.T_target_source = result.T_target_source * start;
    const double share = AgreeingShare(ridges.positions, result.T_target_source, target, distance);
    if (!result.converged || share <= most) continue;
    most = share;
    best = result;
  }
  return best;
}

}  // namespace curvefusion
