#include "graph/corners.h"

#include <gtest/gtest.h>

#include "graph/validate.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

constexpr double kQuarter = 0.64;  // radians: 37 degrees

TEST(SharpestCorner, IsInTheMiddleOfATightBend) {
  const Polyline bend = RightAngle(0.004);
  const auto corner = SharpestCorner(bend, kQuarter);
  ASSERT_TRUE(corner.has_value());
  // The middle of the bend lies .3 radii from both wires; vertices lie 1 mm apart.
  EXPECT_LT((bend[*corner] - Vec3(-0.3 * 0.004, 0.3 * 0.004, 0)).norm(), 0.0011);
}

// 10 mm turn by 10 mm over the radius: .4 radians.
TEST(SharpestCorner, IsNoneInAWideBend) {
  EXPECT_FALSE(SharpestCorner(RightAngle(0.025), kQuarter).has_value());
  EXPECT_TRUE(SharpestCorner(RightAngle(0.025), 0.3).has_value());
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
