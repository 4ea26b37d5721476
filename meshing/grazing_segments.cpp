#include "meshing/grazing_segments.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "kernel/box_pairs.h"
#include "meshing/closest_approach.h"

namespace curvefusion {

namespace {

// Of the sum of the radii. Simplified axes of noisy curves err by up to .07 r in places, and
// polygons by .013 r: both tubes together by more than this in no network seen.
constexpr double kBand = 0.06;
// The cosine of the angle between a tube and the shortest way to the other one: 0 where they pass
// each other, more where they come together at a node (.5 for two that enclose 60 degrees).
constexpr double kGreatestSlant = 0.3;
// In radii, to either side: noise does not turn a chord of that length.
constexpr double kTangentReach = 1.5;
// In radii along a tube: what is nearer than that is a bend and no return.
constexpr double kReturn = 4;

struct Segment {
  int axis, index;
  LineSegment line;
  double radius;
  double middle;  // arc length
  Vec3 tangent;
};

std::vector<Segment> SegmentsOf(const std::vector<TubeAxis>& axes) {
  std::vector<Segment> segments;
  for (size_t k = 0; k < axes.size(); ++k) {
    const auto& [points, radii] = axes[k];
    const std::vector<double> along = CumulativeLength(points);
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const double radius = std::max(radii[i], radii[i + 1]);
      const double middle = (along[i] + along[i + 1]) / 2;
      const Vec3 chord = PointAt(points, along, middle + kTangentReach * radius) -
                         PointAt(points, along, middle - kTangentReach * radius);
      segments.push_back({static_cast<int>(k),
                          static_cast<int>(i),
                          {points[i], points[i + 1]},
                          radius,
                          middle,
                          chord.normalized()});
    }
  }
  return segments;
}

bool Graze(const Segment& s, const Segment& t) {
  const double touch = s.radius + t.radius;
  if (s.axis == t.axis && std::abs(s.middle - t.middle) < kReturn * touch / 2) return false;
  const ClosestApproach closest = FindClosestApproach(s.line, t.line);
  if (std::abs(closest.distance - touch) > kBand * touch) return false;
  const Vec3 way = (closest.on_second - closest.on_first) / closest.distance;
  return std::abs(way.dot(s.tangent)) <= kGreatestSlant &&
         std::abs(way.dot(t.tangent)) <= kGreatestSlant;
}

}  // namespace

std::vector<std::vector<char>> FindGrazingSegments(const std::vector<TubeAxis>& axes) {
  const std::vector<Segment> segments = SegmentsOf(axes);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const Segment& s : segments) {
    const Vec3 reach = Vec3::Constant((1 + kBand) * s.radius);
    Eigen::AlignedBox3d box(Vec3(s.line.a.cwiseMin(s.line.b) - reach),
                            Vec3(s.line.a.cwiseMax(s.line.b) + reach));
    boxes.push_back(box);
  }
  const BoxTree::Pairs pairs = BoxTree(boxes).OverlappingPairs(
      [&](int i, int j) { return Graze(segments[i], segments[j]); });
  std::vector<std::vector<char>> grazing;
  for (const TubeAxis& axis : axes) grazing.emplace_back(axis.points.size() - 1, 0);
  for (const auto& [i, j] : pairs) {
    for (const int k : {i, j}) grazing[segments[k].axis][segments[k].index] = 1;
  }
  return grazing;
}

}  // namespace curvefusion
