#include "experiments/metrics/alignment_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace curvefusion {

AlignmentPoints Thinned(const AlignmentPoints& points, size_t count) {
  return {Thinned(points.positions, count), Thinned(points.tangents, count)};
}

PointSpread SpreadOfPoints(const std::vector<Vec3>& points) {
  const double count = static_cast<double>(points.size());
  PointSpread spread;
  spread.center = std::accumulate(points.begin(), points.end(), Vec3(Vec3::Zero())) / count;
  double squares = 0;
  for (const Vec3& p : points) squares += (p - spread.center).squaredNorm();
  spread.radius = std::max(std::sqrt(squares / count), 1 * kMillimetre);
  return spread;
}

RigidTransform TurnAbout(const Vec3& center, const Vec3& rotation_vector) {
  RigidTransform T = RigidTransform::Identity();
  const double angle = rotation_vector.norm();
  if (angle > 0) T.linear() = Eigen::AngleAxisd(angle, rotation_vector / angle).matrix();
  T.translation() = center - T.linear() * center;
  return T;
}

}  // namespace curvefusion
