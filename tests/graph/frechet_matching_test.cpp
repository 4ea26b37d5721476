#include "graph/frechet_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

// Fréchet distance of the points of two curves alone, by dynamic programming: that of the curves
// but for half the longest segment.
double DiscreteDistance(const Polyline& a, const Polyline& b) {
  std::vector<double> least(b.size(), std::numeric_limits<double>::infinity());
  for (size_t i = 0; i < a.size(); ++i) {
    double before = i == 0 ? 0 : std::numeric_limits<double>::infinity();  // at i - 1, j - 1
    for (size_t j = 0; j < b.size(); ++j) {
      const double above = least[j];
      const double reached = std::min({before, above, j > 0 ? least[j - 1] : above});
      before = above;
      least[j] = std::max(reached, (a[i] - b[j]).norm());
    }
  }
  return least.back();
}

class CurveMaker {
 public:
  explicit CurveMaker(unsigned seed) : random_(seed) {}

  Vec3 Vector(double size) {
    std::uniform_real_distribution<double> range(-size, size);
    return {range(random_), range(random_), range(random_)};
  }
  // A random walk that often turns back.
  Polyline Curve(int points) {
    Polyline curve = {Vector(1)};
    while (static_cast<int>(curve.size()) < points) curve.push_back(curve.back() + Vector(1));
    return curve;
  }
  // Other points on about the same curve, sometimes with a turn back.
  Polyline Disturbed(const Polyline& curve, double size) {
    Polyline disturbed;
    for (const Vec3& p : curve) {
      disturbed.push_back(p + Vector(size));
      if (Vector(1).x() > 0.3) disturbed.push_back(disturbed.back() + Vector(3 * size));
    }
    return disturbed;
  }

 private:
  std::mt19937 random_;
};

TEST(MatchInOrder, AgreesWithADenseSearch) {
  constexpr double kStep = 0.01;  // so discrete distances are right to half of it
  CurveMaker maker(1);
  int apart = 0;
  for (int i = 0; i < 60; ++i) {
    const Polyline a = maker.Curve(2 + i % 6);
    const Polyline b = maker.Disturbed(a, 0.2);
    const double distance = DiscreteDistance(Resample(a, kStep), Resample(b, kStep));
    // Resampling cuts corners, by half a step at most.
    EXPECT_TRUE(MatchInOrder(a, b, distance + kStep)) << i;
    EXPECT_FALSE(MatchInOrder(a, b, distance - kStep)) << i;
    EXPECT_TRUE(MatchInOrder(b, a, distance + kStep)) << i;
    EXPECT_FALSE(MatchInOrder(b, a, distance - kStep)) << i;
    // Where each curve is near the other point by point, but not in order.
    const auto is_near = [&](const Polyline& c, const Polyline& d) {
      return std::all_of(c.begin(), c.end(),
                         [&](const Vec3& p) { return Project(d, p).distance < distance - kStep; });
    };
    apart += is_near(a, b) && is_near(b, a);
  }
  EXPECT_GT(apart, 5);
}

TEST(MatchInOrder, PlacesAscendWithinTheDistance) {
  CurveMaker maker(2);
  int matched = 0;
  for (int i = 0; i < 100; ++i) {
    const Polyline a = maker.Curve(8);
    const Polyline b = maker.Disturbed(a, 0.2);
    const auto places = MatchInOrder(a, b, 0.5);
    if (!places) continue;
    ++matched;
    ASSERT_EQ(places->size(), a.size());
    double last = 0;
    for (size_t k = 0; k < a.size(); ++k) {
      const auto& [segment, parameter] = (*places)[k];
      const Vec3 there = b[segment] + parameter * (b[segment + 1] - b[segment]);
      EXPECT_LE((there - a[k]).norm(), 0.5 * (1 + 1e-12));  // rounding
      EXPECT_GE(static_cast<double>(segment) + parameter, last - 1e-12);
      last = static_cast<double>(segment) + parameter;
    }
  }
  EXPECT_GT(matched, 10);
}

TEST(MatchInOrder, ATurnBackWithinOneSegmentCounts) {
  const Polyline straight = {{0, 0, 0}, {10, 0, 0}};
  const Polyline forth_and_back = {{0, 0, 0}, {8, 0, 0}, {2, 0, 0}, {10, 0, 0}};
  const double limit = 3;  // both points of the turn meet the straight one half way
  for (const double distance : {limit, std::nextafter(limit, 9.0)}) {
    EXPECT_TRUE(MatchInOrder(straight, forth_and_back, distance));
    EXPECT_TRUE(MatchInOrder(forth_and_back, straight, distance));
  }
  EXPECT_FALSE(MatchInOrder(straight, forth_and_back, std::nextafter(limit, 0.0)));
  EXPECT_FALSE(MatchInOrder(forth_and_back, straight, std::nextafter(limit, 0.0)));
}

TEST(MatchInOrder, EndsCount) {
  const Polyline a = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_TRUE(MatchInOrder(a, {{0, 0, 0}, {2, 0, 0}}, 0));
  EXPECT_FALSE(MatchInOrder(a, {{0, 0, 0}, {1.5, 0, 0}}, 0.4));
  EXPECT_FALSE(MatchInOrder(a, {{0.5, 0, 0}, {2, 0, 0}}, 0.4));
  EXPECT_FALSE(MatchInOrder(a, {{2, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 1.9));
  EXPECT_TRUE(MatchInOrder(a, {{2, 0, 0}, {1, 0, 0}, {0, 0, 0}}, 2));
}

TEST(MatchInOrder, LongCurvesTakeLinearTime) {
  // A matching of every vertex with every segment would take 10^10 steps.
  Polyline a, b;
  for (int i = 0; i < 100000; ++i) {
    a.emplace_back(i, 0, 0);
    b.emplace_back(i + 0.5, 0.25, 0);
  }
  EXPECT_TRUE(MatchInOrder(a, b, 0.6));
}

}  // namespace
}  // namespace curvefusion
