#include "fusion/paper/bundle_skeleton.h"

#include <gtest/gtest.h>

#include "tests/graph/tube_points.h"

namespace curvefusion {
namespace {

// A wire of 5 mm as a depth camera samples it, along x.
ObservedPoints Wire(double y) {
  ObservedPoints points;
  AddTube({{0, y, 0}, {0.15, y, 0}}, 2.5e-3, 1500, 0.5e-3, points);
  return points;
}

// Wires nearer than the radius of the contraction, 15 to 25 mm, are one cloud to it.
TEST(ExtractBundleSkeleton, ClustersAreContractedByThemselves) {
  const SkeletonGraph skeleton = ExtractBundleSkeleton({Wire(0), Wire(0.012)}, {});
  EXPECT_EQ(skeleton.edge_count(), 2);
  EXPECT_EQ(skeleton.ComponentCount(), 2);
  for (const EdgeId id : skeleton.Edges()) {
    // A median over 150 points of 2.5 mm scatter errs by .2 mm; four times that.
    for (const Vec3& p : skeleton.edge(id).points) {
      EXPECT_LT(std::min(std::abs(p.y()), std::abs(p.y() - 0.012)), 0.8e-3);
    }
  }
}

TEST(ExtractBundleSkeleton, NothingGivesAnEmptyGraph) {
  EXPECT_TRUE(ExtractBundleSkeleton({}, {}).empty());
}

}  // namespace
}  // namespace curvefusion
