#include "fusion/paper/ghost_clusters.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

constexpr double kVoxel = 0.005;

// Points and the edge samples that verify them.
struct Scene {
  ObservedPoints points;
  std::vector<Vec3> edge_samples;
  PointFunnel funnel;

  // A line of n points 4 mm apart along x, which are in four voxels for every five; every
  // verified_every-th lies on a colour edge.
  void AddLine(const Vec3& start, int n, int verified_every) {
    for (int i = 0; i < n; ++i) {
      const Vec3 p = start + Vec3(0.004 * i + 0.001, 0.5 * kVoxel, 0.5 * kVoxel);
      points.Add(p, Vec3::UnitZ(), 1);
      if (verified_every > 0 && i % verified_every == 0) edge_samples.push_back(p);
    }
  }
  std::vector<ObservedPoints> Clusters() {
    return RemoveGhostClusters(points, edge_samples, kVoxel, {}, funnel);
  }
};

TEST(RemoveGhostClusters, AnObjectThatIsOneClusterStays) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 100, 2);
  ASSERT_EQ(scene.Clusters().size(), 1u);
  EXPECT_EQ(scene.funnel.points, 100);
}

TEST(RemoveGhostClusters, EachClusterIsGivenByItself) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 100, 1);
  scene.AddLine({0, 0.05, 1}, 60, 1);
  const std::vector<ObservedPoints> clusters = scene.Clusters();
  ASSERT_EQ(clusters.size(), 2u);
  EXPECT_EQ(clusters[0].size(), 100u);
  EXPECT_EQ(clusters[1].size(), 60u);
}

TEST(RemoveGhostClusters, FewerThanTenPointsGo) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 100, 1);
  scene.AddLine({0, 0.05, 1}, 9, 1);
  scene.AddLine({0, 0.10, 1}, 10, 1);
  EXPECT_EQ(scene.Clusters().size(), 2u);
  EXPECT_EQ(scene.funnel.small_clusters, 9);
}

TEST(RemoveGhostClusters, IsolatedOnesGo) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 100, 1);
  scene.AddLine({0, 0.095, 1}, 15, 1);  // 9.5 cm away
  scene.AddLine({0, 0.3, 1}, 15, 1);    // 20 cm
  EXPECT_EQ(scene.Clusters().size(), 2u);
  EXPECT_EQ(scene.funnel.isolated, 15);
}

// Any other cluster counts, not only larger ones: each of two short ones holds the other.
TEST(RemoveGhostClusters, NearAnyOtherClusterIsNotIsolated) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 100, 1);
  scene.AddLine({0, 0.5, 1}, 15, 1);
  scene.AddLine({0, 0.55, 1}, 12, 1);
  EXPECT_EQ(scene.Clusters().size(), 3u);
  EXPECT_EQ(scene.funnel.isolated, 0);
}

// A patch of background that is larger than the object does not make it a ghost.
TEST(RemoveGhostClusters, AnObjectDoesNotVanishForALargerPatch) {
  Scene scene;
  scene.AddLine({0, 0, 0.7}, 40, 2);
  scene.AddLine({0, 0, 1.5}, 400, 0);  // no colour verifies it
  const std::vector<ObservedPoints> clusters = scene.Clusters();
  ASSERT_EQ(clusters.size(), 1u);
  EXPECT_EQ(clusters[0].size(), 40u);
}

// "We then remove ... isolated floating clusters. The remaining possible thin and long clusters are
// further removed if they are not verified": what colour removes still counts as a neighbour.
TEST(RemoveGhostClusters, IsolationComesBeforeColour) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 15, 1);
  scene.AddLine({0, 0.05, 1}, 15, 0);
  EXPECT_EQ(scene.Clusters().size(), 1u);
  EXPECT_EQ(scene.funnel.isolated, 0);
  EXPECT_EQ(scene.funnel.unverified, 15);
}

TEST(RemoveGhostClusters, LessThanAFifthOfTheVoxelsOnEdgesIsAGhost) {
  Scene scene;
  scene.AddLine({0, 0, 1}, 100, 5);     // 20 of 80 voxels
  scene.AddLine({0, 0.05, 1}, 100, 7);  // 15 of 80
  EXPECT_EQ(scene.Clusters().size(), 1u);
  EXPECT_EQ(scene.funnel.unverified, 100);
}

TEST(RemoveGhostClusters, NothingStaysNothing) { EXPECT_TRUE(Scene().Clusters().empty()); }

}  // namespace
}  // namespace curvefusion
