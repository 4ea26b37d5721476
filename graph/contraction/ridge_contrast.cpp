#include "graph/contraction/ridge_contrast.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "kernel/parallel.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

constexpr int kGrain = 32;
constexpr int kDirectionsAcross = 4;
// Rays of points agree where their mean, without its part along the ridge, is longer than this.
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

// Of two opposite sides the emptier one, in the direction across in which that is fullest. A depth
// camera scatters the points of a wire along its viewing ray, so where that is known only the sides
// of the wire as seen by the camera count.
double FullestFlank(const PointGrid& grid, const ObservedPoints& points, const Vec3& place,
                    const Vec3& direction, const RidgeContrastOptions& options) {
  const Vec3 beside = direction.cross(MeanRay(grid, points, place, options.ball_radius));
  const bool is_seen = beside.norm() > kLeastRay;
  const Vec3 first = is_seen ? beside.normalized() : direction.unitOrthogonal();
  const Vec3 second = direction.cross(first);
  double fullest = 0;
  for (int k = 0; k < (is_seen ? 1 : kDirectionsAcross); ++k) {
    const double angle = std::numbers::pi * k / kDirectionsAcross;
    const Vec3 side = options.flank_distance * (std::cos(angle) * first + std::sin(angle) * second);
    const double one = CountWithin(grid, points.counts, place + side, options.ball_radius);
    if (one <= fullest) continue;
    const double other = CountWithin(grid, points.counts, place - side, options.ball_radius);
    fullest = std::max(fullest, std::min(one, other));
  }
  return fullest;
}

}  // namespace

void VisitOptions(RidgeContrastOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"min_share", "", 0, 1,
                 "Deviation: a ridge is weak with less than this part of the points of the best "
                 "one nearby."},
                options.min_share);
}

std::vector<char> StandsOut(const ObservedPoints& points, const std::vector<Vec3>& places,
                            const std::vector<Vec3>& directions,
                            const RidgeContrastOptions& options) {
  assert(directions.size() == places.size());
  const auto n = static_cast<int64_t>(places.size());
  const PointGrid grid(points.positions, options.ball_radius);
  std::vector<double> own(places.size());
  ParallelFor(0, n, kGrain, [&](int64_t i) {
    own[i] = CountWithin(grid, points.counts, places[i], options.ball_radius);
  });
  const PointGrid places_grid(places, options.neighbourhood);
  std::vector<char> stands_out(places.size(), 1);
  ParallelFor(0, n, kGrain, [&](int64_t i) {
    double best = 0;
    places_grid.ForEachWithin(places[i], options.neighbourhood,
                              [&](int j, const Vec3&) { best = std::max(best, own[j]); });
    if (own[i] >= options.min_share * best) return;
    stands_out[i] =
        FullestFlank(grid, points, places[i], directions[i], options) <= kMaxFlank * own[i];
  });
  return stands_out;
}

}  // namespace curvefusion
