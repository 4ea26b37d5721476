#include "graph/ridge_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "graph/density_kernel.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
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
  const DensityField field(points, sigma);
  std::vector<double> spreads(places.size());
  ParallelChunks(0, static_cast<int64_t>(places.size()), kGrain, [&](int64_t first, int64_t last) {
    DensityField::Neighbours neighbours;
    for (int64_t i = first; i < last; ++i) {
      neighbours.Clear();
      const KernelMoments moments = field.Moments({places[i], Vec3::Zero(), 1}, neighbours);
      Eigen::SelfAdjointEigenSolver<Mat3> solver;
      solver.computeDirect(moments.covariance, Eigen::EigenvaluesOnly);
      spreads[i] = SpreadBehindKernel(std::max(0.0, solver.eigenvalues()[1]),
                                      kKernelVariance * sigma * sigma);
    }
  });
  return spreads;
}

}  // namespace

std::vector<int> LimitsExceeded(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                const std::vector<double>& limits,
                                const RidgeScaleOptions& options) {
  const std::vector<Vec3> samples = ResampleOnGrid(points, options.sample_spacing).positions;
  std::vector<int> exceeded_by_sample;
  for (const double spread : SpreadsAt(points, samples, options.sigma)) {
    exceeded_by_sample.push_back(
        static_cast<int>(std::lower_bound(limits.begin(), limits.end(), spread) - limits.begin()));
  }
  const PointGrid grid(samples, options.window);
  std::vector<int> exceeded(queries.size(), 0);
  ParallelChunks(0, static_cast<int64_t>(queries.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<int> histogram(limits.size() + 1);
    for (int64_t i = first; i < last; ++i) {
      std::fill(histogram.begin(), histogram.end(), 0);
      int count = 0;
      grid.ForEachWithin(queries[i], options.window, [&](int sample, const Vec3&) {
        ++histogram[exceeded_by_sample[sample]];
        ++count;
      });
      if (count == 0) continue;
      int rank = static_cast<int>(options.quantile * (count - 1));
      while (rank >= histogram[exceeded[i]]) rank -= histogram[exceeded[i]++];
    }
  });
  return exceeded;
}

}  // namespace curvefusion
