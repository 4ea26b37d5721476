#include "meshing/rough_stretches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/angle.h"
#include "kernel/exact.h"
#include "kernel/parallel.h"
#include "meshing/contacts.h"

namespace curvefusion {

namespace {

// In radii.
constexpr double kBallSpacing = 0.1;  // the surface of the balls then waves by .001
// Balls along the curve that reach the rings of a segment.
constexpr double kReach = 1.25;
// The axis of a tube lies so near its curve; farther off is another stretch of the same curve.
constexpr double kGreatestOffset = 0.6;
// A stretch is straight within this, far below what the corners of polygons stand out.
constexpr double kStraight = 0.003;

// Radians between the halves of a row of balls.
constexpr double kTightBend = 1;

// A segment of a path.
struct Stretch {
  Vec3 a, b;
  double radius_a, radius_b;

  double radius() const { return std::max(radius_a, radius_b); }

  double DistanceTo(const Vec3& p) const {
    return (a + ClosestParameter(a, b, p) * (b - a) - p).norm();
  }

  // Whether a point of a curve lies on the line through the segment, with its radius.
  bool Holds(const Vec3& p, double radius_there) const {
    const Vec3 direction = (b - a).normalized();
    const Vec3 offset = p - a - direction.dot(p - a) * direction;
    const double change =
        std::max(std::abs(radius_there - radius_a), std::abs(radius_there - radius_b));
    return std::max(offset.norm(), change) <= kStraight * radius();
  }
};

// The parts of a curve that run beside a segment; one over the start of a closed curve is whole.
std::vector<TubeAxis> PartsBeside(const Stretch& segment, const TubeAxis& curve) {
  const double reach = kReach * segment.radius();
  std::vector<TubeAxis> parts;
  const int count = static_cast<int>(curve.points.size()) - 1;
  for (int first = 0; first < count; ++first) {
    int last = first;
    double nearest = std::numeric_limits<double>::infinity();
    for (; last < count; ++last) {
      const double distance =
          ClosestDistance({segment.a, segment.b}, {curve.points[last], curve.points[last + 1]});
      if (distance > reach) break;
      nearest = std::min(nearest, distance);
    }
    if (nearest < kGreatestOffset * segment.radius()) parts.push_back(Slice(curve, first, last));
    first = last;
  }
  const bool meet = parts.size() > 1 && parts.back().points.back() == parts.front().points.front();
  if (meet) {
    AppendAxis(parts.front(), parts.back());
    parts.erase(parts.begin());
  }
  return parts;
}

bool IsStraight(const Stretch& segment, const TubeAxis& part) {
  for (size_t i = 0; i < part.points.size(); ++i) {
    if (!segment.Holds(part.points[i], part.radii[i])) return false;
  }
  return true;
}

TubeAxis BallsAlong(const Stretch& segment, const TubeAxis& part) {
  const TubeAxis fine = SubdivideAxis(part, kBallSpacing);
  TubeAxis balls;
  for (size_t i = 0; i < fine.points.size(); ++i) {
    if (segment.DistanceTo(fine.points[i]) > kReach * segment.radius()) continue;
    balls.points.push_back(fine.points[i]);
    balls.radii.push_back(fine.radii[i]);
  }
  return balls;
}

// Whether a row of balls turns so much that no ray from an axis tells where its surface is.
bool BendsTightly(const Polyline& row) {
  if (row.size() < 3) return false;
  const Vec3& middle = row[row.size() / 2];
  return AngleBetween(middle - row.front(), row.back() - middle) > kTightBend;
}

TubeAxis BallsBeside(const Stretch& segment, const std::vector<int>& own,
                     const std::vector<TubeAxis>& curves) {
  std::vector<TubeAxis> parts;
  for (const int curve : own) {
    for (TubeAxis& part : PartsBeside(segment, curves[curve])) parts.push_back(std::move(part));
  }
  TubeAxis balls;
  if (std::all_of(parts.begin(), parts.end(),
                  [&](const TubeAxis& part) { return IsStraight(segment, part); })) {
    return balls;
  }
  for (const TubeAxis& part : parts) {
    const TubeAxis row = BallsAlong(segment, part);
    if (BendsTightly(row.points)) return {};
    AppendAxis(row, balls);
  }
  return balls;
}

}  // namespace

std::vector<std::vector<TubeAxis>> FindRoughStretches(const std::vector<TubePath>& paths,
                                                      const std::vector<TubeAxis>& curves) {
  const std::vector<std::vector<char>> grazing = FindGrazingSegments(paths);
  std::vector<std::vector<TubeAxis>> balls(paths.size());
  ParallelFor(0, static_cast<int64_t>(paths.size()), 1, [&](int64_t k) {
    const auto& [points, radii] = paths[k].axis;
    balls[k].resize(grazing[k].size());
    for (size_t i = 0; i < grazing[k].size(); ++i) {
      const size_t next = (i + 1) % points.size();
      const Stretch segment{points[i], points[next], radii[i], radii[next]};
      if (grazing[k][i]) balls[k][i] = BallsBeside(segment, paths[k].curves, curves);
    }
  });
  return balls;
}

}  // namespace curvefusion
