#include "meshing/grazing_ways.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kernel/box_pairs.h"
#include "kernel/exact.h"

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

struct AxisSegment {
  int axis, index;
  Segment line;
  double radius;
  double middle;  // arc length
  Vec3 tangent;
};

std::vector<AxisSegment> SegmentsOf(const std::vector<TubeAxis>& axes) {
  std::vector<AxisSegment> segments;
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

// How two segments pass each other: by how much of the sum of the radii they miss touching, and
// the unit vector from the first to the second. Nothing where they do not graze.
struct Passing {
  double miss;
  Vec3 way;
};

std::optional<Passing> PassingOf(const AxisSegment& s, const AxisSegment& t) {
  const double touch = s.radius + t.radius;
  if (s.axis == t.axis && std::abs(s.middle - t.middle) < kReturn * touch / 2) return std::nullopt;
  const ClosestParameters at = ClosestPoints(s.line.a, s.line.b, t.line.a, t.line.b);
  const Vec3 offset =
      t.line.a + at.t * (t.line.b - t.line.a) - s.line.a - at.s * (s.line.b - s.line.a);
  const double distance = offset.norm();
  const double miss = std::abs(distance - touch) / touch;
  if (miss > kBand) return std::nullopt;
  const Vec3 way = offset / distance;
  const double slant = std::max(std::abs(way.dot(s.tangent)), std::abs(way.dot(t.tangent)));
  if (slant > kGreatestSlant) return std::nullopt;
  return Passing{miss, way};
}

}  // namespace

std::vector<std::vector<Vec3>> FindGrazingWays(const std::vector<TubeAxis>& axes) {
  const std::vector<AxisSegment> segments = SegmentsOf(axes);
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const AxisSegment& s : segments) {
    const Vec3 reach = Vec3::Constant((1 + kBand) * s.radius);
    Eigen::AlignedBox3d box(Vec3(s.line.a.cwiseMin(s.line.b) - reach),
                            Vec3(s.line.a.cwiseMax(s.line.b) + reach));
    boxes.push_back(box);
  }
  const BoxTree::Pairs pairs = BoxTree(boxes).OverlappingPairs([&](BoxTree::Pairs& near) {
    std::erase_if(near, [&](const auto& pair) {
      return !PassingOf(segments[pair.first], segments[pair.second]).has_value();
    });
  });
  std::vector<std::vector<Vec3>> ways;
  for (const TubeAxis& axis : axes) ways.emplace_back(axis.points.size() - 1, Vec3::Zero());
  std::vector<double> least_miss(segments.size(), kBand);
  for (const auto& [i, j] : pairs) {
    const Passing passing = *PassingOf(segments[i], segments[j]);
    for (const int k : {i, j}) {
      if (passing.miss > least_miss[k]) continue;
      least_miss[k] = passing.miss;
      ways[segments[k].axis][segments[k].index] = k == i ? passing.way : Vec3(-passing.way);
    }
  }
  return ways;
}

}  // namespace curvefusion
