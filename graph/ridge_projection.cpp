#include "graph/ridge_projection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "graph/point_grid.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// (1 - q / 2k)^k with k = 4 is within .05 of exp(-q / 2), needs no exponential and ends by itself.
constexpr int kKernelPower = 4;
const double kSupportSigmas = std::sqrt(2.0 * kKernelPower);
constexpr double kConvergedStep = 0.02 * kMillimetre;
constexpr int kGrain = 64;

// What the kernels of the neighbours add up to at one place.
struct KernelSums {
  double weight = 0;
  Vec3 mean = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();
};

// The points around a seed, relative to where it started: one gather serves all its iterations.
struct Neighbourhood {
  std::vector<Vec3> offsets;
  std::vector<Vec3> rays;
  std::vector<double> weights;

  void Clear() {
    offsets.clear();
    rays.clear();
    weights.clear();
  }
};

struct RidgeSeed {
  Vec3 position;
  Vec3 direction;
  double strength;
};

ObservedPoints FinitePoints(const ObservedPoints& points) {
  ObservedPoints finite;
  finite.Reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    if (points.positions[i].allFinite() && points.viewing_rays[i].allFinite() &&
        points.counts[i] > 0) {
      finite.Add(points.positions[i], points.viewing_rays[i], points.counts[i]);
    }
  }
  return finite;
}

// Weighted by the inverse kernel covariance (I - c v v^T) / sigma^2, so that a point pulls less
// along its viewing ray than across it.
KernelSums SumKernels(const Neighbourhood& neighbours, const Vec3& x,
                      const RidgeProjectionOptions& options) {
  const double squared_sigma = options.kernel_sigma * options.kernel_sigma;
  const double ratio = options.kernel_sigma / options.ray_sigma;
  const double along = 1 - ratio * ratio;
  KernelSums sums;
  Mat3 second = Mat3::Zero();
  Mat3 precision = Mat3::Zero();
  Vec3 pull = Vec3::Zero();
  Vec3 first = Vec3::Zero();
  for (size_t i = 0; i < neighbours.offsets.size(); ++i) {
    const Vec3 d = neighbours.offsets[i] - x;
    const Vec3& ray = neighbours.rays[i];
    const Vec3 across = d - (along * ray.dot(d)) * ray;
    const double t = 1 - d.dot(across) / (2 * kKernelPower * squared_sigma);
    if (t <= 0) continue;
    const double weight = neighbours.weights[i] * t * t * t * t;
    sums.weight += weight;
    first += weight * d;
    pull += weight * across;
    second.noalias() += weight * d * d.transpose();
    precision.noalias() += weight * along * ray * ray.transpose();
  }
  if (sums.weight <= 0) return sums;
  first /= sums.weight;
  sums.covariance = second / sums.weight - first * first.transpose();
  precision = sums.weight * Mat3::Identity() - precision;
  sums.mean = precision.inverse() * pull;
  return sums;
}

RidgeSeed ProjectSeed(const Vec3& start, const Neighbourhood& neighbours,
                      const RidgeProjectionOptions& options) {
  Vec3 x = Vec3::Zero();
  RidgeSeed seed{start, Vec3::Zero(), 0};
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    const KernelSums sums = SumKernels(neighbours, x, options);
    seed.strength = sums.weight;
    if (sums.weight <= 0) break;
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(sums.covariance);
    seed.direction = solver.eigenvectors().col(2);
    const Vec3 step = sums.mean - seed.direction.dot(sums.mean) * seed.direction;
    x += step;
    if (step.norm() < kConvergedStep) break;
  }
  seed.position = start + x;
  return seed;
}

std::vector<RidgeSeed> ProjectSeeds(const ObservedPoints& points, const std::vector<Vec3>& starts,
                                    const RidgeProjectionOptions& options) {
  // A seed travels about one sigma: the slack keeps its neighbours complete on the way.
  const double reach =
      kSupportSigmas * std::max(options.kernel_sigma, options.ray_sigma) + options.kernel_sigma;
  const PointGrid grid(points.positions, reach);
  std::vector<RidgeSeed> seeds(starts.size());
  ParallelChunks(0, static_cast<int64_t>(starts.size()), kGrain, [&](int64_t first, int64_t last) {
    Neighbourhood neighbours;
    for (int64_t i = first; i < last; ++i) {
      neighbours.Clear();
      grid.ForEachWithin(starts[i], reach, [&](int index, const Vec3& p) {
        neighbours.offsets.push_back(p - starts[i]);
        neighbours.rays.push_back(points.viewing_rays[index]);
        neighbours.weights.push_back(std::min<double>(points.counts[index], options.count_limit));
      });
      seeds[i] = ProjectSeed(starts[i], neighbours, options);
    }
  });
  return seeds;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Keeps the strongest seeds such that no two are nearer than the spacing.
RidgePoints ThinOut(const std::vector<RidgeSeed>& seeds, const RidgeProjectionOptions& options) {
  std::vector<Vec3> positions;
  std::vector<double> strengths;
  for (const RidgeSeed& seed : seeds) {
    positions.push_back(seed.position);
    strengths.push_back(seed.strength);
  }
  const double least = options.min_relative_strength * Median(strengths);
  std::vector<int> order(seeds.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return strengths[a] > strengths[b]; });
  const PointGrid grid(positions, options.spacing);
  std::vector<char> covered(seeds.size(), 0);
  RidgePoints ridge;
  for (const int i : order) {
    if (covered[i] || strengths[i] <= least) continue;
    grid.ForEachWithin(positions[i], options.spacing, [&](int j, const Vec3&) { covered[j] = 1; });
    ridge.positions.push_back(positions[i]);
    ridge.directions.push_back(seeds[i].direction);
    ridge.strengths.push_back(strengths[i]);
  }
  return ridge;
}

}  // namespace

void VisitOptions(RidgeProjectionOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"kernel_sigma", "m", 0.0005, 0.05,
                 "Deviation: width of the density kernel across the viewing ray; 25 mm as in "
                 "CurveFusion 3.2 loses wires, 2 mm makes false junctions."},
                options.kernel_sigma);
  visitor.Visit({"ray_sigma", "m", 0.0005, 0.05,
                 "Deviation: width of the kernel along the viewing ray, where depth noise is "
                 "larger."},
                options.ray_sigma);
  visitor.Visit({"count_limit", "pixels", 1, 1e6,
                 "Deviation: a point counts as often as it was seen, up to this often, so that "
                 "long looks at one part do not pull at their surroundings."},
                options.count_limit);
  visitor.Visit({"iterations", "", 1, 1000, "Deviation: most mean-shift steps of a point."},
                options.iterations);
  visitor.Visit({"spacing", "m", 0.0002, 0.02, "Deviation: least distance of ridge points."},
                options.spacing);
  visitor.Visit({"min_relative_strength", "", 0, 1,
                 "Deviation: ridge points weaker than this part of the median are outliers."},
                options.min_relative_strength);
}

ObservedPoints ShiftAlongRays(const ObservedPoints& points, double distance) {
  return ShiftAlongRays(points, std::vector<double>(points.size(), distance));
}

ObservedPoints ShiftAlongRays(const ObservedPoints& points, const std::vector<double>& distances) {
  assert(distances.size() == points.size());
  ObservedPoints shifted = points;
  for (size_t i = 0; i < points.size(); ++i) {
    shifted.positions[i] += distances[i] * points.viewing_rays[i];
  }
  return shifted;
}

RidgePoints ProjectToRidges(const ObservedPoints& points, const RidgeProjectionOptions& options) {
  const ObservedPoints finite = FinitePoints(points);
  // One seed per cell covers every ridge: the density is still that of all points.
  const ObservedPoints starts = ResampleOnGrid(finite, options.spacing);
  return ThinOut(ProjectSeeds(finite, starts.positions, options), options);
}

}  // namespace curvefusion
