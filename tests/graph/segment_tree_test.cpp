#include "graph/segment_tree.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

TEST(SegmentTree, AgreesWithProjection) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&]() -> Vec3 { return {unit(random), unit(random), unit(random)}; };
  for (const int size : {2, 3, 17, 100}) {
    Polyline points;
    for (int i = 0; i < size; ++i) points.push_back(vector());
    const SegmentTree tree(points);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = vector();
      const double distance = Project(points, p).distance;
      // The projection is right to some ulps.
      EXPECT_TRUE(tree.IsWithin(p, distance * (1 + 1e-12)));
      EXPECT_FALSE(tree.IsWithin(p, distance * (1 - 1e-12)));
    }
  }
}

TEST(SegmentTree, TheLimitCounts) {
  const Polyline points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_TRUE(SegmentTree(points).IsWithin({1.5, 3, 0}, 3));
  EXPECT_FALSE(SegmentTree(points).IsWithin({1.5, std::nextafter(3.0, 4.0), 0}, 3));
}

}  // namespace
}  // namespace curvefusion
