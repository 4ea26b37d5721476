#include "graph/ridge_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "graph/density_kernel.h"
#include "graph/packed_points.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

constexpr int kGrain = 256;

// A spread s seen through a kernel of variance v has variance s^2 v / (s^2 + v).
double SpreadBehindKernel(double variance, double kernel_variance) {
  if (variance >= kernel_variance) return std::numeric_limits<double>::infinity();
  return std::sqrt(variance * kernel_variance / (kernel_variance - variance));
}

std::vector<double> SpreadsAt(const ObservedPoints& points, const std::vector<Vec3>& places,
                              double sigma) {
  const DensityField field(points, sigma);
  std::vector<double> spreads(places.size());
  const std::vector<int> order = InOrderOfCells(places, kKernelSupport / 2 * sigma);
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

}  // namespace

std::vector<int> LimitsExceeded(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                const std::vector<double>& limits,
                                const RidgeScaleOptions& options) {
  const std::vector<Vec3> samples = ResampleOnGrid(points, options.sample_spacing).positions;
  // For each number of limits the samples that exceed so many.
  std::vector<std::vector<Vec3>> samples_by_exceeded(limits.size() + 1);
  const std::vector<double> spreads = SpreadsAt(points, samples, options.sigma);
  for (size_t i = 0; i < samples.size(); ++i) {
    samples_by_exceeded[std::lower_bound(limits.begin(), limits.end(), spreads[i]) - limits.begin()]
        .push_back(samples[i]);
  }
  std::vector<PackedPoints> packed;
  for (const std::vector<Vec3>& some : samples_by_exceeded) {
    packed.emplace_back(some, std::vector<float>(some.size(), 1), options.window);
  }
  std::vector<int> exceeded(queries.size(), 0);
  const std::vector<int> order = InOrderOfCells(queries, packed[0].cell_size());
  ParallelChunks(0, static_cast<int64_t>(queries.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<PackedPoints::Neighbours> neighbours(packed.size());
    std::vector<int> histogram(packed.size());
    for (int64_t j = first; j < last; ++j) {
      const int i = order[j];
      int count = 0;
      for (size_t k = 0; k < packed.size(); ++k) {
        histogram[k] = static_cast<int>(
            packed[k].SumsWithin(queries[i], options.window, neighbours[k]).weight);
        count += histogram[k];
      }
      if (count == 0) continue;
      int rank = static_cast<int>(options.quantile * (count - 1));
      while (rank >= histogram[exceeded[i]]) rank -= histogram[exceeded[i]++];
    }
  });
  return exceeded;
}

}  // namespace curvefusion
