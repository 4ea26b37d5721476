#include "graph/contraction/ridge_projection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>

#include "graph/contraction/density_kernel.h"
#include "graph/contraction/packed_points.h"
#include "graph/contraction/ridge_scale.h"
#include "kernel/buckets.h"
#include "kernel/parallel.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// Chosen: a tenth of the noise of ridges or less.
constexpr double kConvergedStep = 0.02 * kMillimetre;
constexpr int kGrain = 256;  // for a thread at a time
// Kernel widths grow by this factor from one level to the next. Chosen: the square root of 2, so
// that they double in two.
constexpr double kLevelRatio = std::numbers::sqrt2;
// Chosen: a density is smooth enough for points and seeds this far apart, in kernel widths.
constexpr double kCellPerSigma = 0.7;
// Chosen: a ridge point comes from several seeds, so these may be farther apart than the ridge
// points.
constexpr double kCellPerSpacing = 1.6;
// Chosen: what is usual nearby hardly changes within this part of the radius in which it is.
constexpr double kCellPerRadius = 0.35;
// Chosen: after so many steps most seeds have come together and need not all be followed to the
// end.
constexpr int kGatheringIterations = 3;
constexpr int kIterations = 30;  // chosen: most mean-shift steps of a point
// Chosen: what is seen less often than this part of the median stays weak: it is outliers.
constexpr double kLeastRelativeCount = 0.05;

struct RidgeSeed {
  Vec3 position;
  Vec3 direction = Vec3::Zero();
  double strength = 0;
  double flatness = 0;    ///< 1 where the density is flat across, 0 where it is a thin line
  double elongation = 0;  ///< variance along the direction over that of a uniform curve
  int level = 0;
};

ObservedPoints UsablePoints(const ObservedPoints& points) {
  ObservedPoints usable;
  usable.Reserve(points.size());
  for (size_t i = 0; i < points.size(); ++i) {
    if (points.positions[i].allFinite() && points.viewing_rays[i].allFinite() &&
        points.counts[i] > 0) {
      usable.Add(points, i);
    }
  }
  return usable;
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
  if (points.empty()) return;
  const PackedPoints packed(points.positions, points.counts, radius);
  const Buckets cells = GroupByCell(points.positions, kCellPerRadius * radius);
  std::vector<double> usual(points.size());
  ParallelChunks(0, cells.size(), kGrain, [&](int64_t first, int64_t last) {
    PackedPoints::Neighbours neighbours;
    for (int64_t cell = first; cell < last; ++cell) {
      const std::span<const int> members = cells[cell];
      Vec3 center = Vec3::Zero();
      for (const int i : members) center += points.positions[i];
      center /= static_cast<double>(members.size());
      const BallSums around = packed.SumsWithin(center, radius, neighbours);
      for (const int i : members) usual[i] = around.squared_weight / around.weight;
    }
  });
  const double least = least_relative_count * Median(usual);
  for (size_t i = 0; i < points.size(); ++i) {
    points.counts[i] = static_cast<float>(points.counts[i] / std::max(usual[i], least));
  }
}

// The density at growing kernel widths; wide kernels need fewer points.
std::vector<DensityField> MakeLevels(const ObservedPoints& points,
                                     const RidgeProjectionOptions& options) {
  std::vector<DensityField> levels;
  levels.emplace_back(points, options.kernel_sigma);
  double sigma = kLevelRatio * options.kernel_sigma;
  for (; sigma < 1.01 * options.max_sigma; sigma *= kLevelRatio) {
    levels.emplace_back(ResampleOnGrid(points, kCellPerSigma * sigma), sigma);
  }
  return levels;
}

// Seeds all over the cloud, each of the level that suits the thickness there.
std::vector<RidgeSeed> MakeSeeds(const ObservedPoints& points,
                                 const std::vector<DensityField>& levels,
                                 const RidgeProjectionOptions& options) {
  const double cell =
      std::max(kCellPerSigma * options.kernel_sigma, kCellPerSpacing * options.spacing);
  const std::vector<Vec3> starts = ResampleOnGrid(points, cell).positions;
  RidgeScaleOptions scale;
  scale.sigma = options.kernel_sigma;
  std::vector<double> limits;
  for (size_t level = 0; level + 1 < levels.size(); ++level) {
    limits.push_back(levels[level].sigma() / options.sigma_per_thickness);
  }
  const std::vector<int> level_of_start = LimitsExceeded(points, starts, limits, scale);
  std::vector<RidgeSeed> seeds;
  for (size_t i = 0; i < starts.size(); ++i) {
    seeds.push_back({starts[i], Vec3::Zero(), 0, 0, 0, level_of_start[i]});
  }
  return seeds;
}

// Where the moments are taken about decides at the end of a wire, where the mean lies inward: about
// the seed the principal direction keeps along the wire, but seeds must be near the ridge already.
enum class MomentsAbout { kMean, kSeed };

// The kernel's shape and use in one round of projections.
struct ProjectionRound {
  MomentsAbout about;
  int iterations;
  double stretch;
};

// Variances of the kernel along and across the ridge.
Mat3 KernelCovariance(double sigma, const Vec3& direction, double stretch) {
  return kKernelVariance * sigma * sigma *
         (Mat3::Identity() + (stretch * stretch - 1) * direction * direction.transpose());
}

// The direction of the ridge from the spread of points behind the kernel. What the kernel
// itself does to the spread is taken off, precisions being additive: a long kernel would otherwise
// confirm whatever direction it has.
void UpdateDirection(const Mat3& spread, const Mat3& kernel, double variance_across,
                     RidgeSeed& seed) {
  // Chosen: so that points on a line have a spread across that can be inverted, and flatness stays
  // finite where the precision is negative.
  constexpr double kRegularization = 1e-4;
  constexpr double kLeast = -0.9;
  const Mat3 regular = spread + kRegularization * variance_across * Mat3::Identity();
  const Mat3 precision = regular.inverse() - kernel.inverse();
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect((precision + precision.transpose()) / 2);
  seed.direction = solver.eigenvectors().col(0);
  seed.flatness = 1 / (1 + std::max(kLeast, variance_across * solver.eigenvalues()[1]));
}

void ProjectSeed(const DensityField& field, const ProjectionRound& round, RidgeSeed& seed,
                 DensityField::Neighbours& neighbours) {
  const double variance_across = kKernelVariance * field.sigma() * field.sigma();
  neighbours.Clear();
  for (int iteration = 0; iteration < round.iterations; ++iteration) {
    const KernelMoments moments =
        field.Moments({seed.position, seed.direction, round.stretch}, neighbours);
    seed.strength = moments.weight;
    if (moments.weight <= 0) return;
    const Mat3 kernel = KernelCovariance(field.sigma(), seed.direction, round.stretch);
    const Mat3 about_seed = moments.covariance + moments.mean * moments.mean.transpose();
    UpdateDirection(round.about == MomentsAbout::kSeed ? about_seed : moments.covariance, kernel,
                    variance_across, seed);
    seed.elongation = seed.direction.dot(about_seed * seed.direction) /
                      seed.direction.dot(kernel * seed.direction);
    const Vec3 step = moments.mean - seed.direction.dot(moments.mean) * seed.direction;
    seed.position += step;
    if (step.norm() < kConvergedStep) return;
  }
}

std::vector<Vec3> Positions(const std::vector<RidgeSeed>& seeds) {
  std::vector<Vec3> positions;
  positions.reserve(seeds.size());
  for (const RidgeSeed& seed : seeds) positions.push_back(seed.position);
  return positions;
}

void ProjectSeeds(const std::vector<DensityField>& levels, const ProjectionRound& round,
                  std::vector<RidgeSeed>& seeds) {
  const std::vector<int> order =
      GroupByCell(Positions(seeds), kKernelSupport / 2 * levels[0].sigma()).members;
  ParallelChunks(0, static_cast<int64_t>(seeds.size()), kGrain, [&](int64_t first, int64_t last) {
    std::vector<DensityField::Neighbours> neighbours(levels.size());
    for (int64_t k = first; k < last; ++k) {
      RidgeSeed& seed = seeds[order[k]];
      ProjectSeed(levels[seed.level], round, seed, neighbours[seed.level]);
    }
  });
}

std::vector<RidgeSeed> ThinOut(const std::vector<RidgeSeed>& seeds, double spacing) {
  std::vector<double> strengths;
  for (const RidgeSeed& seed : seeds) strengths.push_back(seed.strength);
  std::vector<RidgeSeed> kept;
  for (const int i : StrongestApart(Positions(seeds), strengths, spacing)) {
    kept.push_back(seeds[i]);
  }
  return kept;
}

// The typical strength of the seeds of one level around each seed.
std::vector<double> UsualStrengths(const std::vector<RidgeSeed>& seeds, double radius) {
  const std::vector<Vec3> positions = Positions(seeds);
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

// Drops what is no ridge: outliers, which are weaker than the ridge nearby, saddles between two
// wires, where the principal direction leads across, from one to the other, and sheets. In the
// widest kernel a thick wire may look like a sheet.
std::vector<RidgeSeed> TrueRidgeSeeds(const std::vector<RidgeSeed>& seeds, int widest_level,
                                      const RidgeProjectionOptions& options) {
  const std::vector<double> usual = UsualStrengths(seeds, options.strength_radius);
  std::vector<double> strengths;
  for (const RidgeSeed& seed : seeds) strengths.push_back(seed.strength);
  const double least = options.min_relative_strength * TypicalStrength(std::move(strengths));
  std::vector<RidgeSeed> kept;
  for (size_t i = 0; i < seeds.size(); ++i) {
    const double strength = seeds[i].strength;
    if (strength > least && strength >= options.min_local_strength * usual[i] &&
        seeds[i].elongation <= options.max_elongation &&
        (seeds[i].flatness <= options.max_flatness || seeds[i].level == widest_level)) {
      kept.push_back(seeds[i]);
    }
  }
  return kept;
}

// Ridges of the density that are not noise beside stronger wires. In the widest kernel the flanks
// of a ridge may be the sides of its own thick wire.
RidgePoints WiresOfTheirOwn(const ObservedPoints& points, const std::vector<RidgeSeed>& seeds,
                            int widest_level, const RidgeContrastOptions& options) {
  std::vector<Vec3> positions, directions;
  for (const RidgeSeed& seed : seeds) {
    positions.push_back(seed.position);
    directions.push_back(seed.direction);
  }
  const std::vector<char> stands_out = StandsOut(points, positions, directions, options);
  RidgePoints ridge;
  for (size_t i = 0; i < seeds.size(); ++i) {
    if (!stands_out[i] && seeds[i].level != widest_level) continue;
    ridge.positions.push_back(seeds[i].position);
    ridge.directions.push_back(seeds[i].direction);
    ridge.strengths.push_back(seeds[i].strength);
    ridge.levels.push_back(seeds[i].level);
  }
  return ridge;
}

// The ridge points to which seeds near ridges lead.
RidgePoints RidgesFrom(const ObservedPoints& observed, const std::vector<DensityField>& levels,
                       std::vector<RidgeSeed> seeds, const RidgeProjectionOptions& options) {
  ProjectSeeds(levels, {MomentsAbout::kSeed, kIterations, options.stretch}, seeds);
  seeds = ThinOut(seeds, options.spacing);
  const int widest_level = static_cast<int>(levels.size()) - 1;
  return WiresOfTheirOwn(observed, TrueRidgeSeeds(seeds, widest_level, options), widest_level,
                         options.contrast);
}

}  // namespace

void VisitOptions(RidgeProjectionOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"kernel_sigma", "m", 0.0005, 0.05,
                 "Deviation: width of the density kernel on thin wires; 25 mm as in CurveFusion "
                 "4.2 loses wires, 2 mm makes false junctions."},
                options.kernel_sigma);
  visitor.Visit({"max_sigma", "m", 0.0005, 0.05,
                 "Deviation: width of the kernel on thick wires, which a thin kernel splits into "
                 "parallel curves."},
                options.max_sigma);
  visitor.Visit({"sigma_per_thickness", "", 0, 10,
                 "Deviation: width of the kernel over the rms half width of the points across."},
                options.sigma_per_thickness);
  visitor.Visit({"spacing", "m", 0.0002, 0.02, "Deviation: least distance of ridge points."},
                options.spacing);
  visitor.Visit({"min_relative_strength", "", 0, 1,
                 "Deviation: ridge points weaker than this part of the typical one are outliers."},
                options.min_relative_strength);
  visitor.Visit({"min_local_strength", "", 0, 1,
                 "Deviation: ridge points weaker than this part of what is typical in their "
                 "neighbourhood lie beyond an end or beside a wire."},
                options.min_local_strength);
  visitor.Visit({"stretch", "", 1, 10,
                 "Deviation: length of the kernel along a ridge over its width across: more points "
                 "steady the curve without blending wires side by side."},
                options.stretch);
  visitor.Visit({"max_flatness", "", 0, 10,
                 "Deviation: a ridge this flat across, 1 being as flat as a sheet, is none."},
                options.max_flatness);
  visitor.Visit({"max_elongation", "", 1, 100,
                 "Deviation: greatest variance along a ridge, over that of a uniform curve; it is "
                 "larger between parallel wires."},
                options.max_elongation);
  VisitOptions(options.contrast, visitor);
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
  const ObservedPoints observed = UsablePoints(points);
  ObservedPoints usable = observed;
  EqualizeCounts(usable, options.equalization_radius, kLeastRelativeCount);
  const std::vector<DensityField> levels = MakeLevels(usable, options);
  std::vector<RidgeSeed> seeds = MakeSeeds(usable, levels, options);
  // Step by step, so that seeds that share their neighbours follow one another.
  for (int i = 0; i < kGatheringIterations; ++i) {
    ProjectSeeds(levels, {MomentsAbout::kMean, 1, 1}, seeds);
  }
  return RidgesFrom(observed, levels, ThinOut(seeds, options.spacing / 2), options);
}

RidgePoints FollowRidges(const ObservedPoints& points, const RidgePoints& before,
                         const RidgeProjectionOptions& options) {
  const ObservedPoints observed = UsablePoints(points);
  ObservedPoints usable = observed;
  EqualizeCounts(usable, options.equalization_radius, kLeastRelativeCount);
  std::vector<RidgeSeed> seeds;
  for (size_t i = 0; i < before.size(); ++i) {
    // Those between close the gaps that thinning out would widen from time to time.
    for (const double along : {-0.5, 0.0, 0.5}) {
      const Vec3 place = before.positions[i] + along * options.spacing * before.directions[i];
      const double strength = 1 - std::abs(along);
      seeds.push_back({place, before.directions[i], strength, 0, 0, before.levels[i]});
    }
  }
  // Neighbours have half-way seeds in the same place.
  seeds = ThinOut(seeds, 0.4 * options.spacing);
  return RidgesFrom(observed, MakeLevels(usable, options), std::move(seeds), options);
}

}  // namespace curvefusion
