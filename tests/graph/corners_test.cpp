#include "graph/corners.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "graph/validate.h"

namespace curvefusion {
namespace {

constexpr double kQuarter = 0.64;  // radians: 37 degrees

// Along x and then along y, with a bend of a radius between; a vertex every millimetre.
Polyline Bend(double radius) {
  Polyline bend;
  for (double x = -0.04; x < -radius - 1e-9; x += 0.001) bend.emplace_back(x, 0, 0);
  const int steps = std::max(1, static_cast<int>(radius * std::numbers::pi / 2 / 0.001));
  for (int i = 0; i <= steps; ++i) {
    const double angle = i * std::numbers::pi / 2 / steps;
    bend.emplace_back(radius * (std::sin(angle) - 1), radius * (1 - std::cos(angle)), 0);
  }
  for (double y = radius + 0.001; y < 0.04; y += 0.001) bend.emplace_back(0, y, 0);
  return bend;
}

TEST(SharpestCorner, IsInTheMiddleOfATightBend) {
  const Polyline bend = Bend(0.004);
  const auto corner = SharpestCorner(bend, kQuarter);
  ASSERT_TRUE(corner.has_value());
  // The middle of the bend lies .3 radii from both wires; vertices lie 1 mm apart.
  EXPECT_LT((bend[*corner] - Vec3(-0.3 * 0.004, 0.3 * 0.004, 0)).norm(), 0.0011);
}

// 10 mm turn by 10 mm over the radius: .4 radians.
TEST(SharpestCorner, IsNoneInAWideBend) {
  EXPECT_FALSE(SharpestCorner(Bend(0.025), kQuarter).has_value());
  EXPECT_TRUE(SharpestCorner(Bend(0.025), 0.3).has_value());
}

TEST(SharpestCorner, IsNoneWhereNothingTurns) {
  EXPECT_FALSE(SharpestCorner({{0, 0, 0}, {0.05, 0, 0}}, kQuarter).has_value());
  EXPECT_FALSE(SharpestCorner({{0, 0, 0}, {0.005, 0, 0}, {0.005, 0.005, 0}}, kQuarter).has_value());
  EXPECT_FALSE(SharpestCorner({{0, 0, 0}}, kQuarter).has_value());
}

TEST(SplitAtCorners, MakesANodeOfEachAndMovesNothing) {
  SkeletonGraph graph;
  const Polyline zigzag = {{0, 0, 0}, {0.03, 0, 0}, {0.03, 0.03, 0}, {0.06, 0.03, 0}};
  graph.AddPolyline(zigzag);
  graph.AddPolyline({{0, 0, 0.05}, {0.06, 0, 0.05}});
  SplitAtCorners(graph, kQuarter);
  EXPECT_EQ(graph.edge_count(), 4);
  EXPECT_EQ(graph.ComponentCount(), 2);
  EXPECT_DOUBLE_EQ(graph.TotalLength(), 0.15);
  EXPECT_TRUE(Faults(graph).empty());
  SplitAtCorners(graph, kQuarter);
  EXPECT_EQ(graph.edge_count(), 4);
}

}  // namespace
}  // namespace curvefusion
