#include "graph/ridge_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "graph/density_kernel.h"
#include "graph/point_grid.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

constexpr int kGrain = 64;

// A spread s seen through a kernel of variance v has variance s^2 v / (s^2 + v).
double SpreadBehindKernel(double variance, double kernel_variance) {
  if (variance >= kernel_variance) return std::numeric_limits<double>::infinity();
  return std::sqrt(variance * kernel_variance / (kernel_variance - variance));
}

std::vector<double> SpreadsAt(const ObservedPoints& points, const std::vector<Vec3>& places,
                              double sigma) {
  const DensityField field(points, sigma, 0);
  std::vector<double> spreads(places.size());
  ParallelChunks(0, static_cast<int64_t>(places.size()), kGrain, [&](int64_t first, int64_t last) {
    DensityField::Neighbours neighbours;
    for (int64_t i = first; i < last; ++i) {
      field.Gather(places[i], neighbours);
      const KernelMoments moments = field.Moments(neighbours, places[i]);
      Eigen::SelfAdjointEigenSolver<Mat3> solver;
      solver.computeDirect(moments.covariance, Eigen::EigenvaluesOnly);
      spreads[i] = SpreadBehindKernel(std::max(0.0, solver.eigenvalues()[1]),
                                      kKernelVariance * sigma * sigma);
    }
  });
  return spreads;
}

}  // namespace

std::vector<double> LocalThickness(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                   const RidgeScaleOptions& options) {
  const std::vector<Vec3> samples = ResampleOnGrid(points, options.sample_spacing).positions;
  const std::vector<double> spreads = SpreadsAt(points, samples, options.sigma);
  const PointGrid grid(samples, options.window);
  std::vector<double> thickness(queries.size(), 0.0);
  ParallelChunks(0, static_cast<int64_t>(queries.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<double> around;
    for (int64_t i = first; i < last; ++i) {
      around.clear();
      grid.ForEachWithin(queries[i], options.window,
                         [&](int sample, const Vec3&) { around.push_back(spreads[sample]); });
      if (around.empty()) continue;
      const auto ranked =
          around.begin() +
          static_cast<std::ptrdiff_t>(options.quantile * static_cast<double>(around.size() - 1));
      std::nth_element(around.begin(), ranked, around.end());
      thickness[i] = *ranked;
    }
  });
  return thickness;
}

}  // namespace curvefusion
