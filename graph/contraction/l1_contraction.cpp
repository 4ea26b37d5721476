#include "graph/contraction/l1_contraction.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cstdint>

#include "graph/contraction/l1_neighbourhood.h"
#include "kernel/parallel.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr int64_t kGrain = 64;  // points for a thread at a time; chosen

// The principal direction of a covariance and its share of the variance; 1/3 for no variance.
struct Anisotropy {
  Vec3 direction = Vec3::UnitX();
  double directionality = 1.0 / 3;
};

Anisotropy AnisotropyOf(const Mat3& covariance) {
  const double trace = covariance.trace();
  if (!(trace > 0)) return {};
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(covariance / trace);
  return {solver.eigenvectors().col(2), std::clamp(solver.eigenvalues()(2), 1.0 / 3, 1.0)};
}

// A subset in which no two points are nearer than `spacing` and every point has one within it.
std::vector<Vec3> WellSpreadSubset(const std::vector<Vec3>& points, const PointIndex& index,
                                   double spacing) {
  std::vector<Vec3> subset;
  std::vector<char> covered(points.size(), 0);
  std::vector<int> neighbours;
  for (size_t i = 0; i < points.size(); ++i) {
    if (covered[i]) continue;
    subset.push_back(points[i]);
    index.WithinRadius(points[i], spacing, neighbours);
    for (const int j : neighbours) covered[j] = 1;
  }
  return subset;
}

// 1 / d_j of the weighted local density (Huang et al. 2013, 3.2): dense parts do not outweigh.
std::vector<float> InverseDensities(const std::vector<Vec3>& points, double radius) {
  // Densities take no distances, so any softening will do.
  const L1Neighbourhood around(points, std::vector<float>(points.size(), 1), radius, radius);
  std::vector<float> weights(points.size());
  ParallelChunks(0, static_cast<int64_t>(points.size()), kGrain, [&](int64_t first, int64_t last) {
    PackedPoints::Neighbours neighbours;
    for (int64_t i = first; i < last; ++i) {
      weights[i] = static_cast<float>(1 / around.DensityAt(points[i], neighbours));
    }
  });
  return weights;
}

// The contraction in progress. One instance per cloud; Contract() is called once per radius.
class Contraction {
 public:
  Contraction(const std::vector<Vec3>& points, const L1Options& options);

  // Moves the free samples until they rest.
  void Contract(double radius);

  // Samples whose neighbourhood is a line stay from now on.
  void FixBranches();

  ContractedSamples Result() const;

 private:
  double Step(double radius, const L1Neighbourhood& points);

  const std::vector<Vec3>& points_;
  const L1Options& options_;
  std::vector<float> point_weights_;
  double softening_;

  std::vector<Vec3> samples_;
  std::vector<Vec3> moved_samples_;
  std::vector<Anisotropy> anisotropies_;
  std::vector<char> fixed_;
};

Contraction::Contraction(const std::vector<Vec3>& points, const L1Options& options)
    : points_(points), options_(options) {
  const PointIndex index(points);
  const double spacing = options.sample_spacing * options.initial_radius;
  softening_ = 0.1 * spacing;  // samples start on points, where 1 / r has no value
  point_weights_ = InverseDensities(points, spacing);
  std::vector<int> neighbours;
  for (const Vec3& p : WellSpreadSubset(points, index, spacing)) {
    index.WithinRadius(p, options.initial_radius, neighbours);
    if (static_cast<int>(neighbours.size()) > options.minimum_neighbours) samples_.push_back(p);
  }
  moved_samples_ = samples_;
  anisotropies_.resize(samples_.size());
  fixed_.assign(samples_.size(), 0);
}

// One fixed-point iteration; returns the mean movement of the free samples.
double Contraction::Step(double radius, const L1Neighbourhood& points) {
  const L1Neighbourhood others(samples_, std::vector<float>(samples_.size(), 1), radius,
                               softening_);
  const int64_t n = static_cast<int64_t>(samples_.size());
  ParallelChunks(0, n, kGrain, [&](int64_t first, int64_t last) {
    PackedPoints::Neighbours near_points, near_samples;
    for (int64_t i = first; i < last; ++i) {
      if (fixed_[i]) continue;
      const Vec3& sample = samples_[i];
      const L1Neighbourhood::Repulsion repulsion = others.RepulsionAt(sample, near_samples);
      const Anisotropy anisotropy = AnisotropyOf(repulsion.covariance);
      // The part along the curve counts: across it the median alone decides.
      const double along = anisotropy.direction.dot(repulsion.offset);
      moved_samples_[i] =
          points.StepToMedian(sample, near_points) +
          options_.repulsion * anisotropy.directionality * along * anisotropy.direction;
      anisotropies_[i] = anisotropy;
    }
  });
  double movement = 0;
  int64_t free_samples = 0;
  for (int64_t i = 0; i < n; ++i) {
    movement += (moved_samples_[i] - samples_[i]).norm();
    free_samples += !fixed_[i];
  }
  samples_ = moved_samples_;
  return free_samples > 0 ? movement / static_cast<double>(free_samples) : 0;
}

void Contraction::Contract(double radius) {
  const L1Neighbourhood points(points_, point_weights_, radius, softening_);
  for (int iteration = 0; iteration < options_.maximum_iterations; ++iteration) {
    const double movement = Step(radius, points);
    if (movement < options_.convergence * radius) break;
  }
}

// A sample and its five nearest, over which Huang et al. 2013, 4.2 smooth sigma.
constexpr int kSmoothedNeighbours = 6;

void Contraction::FixBranches() {
  const PointIndex sample_index(samples_);
  std::vector<double> smoothed(samples_.size());
  ParallelFor(0, static_cast<int64_t>(samples_.size()), kGrain, [&](int64_t i) {
    double sum = 0;
    const std::vector<int> nearest = sample_index.NearestK(samples_[i], kSmoothedNeighbours);
    for (const int j : nearest) sum += anisotropies_[j].directionality;
    smoothed[i] = sum / static_cast<double>(nearest.size());
  });
  for (size_t i = 0; i < samples_.size(); ++i) {
    if (fixed_[i]) continue;
    anisotropies_[i].directionality = smoothed[i];
    fixed_[i] = smoothed[i] >= options_.tracing.branch_directionality;
  }
}

ContractedSamples Contraction::Result() const {
  ContractedSamples result;
  result.positions = samples_;
  result.spacing = options_.sample_spacing * options_.initial_radius;
  for (const Anisotropy& anisotropy : anisotropies_) {
    result.directions.push_back(anisotropy.direction);
    result.directionality.push_back(anisotropy.directionality);
  }
  return result;
}

}  // namespace

L1Options OptionsForRadius(double initial_radius, L1Options options) {
  const double factor = initial_radius / options.initial_radius;
  options.initial_radius *= factor;
  options.maximum_radius *= factor;
  options.growth *= factor;
  return options;
}

void VisitOptions(L1Options& options, OptionVisitor& visitor) {
  visitor.Visit(
      {"initial_radius", "m", 1e-4, 1e3, "Radius of the neighbourhoods at first. CurveFusion 4.2."},
      options.initial_radius);
  visitor.Visit(
      {"maximum_radius", "m", 1e-4, 1e3, "Radius of the neighbourhoods at last. CurveFusion 4.2."},
      options.maximum_radius);
  visitor.Visit({"growth", "m", 1e-5, 1e3,
                 "The radius grows by so much whenever contraction has come to rest. CurveFusion "
                 "4.2 without a number; Huang et al. 2013, 4.1 have half the initial radius."},
                options.growth);
  visitor.Visit({"sample_spacing", "radii", 0.01, 1.0,
                 "Distance of the samples before contraction, as a multiple of initial_radius. "
                 "Deviation: Huang et al. 2013 draw samples at random; evenly spread ones leave no "
                 "gaps."},
                options.sample_spacing);
  visitor.Visit({"repulsion", "", 0.0, 0.5,
                 "Strength mu of the repulsion between samples. Huang et al. 2013, Eq. 7. "
                 "Deviation: only along the dominant direction, which keeps the samples on the "
                 "curve."},
                options.repulsion);
  visitor.Visit({"minimum_neighbours", "points", 0, 1000,
                 "A sample with fewer other points within initial_radius is noise. Choice of this "
                 "implementation."},
                options.minimum_neighbours);
  visitor.Visit({"maximum_iterations", "", 1, 1000,
                 "Iterations for one radius at most. Choice of this implementation."},
                options.maximum_iterations);
  visitor.Visit({"convergence", "radii", 0.0, 1.0,
                 "Contraction rests when samples move by less on average, as a multiple of the "
                 "radius. Choice of this implementation."},
                options.convergence);
  VisitOptions(options.tracing, visitor);
}

ContractedSamples ContractToMedian(const ObservedPoints& points, const L1Options& options) {
  assert(options.initial_radius > 0 && options.growth > 0);
  RequireFinitePositions(points);
  Contraction contraction(points.positions, options);
  // Scaled options may miss the last radius by rounding.
  const double last_radius = options.maximum_radius * (1 - 1e-9);
  for (double radius = options.initial_radius;; radius += options.growth) {
    contraction.Contract(
        std::min(radius, std::max(options.initial_radius, options.maximum_radius)));
    contraction.FixBranches();
    if (radius >= last_radius) break;
  }
  return contraction.Result();
}

SkeletonGraph ExtractL1Skeleton(const ObservedPoints& points, const L1Options& options) {
  return TraceBranches(ContractToMedian(points, options), options.tracing);
}

}  // namespace curvefusion
