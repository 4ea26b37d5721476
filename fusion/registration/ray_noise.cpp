#include "fusion/registration/ray_noise.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

#include "kernel/quantile.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Chosen. More places at which a cloud is looked at change the median by less than its own use
// needs.
constexpr size_t kPlaces = 1000;
constexpr double kNeighbourhood = 0.010;  // metres around each
constexpr size_t kMinNeighbours = 8;      // places with fewer are left out
constexpr double kMaxRatio = 8;           // of compression
// Chosen between what was measured: compression makes noise along the rays 2.0 to 3.2 times as
// curve-like (the real cable in bundles of 16 to 48 frames); structures that are dense, thick or
// smeared by drift gain 1.4 times at most.
constexpr double kLeastGain = 1.7;

double LinearityAt(const std::vector<Vec3>& points, const std::vector<int>& neighbours) {
  Vec3 mean = Vec3::Zero();
  for (const int i : neighbours) mean += points[i];
  mean /= static_cast<double>(neighbours.size());
  Mat3 covariance = Mat3::Zero();
  for (const int i : neighbours) {
    covariance += (points[i] - mean) * (points[i] - mean).transpose();
  }
  const Vec3 spread = Eigen::SelfAdjointEigenSolver<Mat3>(covariance).eigenvalues();
  return spread[2] > 0 ? 1 - spread[1] / spread[2] : 0;
}

}  // namespace

double Linearity(const ObservedPoints& points) {
  const PointIndex index(points.positions);
  std::vector<double> linearity;
  std::vector<int> neighbours;
  const size_t stride = std::max<size_t>(1, points.size() / kPlaces);
  for (size_t i = 0; i < points.size(); i += stride) {
    index.WithinRadius(points.positions[i], kNeighbourhood, neighbours);
    if (neighbours.size() < kMinNeighbours) continue;
    linearity.push_back(LinearityAt(points.positions, neighbours));
  }
  if (linearity.empty()) return 1;
  return Median(std::move(linearity));
}

double RayNoiseRatio(const ObservedPoints& points, double enough) {
  double best_ratio = 1;
  const double as_is = Linearity(points);
  if (as_is >= enough) return 1;
  double best_linearity = kLeastGain * as_is;
  for (double ratio = 2; ratio <= kMaxRatio; ratio *= 2) {
    const double linearity = Linearity(Transformed(points, NoiseMetric(points, ratio)));
    if (linearity <= best_linearity) continue;
    best_linearity = linearity;
    best_ratio = ratio;
  }
  return best_ratio;
}

AffineTransform NoiseMetric(const ObservedPoints& points, double ratio) {
  Mat3 rays = Mat3::Zero();
  for (const Vec3& ray : points.viewing_rays) rays += ray * ray.transpose();
  if (!points.empty()) rays /= static_cast<double>(points.size());
  const Mat3 covariance = Mat3::Identity() + (ratio * ratio - 1) * rays;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  const double least = solver.eigenvalues()[0];
  AffineTransform metric = AffineTransform::Identity();
  metric.linear() = solver.eigenvectors() *
                    (least * solver.eigenvalues().cwiseInverse()).cwiseSqrt().asDiagonal() *
                    solver.eigenvectors().transpose();
  return metric;
}

}  // namespace curvefusion
