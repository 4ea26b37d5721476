#include "fusion/segmentation/ghost_removal.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

// A line of n points 2 mm apart along x from `start`; every verified_every-th lies on a colour
// edge.
void AddLine(BundlePoints& bundle, const Vec3& start, int n, int verified_every) {
  for (int i = 0; i < n; ++i) {
    bundle.points.Add(start + Vec3(0.002 * i, 0, 0), Vec3::UnitZ(), 1);
    bundle.on_edge.push_back(verified_every > 0 && i % verified_every == 0);
    bundle.voxels.push_back(static_cast<int>(bundle.voxels.size()));
  }
}

TEST(RemoveGhosts, KeepsAnObjectThatIsAlone) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 100, 2);
  EXPECT_EQ(RemoveGhosts(bundle, {}).points.size(), 100u);
}

TEST(RemoveGhosts, DropsSmallClusters) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 100, 1);
  AddLine(bundle, {0, 0.05, 1}, 9, 1);
  EXPECT_EQ(RemoveGhosts(bundle, {}).points.size(), 100u);
}

TEST(RemoveGhosts, DropsIsolatedClustersButNotTheLargest) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 20, 1);
  AddLine(bundle, {0, 0.5, 1}, 100, 1);
  AddLine(bundle, {0, 0.59, 1}, 20, 1);  // 9 cm from the large one: stays
  const ObservedPoints points = RemoveGhosts(bundle, {}).points;
  EXPECT_EQ(points.size(), 120u);
  for (const Vec3& p : points.positions) EXPECT_GE(p.y(), 0.5);
}

TEST(RemoveGhosts, KeepsFarPartsThatAreLargeAndVerified) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 1000, 1);
  AddLine(bundle, {0, 0.5, 1}, 50, 1);
  AddLine(bundle, {0, 1, 1}, 49, 1);     // small
  AddLine(bundle, {0, 1.5, 1}, 300, 2);  // half verified
  EXPECT_EQ(RemoveGhosts(bundle, {}).points.size(), 1000u);
  GhostRemovalOptions options;
  options.isolated_share = 0.75;
  EXPECT_EQ(RemoveGhosts(bundle, options).points.size(), 1050u);
}

TEST(RemoveGhosts, KeepsAnotherObjectThatIsVerifiedLess) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 1000, 1);
  for (const int n : {300, 299}) {
    AddLine(bundle, {0, n == 300 ? 0.5 : 1.0, 1}, n, 1);
    for (int i = 0; i < n; i += 5) bundle.on_edge[bundle.on_edge.size() - n + i] = 0;  // a fifth
  }
  GhostRemovalOptions options;
  options.isolated_share = 0.75;
  EXPECT_EQ(RemoveGhosts(bundle, options).points.size(), 1300u);
}

TEST(RemoveGhosts, DropsWhatColourDoesNotVerify) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 100, 4);      // 25 % on edges
  AddLine(bundle, {0, 0.05, 1}, 100, 10);  // 10 %
  EXPECT_EQ(RemoveGhosts(bundle, {}).points.size(), 100u);
}

TEST(RemoveGhosts, TellsWhatEachRuleDropped) {
  BundlePoints bundle;
  AddLine(bundle, {0, 0, 1}, 100, 1);
  AddLine(bundle, {0, 0.05, 1}, 9, 1);    // small
  AddLine(bundle, {0, 0.10, 1}, 30, 10);  // unverified
  AddLine(bundle, {0, 0.5, 1}, 20, 1);    // isolated
  PointFunnel funnel;
  EXPECT_EQ(RemoveGhosts(bundle, {}, &funnel).points.size(), 100u);
  EXPECT_EQ(funnel.small_clusters, 9);
  EXPECT_EQ(funnel.unverified, 30);
  EXPECT_EQ(funnel.isolated, 20);
}

TEST(RemoveGhosts, EmptyStaysEmpty) { EXPECT_TRUE(RemoveGhosts({}, {}).points.empty()); }

}  // namespace
}  // namespace curvefusion
