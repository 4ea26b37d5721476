#include "meshing/tube_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "kernel/angle.h"
#include "meshing/ball_rings.h"

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
// A curve that turns by more on the whole is a bend and not noise.
constexpr double kGreatestBend = 0.7;
constexpr int kRays = 16;
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

  Vec3 MeanOf(size_t first, size_t last) const {
    Vec3 sum = Vec3::Zero();
    for (size_t i = first; i <= last; ++i) sum += axis.points[i];
    return sum / static_cast<double>(last - first + 1);
  }
};

// Where the envelope is wanted: rough, away from the ends, straight on the whole.
struct Station {
  bool is_rough = false;
  Vec3 tangent = Vec3::Zero();
};

Station ExamineStation(const BallRow& row, size_t i) {
  const double radius = row.axis.radii[i];
  const double place = row.along[i];
  const double back = std::min(kTangentReach * radius, place);
  const double ahead = std::min(kTangentReach * radius, row.along.back() - place);
  if (std::min(back, ahead) < kLeastReach * radius) return {};
  const size_t first = row.At(place - back);
  const size_t last = row.At(place + ahead);
  if (row.turning[last] - row.turning[first] < kLeastTurning) return {};
  const double core = std::min(back, ahead) / 3;
  const Vec3 middle = row.MeanOf(row.At(place - core), row.At(place + core));
  const Vec3 before = middle - row.MeanOf(first, row.At(place - back / 2));
  const Vec3 after = row.MeanOf(row.At(place + ahead / 2), last) - middle;
  if (AngleBetween(before, after) > kGreatestBend) return {};
  return {true, (before + after).normalized()};
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
  const TubeAxis balls = Slice(row.axis, static_cast<int>(first), static_cast<int>(last));
  double squares = 0;
  Vec3 cubes = Vec3::Zero();
  for (int k = 0; k < kRays; ++k) {
    const double angle = 2 * std::numbers::pi * k / kRays;
    const Vec3 ray = std::cos(angle) * u + std::sin(angle) * v;
    const double extent = ExtentOfBalls(balls, from, ray);
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

}  // namespace

TubeAxis FitToEnvelope(const TubeAxis& axis) {
  if (!IsRough(axis)) return axis;
  return Smoothed(FitCrossSections(BallRow(axis)));
}

}  // namespace curvefusion
