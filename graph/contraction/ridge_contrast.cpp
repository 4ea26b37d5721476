#include "graph/contraction/ridge_contrast.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "kernel/parallel.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

// Chosen.
constexpr int kGrain = 32;            // places for a thread at a time
constexpr int kDirectionsAcross = 4;  // 45 degrees apart
// Chosen: rays of points agree where their mean, without its part along the ridge, is longer than
// this.
constexpr double kLeastRay = 0.5;
// Chosen: a weak ridge of which both sides hold more than this part of its own points is noise.
constexpr double kMaxFlank = 0.3;

// What was seen of a place.
double CountWithin(const PointGrid& grid, const std::vector<float>& counts, const Vec3& center,
                   double radius) {
  double sum = 0;
  grid.ForEachWithin(center, radius, [&](int i, const Vec3&) { sum += counts[i]; });
  return sum;
}

// The mean viewing ray of the points in a ball, the longer the more they agree.
Vec3 MeanRay(const PointGrid& grid, const ObservedPoints& points, const Vec3& center,
             double radius) {
  Vec3 sum = Vec3::Zero();
  double count = 0;
  grid.ForEachWithin(center, radius, [&](int i, const Vec3&) {
    sum += points.counts[i] * points.viewing_rays[i];
    count += points.counts[i];
  });
  return count > 0 ? Vec3(sum / count) : sum;
}

}  // namespace

void VisitOptions(RidgeContrastOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"min_share", "", 0, 1,
                 "Deviation: a ridge is weak with less than this part of the points of the best "
                 "one nearby."},
                options.min_share);
}

RidgeContrast::RidgeContrast(const ObservedPoints& points, const PointGrid& grid,
                             const std::vector<Vec3>& places, const std::vector<Vec3>& directions,
                             const RidgeContrastOptions& options)
    : points_(points),
      places_(places),
      directions_(directions),
      options_(options),
      grid_(grid),
      own_(places.size()),
      best_(places.size()) {
  assert(directions.size() == places.size());
  const auto n = static_cast<int64_t>(places.size());
  ParallelFor(0, n, kGrain, [&](int64_t i) {
    own_[i] = CountWithin(grid_, points.counts, places[i], options.ball_radius);
  });
  const PointGrid places_grid(places, options.neighbourhood);
  ParallelFor(0, n, kGrain, [&](int64_t i) {
    places_grid.ForEachWithin(places[i], options.neighbourhood,
                              [&](int j, const Vec3&) { best_[i] = std::max(best_[i], own_[j]); });
  });
}

// A depth camera scatters the points of a wire along its viewing ray.
double RidgeContrast::Flank(size_t place, RidgeSides sides) const {
  const Vec3& at = places_[place];
  const Vec3& direction = directions_[place];
  const double radius = options_.ball_radius;
  Vec3 beside = Vec3::Zero();
  if (sides == RidgeSides::kSeen) beside = direction.cross(MeanRay(grid_, points_, at, radius));
  const bool is_seen = beside.norm() > kLeastRay;
  const Vec3 first = is_seen ? beside.normalized() : direction.unitOrthogonal();
  const Vec3 second = direction.cross(first);
  double fullest = 0;
  for (int k = 0; k < (is_seen ? 1 : kDirectionsAcross); ++k) {
    const double angle = std::numbers::pi * k / kDirectionsAcross;
    const Vec3 side =
        options_.flank_distance * (std::cos(angle) * first + std::sin(angle) * second);
    const double one = CountWithin(grid_, points_.counts, at + side, radius);
    if (one <= fullest) continue;
    fullest =
        std::max(fullest, std::min(one, CountWithin(grid_, points_.counts, at - side, radius)));
  }
  return fullest;
}

std::vector<char> StandsOut(const ObservedPoints& points, const std::vector<Vec3>& places,
                            const std::vector<Vec3>& directions,
                            const RidgeContrastOptions& options) {
  const PointGrid grid(points.positions, options.ball_radius);
  const RidgeContrast contrast(points, grid, places, directions, options);
  std::vector<char> stands_out(places.size(), 1);
  ParallelFor(0, static_cast<int64_t>(places.size()), kGrain, [&](int64_t i) {
    if (contrast.Own(i) >= options.min_share * contrast.Best(i)) return;
    stands_out[i] = contrast.Flank(i, RidgeSides::kSeen) <= kMaxFlank * contrast.Own(i);
  });
  return stands_out;
}

}  // namespace curvefusion
