#include "meshing/tube_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace curvefusion {

namespace {

// Lengths in local radii.
constexpr double kBallSpacing = 0.1;   // the surface of the balls then waves by .001
constexpr int kBallsPerStation = 4;    // cross-sections follow each other by that many balls
constexpr double kReach = 1.25;        // of balls along the axis that reach a cross-section
constexpr double kTangentReach = 1.5;  // along which the direction of the tube is measured, ...
constexpr double kLeastReach = 0.7;    // ... at least, next to an end
// Radians along which the direction is measured. A tube of less turning differs from its envelope
// by less than .01.
constexpr double kLeastTurning = 0.15;
// An arc turns by 2.7 times the bend measured between its halves; noise turns by more than that.
constexpr double kTurningOfBend = 4;
// A curve that turns by more on the whole is a bend and not noise.
constexpr double kGreatestBend = 0.7;
constexpr int kRays = 16;
// An axis is moved by that much at most to reach as far as it should, ...
constexpr double kGreatestMove = 0.1;
// ... as measured so far to either side: half the distance of cross-sections.
constexpr double kReachWindow = 0.2;
// Of the sum of two directions: less is no common direction across the tube.
constexpr double kLeastAgreement = 0.5;
// Radians: cross-sections at a sharper corner are wider than the tube by .06 and more; what turns
// less is noise.
constexpr double kCornerTurn = 0.7;
constexpr double kCornerBend = 0.25;  // what is measured between the halves of such a corner
// A corner is the sharpest turn so far to either side.
constexpr double kCornerReach = 0.7;

// Balls along an axis, with their positions along it.
struct BallRow {
  TubeAxis axis;
  std::vector<double> along;    // arc length, m
  std::vector<double> turning;  // sum of all turns up to the ball, radians

  explicit BallRow(const TubeAxis& of) : axis(SubdivideAxis(of, kBallSpacing)) {
    const Polyline& p = axis.points;
    along.push_back(0);
    turning.push_back(0);
    for (size_t i = 1; i < p.size(); ++i) {
      along.push_back(along.back() + (p[i] - p[i - 1]).norm());
      const bool inner = i + 1 < p.size();
      turning.push_back(turning.back() + (inner ? TurnAngleAt(p, i) : 0.0));
    }
  }

  size_t size() const { return along.size(); }

  // The first ball at or after a place.
  size_t At(double place) const {
    const auto found = std::lower_bound(along.begin(), along.end(), place);
    return std::min(static_cast<size_t>(found - along.begin()), size() - 1);
  }

  double GreatestTurn(size_t first, size_t last) const {
    double greatest = 0;
    for (size_t i = first; i < last; ++i)
      greatest = std::max(greatest, turning[i + 1] - turning[i]);
    return greatest;
  }

  Vec3 MeanOf(size_t first, size_t last) const {
    Vec3 sum = Vec3::Zero();
    for (size_t i = first; i <= last; ++i) sum += axis.points[i];
    return sum / static_cast<double>(last - first + 1);
  }
};

// Where the envelope is wanted: rough, away from the ends, straight on the whole.
struct Station {
  bool is_rough = false;
  bool is_noisy = false;  // rough by more than a bend and a corner
  Vec3 tangent = Vec3::Zero();
};

// The balls to either side along which the direction of the tube is measured.
struct Window {
  double back, ahead;  // m
  size_t first, last;
};

// Nothing next to an end.
std::optional<Window> WindowAt(const BallRow& row, size_t i) {
  const double radius = row.axis.radii[i];
  const double place = row.along[i];
  const double back = std::min(kTangentReach * radius, place);
  const double ahead = std::min(kTangentReach * radius, row.along.back() - place);
  if (std::min(back, ahead) < kLeastReach * radius) return std::nullopt;
  return Window{back, ahead, row.At(place - back), row.At(place + ahead)};
}

// Directions of the tube, noise averaged out.
struct Directions {
  Vec3 before, after;
  double bend() const { return TurnAngle(before, after); }
};

Directions DirectionsAt(const BallRow& row, size_t i, const Window& window) {
  const double place = row.along[i];
  const double core = std::min(window.back, window.ahead) / 3;
  const Vec3 middle = row.MeanOf(row.At(place - core), row.At(place + core));
  return {middle - row.MeanOf(window.first, row.At(place - window.back / 2)),
          row.MeanOf(row.At(place + window.ahead / 2), window.last) - middle};
}

Station ExamineStation(const BallRow& row, size_t i) {
  const std::optional<Window> window = WindowAt(row, i);
  if (!window) return {};
  const double turning = row.turning[window->last] - row.turning[window->first];
  if (turning < kLeastTurning) return {};
  const Directions directions = DirectionsAt(row, i, *window);
  const double bend = directions.bend();
  if (bend > kGreatestBend) return {};
  const double noise =
      turning - row.GreatestTurn(window->first, window->last) - kTurningOfBend * bend;
  return {true, noise > kLeastTurning, (directions.before + directions.after).normalized()};
}

// How far a ray from `from` runs within the balls first..last.
double Extent(const BallRow& row, size_t first, size_t last, const Vec3& from, const Vec3& ray) {
  double extent = 0;
  for (size_t i = first; i <= last; ++i) {
    const Vec3 to_centre = row.axis.points[i] - from;
    const double middle = to_centre.dot(ray);
    const double radius = row.axis.radii[i];
    const double square = radius * radius - to_centre.squaredNorm() + middle * middle;
    if (square > 0) extent = std::max(extent, middle + std::sqrt(square));
  }
  return extent;
}

// The common cross-section of the balls: its centroid and the radius of a circle of its area.
struct CrossSection {
  Vec3 centre;
  double radius;
};

CrossSection CrossSectionAt(const BallRow& row, size_t i, const Vec3& tangent) {
  const double reach = kReach * row.axis.radii[i];
  const size_t first = row.At(row.along[i] - reach);
  const size_t last = row.At(row.along[i] + reach);
  const Vec3 middle = row.MeanOf(first, last);
  const Vec3 from = middle + (row.axis.points[i] - middle).dot(tangent) * tangent;
  const Vec3 u = tangent.unitOrthogonal();
  const Vec3 v = tangent.cross(u);
  double squares = 0;
  Vec3 cubes = Vec3::Zero();
  for (int k = 0; k < kRays; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRays;
    const Vec3 ray = std::cos(angle) * u + std::sin(angle) * v;
    const double extent = Extent(row, first, last, from, ray);
    squares += extent * extent;
    cubes += extent * extent * extent * ray;
  }
  return {from + 2.0 / 3 / squares * cubes, std::sqrt(squares / kRays)};
}

// Points of the fitted axis with the normals of their cross-sections, zero where there is none.
struct FittedRow {
  TubeAxis axis;
  std::vector<Vec3> normals;
};

FittedRow FitCrossSections(const BallRow& row) {
  FittedRow fitted;
  for (size_t i = 0; i < row.size(); ++i) {
    const Station station = ExamineStation(row, i);
    if (station.is_rough && i % kBallsPerStation != 0) continue;
    const CrossSection section = station.is_rough
                                     ? CrossSectionAt(row, i, station.tangent)
                                     : CrossSection{row.axis.points[i], row.axis.radii[i]};
    fitted.axis.points.push_back(section.centre);
    fitted.axis.radii.push_back(section.radius);
    fitted.normals.push_back(station.tangent);
  }
  return fitted;
}

// Takes out what zigzag is left in the centroids without flattening bends (the filter keeps
// parabolas and removes the shortest wave), and from the radii what cross-sections gained because
// they are not quite perpendicular to the axis.
TubeAxis Smoothed(const FittedRow& fitted) {
  TubeAxis smooth = fitted.axis;
  const Polyline& p = fitted.axis.points;
  const auto is_section = [&](size_t i) { return !fitted.normals[i].isZero(); };
  for (size_t i = 2; i + 2 < p.size(); ++i) {
    if (!is_section(i - 2) || !is_section(i - 1) || !is_section(i) || !is_section(i + 1) ||
        !is_section(i + 2)) {
      continue;
    }
    smooth.points[i] = (10 * p[i] + 4 * (p[i - 1] + p[i + 1]) - (p[i - 2] + p[i + 2])) / 16;
  }
  for (size_t i = 1; i + 1 < p.size(); ++i) {
    if (!is_section(i)) continue;
    const Vec3 advance = smooth.points[i + 1] - smooth.points[i - 1];
    smooth.radii[i] *= std::sqrt(std::abs(advance.normalized().dot(fitted.normals[i])));
  }
  return smooth;
}

bool IsRough(const TubeAxis& axis) {
  double turning = 0;
  for (size_t i = 1; i + 1 < axis.points.size(); ++i) turning += TurnAngleAt(axis.points, i);
  return turning >= kLeastTurning;
}

// How far the balls beside a point of the fitted axis reach in a direction perpendicular to the
// tangent.
double ReachOf(const BallRow& row, const Vec3& from, double radius, const Vec3& tangent,
               const Vec3& way) {
  double reach = 0;
  for (size_t k = 0; k < row.size(); ++k) {
    const Vec3 offset = row.axis.points[k] - from;
    if (offset.norm() > radius || std::abs(offset.dot(tangent)) > kReachWindow * radius) continue;
    reach = std::max(reach, offset.dot(way) + row.axis.radii[k]);
  }
  return reach;
}

}  // namespace

TubeAxis FitToEnvelope(const TubeAxis& axis) {
  if (!IsRough(axis)) return axis;
  return Smoothed(FitCrossSections(BallRow(axis)));
}

bool IsNoisy(const TubeAxis& axis) {
  if (!IsRough(axis)) return false;
  const BallRow row(axis);
  for (size_t i = 0; i < row.size(); ++i) {
    if (ExamineStation(row, i).is_noisy) return true;
  }
  return false;
}

std::vector<int> FindCorners(const TubeAxis& axis) {
  std::vector<int> corners;
  if (!IsRough(axis)) return corners;
  const BallRow row(axis);
  const std::vector<double> along = CumulativeLength(axis.points);
  double corner_turn = 0;
  for (size_t i = 1; i + 1 < axis.points.size(); ++i) {
    const double turn = TurnAngleAt(axis.points, i);
    if (turn < kCornerTurn) continue;
    const size_t ball = row.At(along[i]);
    const std::optional<Window> window = WindowAt(row, ball);
    if (!window || DirectionsAt(row, ball, *window).bend() < kCornerBend) continue;
    const bool is_apart =
        corners.empty() || along[i] - along[corners.back()] > kCornerReach * axis.radii[i];
    if (!is_apart && turn <= corner_turn) continue;
    if (!is_apart) corners.pop_back();
    corners.push_back(static_cast<int>(i));
    corner_turn = turn;
  }
  return corners;
}

TubeAxis ReachAsFar(const TubeAxis& axis, TubeAxis fitted, const std::vector<Vec3>& ways) {
  const BallRow row(axis);
  const Polyline points = fitted.points;
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec3 tangent = (points[i + 1] - points[i - 1]).normalized();
    Vec3 way = ways[i - 1] + ways[i];
    way -= way.dot(tangent) * tangent;
    if (way.norm() < kLeastAgreement) continue;
    way.normalize();
    const double radius = fitted.radii[i];
    const double most = kGreatestMove * radius;
    const double excess = ReachOf(row, points[i], radius, tangent, way) - radius;
    fitted.points[i] += std::clamp(excess, -most, most) * way;
  }
  return fitted;
}

}  // namespace curvefusion
