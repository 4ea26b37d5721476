#include "kernel/exact.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

namespace curvefusion {
namespace {

constexpr double kUlp = std::numeric_limits<double>::epsilon();

TEST(Exact, TheLimitItselfIsWithin) {
  const Segment s{{0, 0, 0}, {1, 0, 0}};
  const Segment t{{0, 3, 0}, {1, 3, 0}};
  EXPECT_TRUE(AreWithin(s, t, 3));
  EXPECT_FALSE(AreWithin(s, t, 3 - 2 * kUlp));
}

TEST(Exact, OneUlpApartDoesNotIntersect) {
  const Segment s{{-1, 0, 0}, {1, 0, 0}};
  EXPECT_TRUE(Intersect(s, {{0.25, 0, 0}, {0.25, 1, 0}}));
  EXPECT_FALSE(Intersect(s, {{0.25, kUlp, 0}, {0.25, 1, 0}}));
  EXPECT_FALSE(Intersect(s, {{0.25, -1, 1e-300}, {0.25, 1, 1e-300}}));
}

TEST(Exact, PointsAreSegmentsToo) {
  const Vec3 p(1, 2, 3);
  EXPECT_TRUE(Intersect({p, p}, {p, p}));
  EXPECT_TRUE(AreWithin({p, p}, {p + Vec3(0, 0, 2), p + Vec3(0, 0, 2)}, 2));
  EXPECT_FALSE(AreWithin({p, p}, {p + Vec3(0, -1, 2), p + Vec3(0, 1, 2)}, 1.999));
}

TEST(Exact, CollinearSegmentsThatOverlapIntersect) {
  EXPECT_TRUE(Intersect({{0, 0, 0}, {2, 0, 0}}, {{1, 0, 0}, {3, 0, 0}}));
  EXPECT_FALSE(Intersect({{0, 0, 0}, {2, 0, 0}}, {{2 + 4 * kUlp, 0, 0}, {3, 0, 0}}));
}

TEST(Exact, SegmentsFromOnePointOverlapWhereTheyHaveOneDirection) {
  const Vec3 common(0.1, 0.2, 0.3);
  const Vec3 u(1, 2, -3);
  EXPECT_TRUE(Overlap({0, 0, 0}, u, 2 * u));
  EXPECT_FALSE(Overlap({0, 0, 0}, u, -u));
  EXPECT_FALSE(Overlap({0, 0, 0}, u, u + Vec3(0, 0, 8 * kUlp)));
  EXPECT_TRUE(Overlap(common, common + Vec3(0.5, 0, 0), common + Vec3(0.25, 0, 0)));
}

// Two arms at a right angle, both parametrised by the distance from their common point: the
// nearest points of which the distances sum to at least 2 lie at 1 on both.
TEST(Exact, NearnessBeyondAGapIsDecidedAtTheRightPlace) {
  const Segment s{{0, 0, 0}, {4, 0, 0}};
  const Segment t{{0, 0, 0}, {0, 4, 0}};
  const std::vector<LinearGap> gaps = {{0, 4, 0, 4}};
  const double distance = std::sqrt(2.0);
  EXPECT_TRUE(AreWithinBeyond(s, t, std::nextafter(distance, 2.0), gaps, 2));
  EXPECT_FALSE(AreWithinBeyond(s, t, std::nextafter(distance, 1.0), gaps, 2));
  const ClosestParameters at = ClosestPointsBeyond(s, t, gaps, 2);
  EXPECT_NEAR(at.s, 0.25, 1e-12);
  EXPECT_NEAR(at.t, 0.25, 1e-12);
  EXPECT_FALSE(AreWithinBeyond(s, t, 100, gaps, 8.5));  // no points are that far apart
  EXPECT_TRUE(AreWithinBeyond(s, t, std::sqrt(32.0) + 1e-12, gaps, 8));
  EXPECT_TRUE(AreWithinBeyond(s, t, 0, {}, 0));
}

// Only the far ends of both are as far apart as asked for: a single corner of what is possible.
TEST(Exact, ASingleFarPairOfPointsIsNotTakenForAll) {
  const Segment s{{0, 0, 0}, {1, 0, 0}};
  const Segment t{{1, 0, 0}, {2, 0, 0}};
  const std::vector<LinearGap> gaps = {{0, -1, 1, 2}};
  EXPECT_FALSE(AreWithinBeyond(s, t, 1, gaps, 2));
  EXPECT_TRUE(AreWithinBeyond(s, t, 2, gaps, 2));
}

// Brute force: the least distance over a fine grid of both segments.
TEST(Exact, AgreesWithADenseSearch) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&]() -> Vec3 {
    return {coordinate(random), coordinate(random), coordinate(random)};
  };
  constexpr int kSteps = 60;
  for (int round = 0; round < 200; ++round) {
    const Vec3 a = point(), b = point(), c = point(), d = point();
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j)
        least = std::min(least, (a + (b - a) * i / kSteps - c - (d - c) * j / kSteps).norm());
    const ClosestParameters nearest = ClosestPoints(a, b, c, d);
    const double distance = (a + nearest.s * (b - a) - c - nearest.t * (d - c)).norm();
    // A segment is at most 2 sqrt(3) long: the grid misses the minimum by less than half a step of
    // each.
    EXPECT_LE(distance, least + 1e-12);
    EXPECT_GE(distance, least - 2 * std::sqrt(3.0) / kSteps);
    EXPECT_TRUE(AreWithin({a, b}, {c, d}, distance + 1e-12));
    EXPECT_FALSE(AreWithin({a, b}, {c, d}, distance - 1e-12));
  }
}

// Segments of one plane through the origin with a common point, nearly parallel ones too: integers
// of 44 bits keep the third coordinate, and with it the plane, exact.
struct PlanarPair {
  Segment s;
  Segment t;
};
PlanarPair CrossingPair(std::mt19937& random, double angle) {
  std::uniform_real_distribution<double> coordinate(-0x1p44, 0x1p44);
  std::uniform_real_distribution<double> share(0, 1);
  const Eigen::Vector2d along(coordinate(random), coordinate(random));
  const Eigen::Vector2d centre(coordinate(random), coordinate(random));
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(angle) * along;
  const auto point = [&](const Eigen::Vector2d& direction, double at) -> Vec3 {
    const Eigen::Vector2d p = (centre + at * direction).array().round();
    return {p.x(), p.y(), 3 * p.x() - 2 * p.y()};
  };
  return {{point(along, -share(random)), point(along, share(random))},
          {point(turned, -share(random)), point(turned, share(random))}};
}

// What places of a junction are apart (docs/graph.md): rounding of the lengths, whatever the angle.
TEST(Exact, PlacesOfACommonPointAreApartByRoundingOnlyHoweverSmallTheAngle) {
  std::mt19937 random(1);
  int pairs = 0;
  for (int round = 0; round < 20000; ++round) {
    const auto [s, t] = CrossingPair(random, std::pow(10.0, -13.0 * round / 20000));
    if (!Intersect(s, t)) continue;
    ++pairs;
    const ClosestParameters at = ClosestPoints(s.a, s.b, t.a, t.b);
    const double apart = (s.a + at.s * (s.b - s.a) - t.a - at.t * (t.b - t.a)).norm();
    const double size = (s.b - s.a).norm() + (t.b - t.a).norm() + s.a.norm();
    EXPECT_LE(apart, 4 * kUlp * size) << "pair " << round;  // some ten roundings of half an ulp
  }
  EXPECT_GT(pairs, 5000);
}

}  // namespace
}  // namespace curvefusion
