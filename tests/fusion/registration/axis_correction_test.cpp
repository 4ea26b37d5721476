#include "fusion/registration/axis_correction.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

SkeletonGraph TwoWires(double radius, double other_radius) {
  SkeletonGraph graph;
  const EdgeId wire = graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}});
  const EdgeId other = graph.AddPolyline({{0, 0.05, 0}, {0.1, 0.05, 0}});
  graph.SetCurve(wire, graph.edge(wire).points, {radius, radius}, {});
  graph.SetCurve(other, graph.edge(other).points, {other_radius, other_radius}, {});
  return graph;
}

TEST(AxisCorrection, MovesAlongTheRayByTheRadiusOfTheNearestCurve) {
  const AxisCorrection correction(TwoWires(0.002, 0.006), 0.8);
  ObservedPoints points;
  points.Add({0, 0.001, -0.001}, Vec3::UnitZ(), 1);
  points.Add({0.1, 0.051, -0.005}, Vec3::UnitZ(), 1);
  points.Add({0, 0, 0}, Vec3::Zero(), 1);      // of which no ray is known
  points.Add({0, 0.07, 0}, Vec3::UnitZ(), 1);  // far from both
  const ObservedPoints moved = correction.Apply(points);
  EXPECT_TRUE(moved.positions[0].isApprox(Vec3(0, 0.001, 0.0006)));
  EXPECT_TRUE(moved.positions[1].isApprox(Vec3(0.1, 0.051, -0.0002)));
  EXPECT_TRUE(moved.positions[2].isZero());
  EXPECT_TRUE(moved.positions[3].isApprox(Vec3(0, 0.07, 0.0048)));
}

TEST(AxisCorrection, CurvesWithoutRadiiMoveNothing) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}});
  ObservedPoints points;
  points.Add({0, 0.001, -0.001}, Vec3::UnitZ(), 1);
  for (const SkeletonGraph& skeleton : {graph, SkeletonGraph()}) {
    EXPECT_EQ(AxisCorrection(skeleton, 0.8).Apply(points).positions, points.positions);
  }
}

}  // namespace
}  // namespace curvefusion
