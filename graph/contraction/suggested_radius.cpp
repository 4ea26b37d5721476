#include "graph/contraction/suggested_radius.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kernel/parallel.h"
#include "kernel/quantile.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

// Chosen. Elongation is radius over thickness: at 2.5 a neighbourhood is five times as long as
// thick.
constexpr int64_t kGrain = 32;        // for a thread at a time
constexpr size_t kProbes = 400;       // as many points are asked; the median settles long before
constexpr int kLeastNeighbours = 16;  // fewer are elongated by chance
constexpr double kRadiusStep = 1.15;  // finer than the result needs to be
constexpr double kElongated = 1.1;    // more than in a disc, .58, or in a ball, .65
constexpr double kFallen = 0.95;      // share of the best elongation that says: past it
constexpr double kEnoughElongation = 2.5;

// Width of the neighbourhood across its principal direction: that of a uniform strip with the same
// variance.
double ThicknessAround(const Vec3& p, const std::vector<Vec3>& points,
                       const std::vector<int>& neighbours) {
  Vec3 mean = Vec3::Zero();
  for (const int j : neighbours) mean += points[j] - p;
  mean /= static_cast<double>(neighbours.size());
  Mat3 covariance = Mat3::Zero();
  for (const int j : neighbours) {
    const Vec3 offset = points[j] - p - mean;
    covariance += offset * offset.transpose();
  }
  covariance /= static_cast<double>(neighbours.size());
  const double trace = covariance.trace();
  if (!(trace > 0)) return 0;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(covariance / trace, Eigen::EigenvaluesOnly);
  return std::sqrt(12 * trace * std::max(0.0, solver.eigenvalues()(1)));
}

std::vector<Vec3> Probes(const std::vector<Vec3>& points) {
  std::vector<Vec3> probes;
  const size_t stride = std::max<size_t>(1, points.size() / kProbes);
  for (size_t i = 0; i < points.size(); i += stride) probes.push_back(points[i]);
  return probes;
}

// The radius that holds kLeastNeighbours points around most probes.
double LeastRadius(const std::vector<Vec3>& probes, const std::vector<Vec3>& points,
                   const PointIndex& index) {
  std::vector<double> radii(probes.size());
  ParallelFor(0, static_cast<int64_t>(probes.size()), kGrain, [&](int64_t i) {
    radii[i] = (points[index.NearestK(probes[i], kLeastNeighbours).back()] - probes[i]).norm();
  });
  return Median(std::move(radii));
}

double MedianThickness(const std::vector<Vec3>& probes, const std::vector<Vec3>& points,
                       const PointIndex& index, double radius) {
  std::vector<double> values(probes.size());
  ParallelChunks(0, static_cast<int64_t>(probes.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<int> neighbours;
    for (int64_t i = first; i < last; ++i) {
      index.WithinRadius(probes[i], radius, neighbours);
      values[i] = ThicknessAround(probes[i], points, neighbours);
    }
  });
  return Median(std::move(values));
}

}  // namespace

double SuggestedRadius(const ObservedPoints& cloud) {
  const std::vector<Vec3>& points = cloud.positions;
  RequireFinitePositions(cloud);
  if (points.empty()) return 0;
  const double diagonal = RobustExtent(cloud).norm();
  const PointIndex index(points);
  const std::vector<Vec3> probes = Probes(points);
  double best_elongation = kElongated;
  double best_radius = 0;
  // Duplicates of points may make the least radius zero.
  const double least_radius = std::max(LeastRadius(probes, points, index), 1e-3 * diagonal);
  for (double radius = least_radius; radius < diagonal; radius *= kRadiusStep) {
    const double elongation = radius / MedianThickness(probes, points, index, radius);
    if (elongation >= best_elongation) {
      best_elongation = elongation;
      best_radius = radius;
    }
    const bool is_past = best_radius > 0 && elongation < kFallen * best_elongation;
    if (is_past || elongation >= kEnoughElongation) return best_radius;
  }
  return 2 * diagonal / std::cbrt(static_cast<double>(points.size()));
}

}  // namespace curvefusion
