#include "graph/ridge_projection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "graph/density_kernel.h"
#include "graph/point_grid.h"
#include "graph/ridge_scale.h"
#include "kernel/parallel.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

constexpr double kConvergedStep = 0.01 * kMillimetre;
constexpr int kGrain = 32;
// Kernel widths grow by this factor from one level to the next.
constexpr double kLevelRatio = 1.4142135623730951;
// A density is smooth enough for points and seeds this far apart, in kernel widths.
constexpr double kCellPerSigma = 0.7;
// After so many steps most seeds have come together and need not all be followed to the end.
constexpr int kGatheringIterations = 3;

struct RidgeSeed {
  Vec3 position;
  Vec3 direction = Vec3::Zero();
  double strength = 0;
  double elongation = 0;  ///< variance along the direction over that of a uniform curve
  int level = 0;
};

ObservedPoints UsablePoints(const ObservedPoints& points) {
  ObservedPoints usable;
  usable.Reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    if (points.positions[i].allFinite() && points.viewing_rays[i].allFinite() &&
        points.counts[i] > 0) {
      usable.Add(points.positions[i], points.viewing_rays[i], points.counts[i]);
    }
  }
  return usable;
}

double Median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The strength that half of the summed strength lies below: outliers, however many, hardly count.
double TypicalStrength(std::vector<double> strengths) {
  std::sort(strengths.begin(), strengths.end());
  const double half = std::accumulate(strengths.begin(), strengths.end(), 0.0) / 2;
  double sum = 0;
  for (const double strength : strengths) {
    sum += strength;
    if (sum >= half) return strength;
  }
  return 0;
}

// Divides the counts by what is usual nearby, the count-weighted mean within the radius: wires seen
// often and seldom become equally strong, while their profile across stays.
void EqualizeCounts(ObservedPoints& points, double radius, double least_relative_count) {
  const PointGrid grid(points.positions, radius);
  std::vector<double> usual(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), kGrain, [&](int64_t i) {
    double sum = 0;
    double squares = 0;
    grid.ForEachWithin(points.positions[i], radius, [&](int j, const Vec3&) {
      const double count = points.counts[j];
      sum += count;
      squares += count * count;
    });
    usual[i] = squares / sum;
  });
  const double least = least_relative_count * Median(usual);
  for (size_t i = 0; i < points.size(); ++i) {
    points.counts[i] = static_cast<float>(points.counts[i] / std::max(usual[i], least));
  }
}

// The density at growing kernel widths; wide kernels need fewer points.
std::vector<DensityField> MakeLevels(const ObservedPoints& points,
                                     const RidgeProjectionOptions& options) {
  std::vector<DensityField> levels{
      DensityField(points, options.kernel_sigma, options.kernel_sigma)};
  double sigma = kLevelRatio * options.kernel_sigma;
  for (; sigma < 1.01 * options.max_sigma; sigma *= kLevelRatio) {
    levels.emplace_back(ResampleOnGrid(points, kCellPerSigma * sigma), sigma, sigma);
  }
  return levels;
}

// Seeds all over the cloud, each of the level that suits the thickness there.
std::vector<RidgeSeed> MakeSeeds(const ObservedPoints& points,
                                 const std::vector<DensityField>& levels,
                                 const RidgeProjectionOptions& options) {
  const std::vector<Vec3> starts =
      ResampleOnGrid(points, kCellPerSigma * options.kernel_sigma).positions;
  RidgeScaleOptions scale;
  scale.sigma = options.kernel_sigma;
  const std::vector<double> thickness = LocalThickness(points, starts, scale);
  std::vector<RidgeSeed> seeds;
  for (size_t i = 0; i < starts.size(); ++i) {
    const double wanted = options.sigma_per_thickness * thickness[i];
    size_t level = 0;
    while (level + 1 < levels.size() && levels[level].sigma() < wanted) ++level;
    seeds.push_back({starts[i], Vec3::Zero(), 0, 0, static_cast<int>(level)});
  }
  return seeds;
}

// Where the moments are taken about decides at the end of a wire, where the mean lies inward: about
// the seed the principal direction keeps along the wire, but seeds must be near the ridge already.
enum class MomentsAbout { kMean, kSeed };

void ProjectSeed(const DensityField& field, MomentsAbout about, int iterations, RidgeSeed& seed,
                 DensityField::Neighbours& neighbours) {
  const double usual_variance = kKernelVariance * field.sigma() * field.sigma();
  field.Gather(seed.position, neighbours);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const KernelMoments moments = field.Moments(neighbours, seed.position);
    seed.strength = moments.weight;
    if (moments.weight <= 0) return;
    const Mat3 about_seed = moments.covariance + moments.mean * moments.mean.transpose();
    Eigen::SelfAdjointEigenSolver<Mat3> solver;
    solver.computeDirect(about == MomentsAbout::kSeed ? about_seed : moments.covariance);
    seed.direction = solver.eigenvectors().col(2);
    seed.elongation = seed.direction.dot(about_seed * seed.direction) / usual_variance;
    const Vec3 step = moments.mean - seed.direction.dot(moments.mean) * seed.direction;
    seed.position += step;
    if (step.norm() < kConvergedStep) return;
  }
}

void ProjectSeeds(const std::vector<DensityField>& levels, MomentsAbout about, int iterations,
                  std::vector<RidgeSeed>& seeds) {
  ParallelChunks(0, static_cast<int64_t>(seeds.size()), kGrain, [&](int64_t first, int64_t last) {
    DensityField::Neighbours neighbours;
    for (int64_t i = first; i < last; ++i) {
      ProjectSeed(levels[seeds[i].level], about, iterations, seeds[i], neighbours);
    }
  });
}

// Keeps the strongest seeds such that no two are nearer than the spacing.
std::vector<RidgeSeed> ThinOut(const std::vector<RidgeSeed>& seeds, double spacing) {
  std::vector<Vec3> positions;
  for (const RidgeSeed& seed : seeds) positions.push_back(seed.position);
  std::vector<int> order(seeds.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return seeds[a].strength > seeds[b].strength; });
  const PointGrid grid(positions, spacing);
  std::vector<char> covered(seeds.size(), 0);
  std::vector<RidgeSeed> kept;
  for (const int i : order) {
    if (covered[i]) continue;
    grid.ForEachWithin(positions[i], spacing, [&](int j, const Vec3&) { covered[j] = 1; });
    kept.push_back(seeds[i]);
  }
  return kept;
}

// The typical strength of the seeds of one level around each seed.
std::vector<double> UsualStrengths(const std::vector<RidgeSeed>& seeds, double radius) {
  std::vector<Vec3> positions;
  for (const RidgeSeed& seed : seeds) positions.push_back(seed.position);
  const PointGrid grid(positions, radius);
  std::vector<double> usual(seeds.size());
  ParallelFor(0, static_cast<int64_t>(seeds.size()), kGrain, [&](int64_t i) {
    std::vector<double> around;
    grid.ForEachWithin(positions[i], radius, [&](int j, const Vec3&) {
      if (seeds[j].level == seeds[i].level) around.push_back(seeds[j].strength);
    });
    usual[i] = TypicalStrength(std::move(around));
  });
  return usual;
}

// Drops what is no ridge: outliers, which are weaker than the ridge nearby, and saddles between two
// wires, where the principal direction leads across, from one to the other.
std::vector<RidgeSeed> TrueRidgeSeeds(const std::vector<RidgeSeed>& seeds,
                                      const RidgeProjectionOptions& options) {
  const std::vector<double> usual = UsualStrengths(seeds, options.strength_radius);
  std::vector<double> strengths;
  for (const RidgeSeed& seed : seeds) strengths.push_back(seed.strength);
  const double least = options.min_relative_strength * TypicalStrength(std::move(strengths));
  std::vector<RidgeSeed> kept;
  for (size_t i = 0; i < seeds.size(); ++i) {
    const double strength = seeds[i].strength;
    if (strength > least && strength >= options.min_local_strength * usual[i] &&
        seeds[i].elongation <= options.max_elongation) {
      kept.push_back(seeds[i]);
    }
  }
  return kept;
}

}  // namespace

void VisitOptions(RidgeProjectionOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"kernel_sigma", "m", 0.0005, 0.05,
                 "Deviation: width of the density kernel on thin wires; 25 mm as in CurveFusion "
                 "3.2 loses wires, 2 mm makes false junctions."},
                options.kernel_sigma);
  visitor.Visit({"max_sigma", "m", 0.0005, 0.05,
                 "Deviation: width of the kernel on thick wires, which a thin kernel splits into "
                 "strands."},
                options.max_sigma);
  visitor.Visit({"sigma_per_thickness", "", 0, 10,
                 "Deviation: width of the kernel over the rms half width of the points across."},
                options.sigma_per_thickness);
  visitor.Visit({"equalization_radius", "m", 0.0005, 0.1,
                 "Deviation: counts are divided by what is usual within this distance, so that "
                 "parts seen seldom hold their own beside parts seen often."},
                options.equalization_radius);
  visitor.Visit({"least_relative_count", "", 0, 1,
                 "Deviation: what is seen less often than this part of the median stays weak: it "
                 "is outliers."},
                options.least_relative_count);
  visitor.Visit({"iterations", "", 1, 1000, "Deviation: most mean-shift steps of a point."},
                options.iterations);
  visitor.Visit({"spacing", "m", 0.0002, 0.02, "Deviation: least distance of ridge points."},
                options.spacing);
  visitor.Visit({"min_relative_strength", "", 0, 1,
                 "Deviation: ridge points weaker than this part of the typical one are outliers."},
                options.min_relative_strength);
  visitor.Visit({"strength_radius", "m", 0.001, 0.1,
                 "Deviation: neighbourhood in which ridge points are compared."},
                options.strength_radius);
  visitor.Visit({"min_local_strength", "", 0, 1,
                 "Deviation: ridge points weaker than this part of what is typical in their "
                 "neighbourhood lie beyond an end or beside a wire."},
                options.min_local_strength);
  visitor.Visit({"max_elongation", "", 1, 100,
                 "Deviation: greatest variance along a ridge, over that of a uniform curve; it is "
                 "larger between parallel wires."},
                options.max_elongation);
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
  ObservedPoints usable = UsablePoints(points);
  EqualizeCounts(usable, options.equalization_radius, options.least_relative_count);
  const std::vector<DensityField> levels = MakeLevels(usable, options);
  std::vector<RidgeSeed> seeds = MakeSeeds(usable, levels, options);
  ProjectSeeds(levels, MomentsAbout::kMean, kGatheringIterations, seeds);
  seeds = ThinOut(seeds, options.spacing / 2);
  ProjectSeeds(levels, MomentsAbout::kSeed, options.iterations, seeds);
  seeds = ThinOut(seeds, options.spacing);
  RidgePoints ridge;
  for (const RidgeSeed& seed : TrueRidgeSeeds(seeds, options)) {
    ridge.positions.push_back(seed.position);
    ridge.directions.push_back(seed.direction);
    ridge.strengths.push_back(seed.strength);
  }
  return ridge;
}

}  // namespace curvefusion
