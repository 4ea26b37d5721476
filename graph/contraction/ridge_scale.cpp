#include "graph/contraction/ridge_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "graph/contraction/density_kernel.h"
#include "graph/contraction/packed_points.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

constexpr int kGrain = 256;  // places for a thread at a time; chosen

// A spread s seen through a kernel of variance v has variance s^2 v / (s^2 + v).
double SpreadBehindKernel(double variance, double kernel_variance) {
  if (variance >= kernel_variance) return std::numeric_limits<double>::infinity();
  return std::sqrt(variance * kernel_variance / (kernel_variance - variance));
}

std::vector<double> SpreadsAt(const ObservedPoints& points, const std::vector<Vec3>& places,
                              double sigma) {
  const DensityField field(points, sigma);
  std::vector<double> spreads(places.size());
  const std::vector<int> order = GroupByCell(places, kKernelSupport / 2 * sigma).members;
  ParallelChunks(0, static_cast<int64_t>(places.size()), kGrain, [&](int64_t first, int64_t last) {
    DensityField::Neighbours neighbours;
    for (int64_t k = first; k < last; ++k) {
      const int i = order[k];
      const KernelMoments moments = field.Moments({places[i], Vec3::Zero(), 1}, neighbours);
      Eigen::SelfAdjointEigenSolver<Mat3> solver;
      solver.computeDirect(moments.covariance, Eigen::EigenvaluesOnly);
      spreads[i] = SpreadBehindKernel(std::max(0.0, solver.eigenvalues()[1]),
                                      kKernelVariance * sigma * sigma);
    }
  });
  return spreads;
}

// For each number of limits the samples whose spread exceeds so many.
std::vector<PackedPoints> PackByExceeded(const std::vector<Vec3>& samples,
                                         const std::vector<double>& spreads,
                                         const std::vector<double>& limits, double window) {
  std::vector<std::vector<Vec3>> by_exceeded(limits.size() + 1);
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto limit = std::lower_bound(limits.begin(), limits.end(), spreads[i]);
    by_exceeded[limit - limits.begin()].push_back(samples[i]);
  }
  std::vector<PackedPoints> packed;
  for (const std::vector<Vec3>& some : by_exceeded) {
    packed.emplace_back(some, std::vector<float>(some.size(), 1), window);
  }
  return packed;
}

// The `quantile` one of the numbers of limits exceeded within the window around each place.
std::vector<int> QuantilesAt(const std::vector<PackedPoints>& samples_by_exceeded,
                             const std::vector<Vec3>& places, double window, double quantile) {
  std::vector<int> exceeded(places.size(), 0);
  const std::vector<int> order = GroupByCell(places, samples_by_exceeded[0].cell_size()).members;
  ParallelChunks(0, static_cast<int64_t>(places.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<PackedPoints::Neighbours> neighbours(samples_by_exceeded.size());
    std::vector<int> histogram(samples_by_exceeded.size());
    for (int64_t j = first; j < last; ++j) {
      const int i = order[j];
      int count = 0;
      for (size_t k = 0; k < histogram.size(); ++k) {
        histogram[k] = static_cast<int>(
            samples_by_exceeded[k].SumsWithin(places[i], window, neighbours[k]).weight);
        count += histogram[k];
      }
      if (count == 0) continue;
      int rank = static_cast<int>(quantile * (count - 1));
      while (rank >= histogram[exceeded[i]]) rank -= histogram[exceeded[i]++];
    }
  });
  return exceeded;
}

}  // namespace

std::vector<int> LimitsExceeded(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                const std::vector<double>& limits,
                                const RidgeScaleOptions& options) {
  const std::vector<Vec3> samples = ResampleOnGrid(points, options.sample_spacing).positions;
  const std::vector<PackedPoints> samples_by_exceeded =
      PackByExceeded(samples, SpreadsAt(points, samples, options.sigma), limits, options.window);
  return QuantilesAt(samples_by_exceeded, queries, options.window, options.quantile);
}

}  // namespace curvefusion
