#include "graph/ridge_scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/density_kernel.h"
#include "kernel/ball_sums.h"
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

// The samples whose spreads exceed none, one, two, ... of the limits.
std::vector<BallSums> SamplesByLimitsExceeded(const std::vector<Vec3>& samples,
                                              const std::vector<double>& spreads,
                                              const std::vector<double>& limits, double window) {
  std::vector<std::vector<Vec3>> exceeding(limits.size() + 1);
  for (size_t i = 0; i < samples.size(); ++i) {
    const auto number = std::lower_bound(limits.begin(), limits.end(), spreads[i]) - limits.begin();
    exceeding[number].push_back(samples[i]);
  }
  std::vector<BallSums> sums;
  for (const std::vector<Vec3>& some : exceeding) {
    sums.emplace_back(some, std::vector<float>(some.size(), 1), window);
  }
  return sums;
}

}  // namespace

std::vector<int> LimitsExceeded(const ObservedPoints& points, const std::vector<Vec3>& queries,
                                const std::vector<double>& limits,
                                const RidgeScaleOptions& options) {
  const std::vector<Vec3> samples = ResampleOnGrid(points, options.sample_spacing).positions;
  const std::vector<BallSums> samples_exceeding = SamplesByLimitsExceeded(
      samples, SpreadsAt(points, samples, options.sigma), limits, options.window);
  std::vector<int> exceeded(queries.size(), 0);
  ParallelChunks(0, static_cast<int64_t>(queries.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<double> histogram(samples_exceeding.size());
    for (int64_t i = first; i < last; ++i) {
      double count = 0;
      for (size_t number = 0; number < histogram.size(); ++number) {
        histogram[number] = samples_exceeding[number].Around(queries[i]).weights;
        count += histogram[number];
      }
      if (count == 0) continue;
      double rank = std::floor(options.quantile * (count - 1));
      while (rank >= histogram[exceeded[i]]) rank -= histogram[exceeded[i]++];
    }
  });
  return exceeded;
}

}  // namespace curvefusion
