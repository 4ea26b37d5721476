#include "fusion/segmentation/bundle.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

using Bundles = std::vector<std::pair<int, int>>;

TEST(SplitIntoBundles, AShortRestJoinsTheLastBundle) {
  EXPECT_EQ(SplitIntoBundles(90, 30), (Bundles{{0, 30}, {30, 60}, {60, 90}}));
  EXPECT_EQ(SplitIntoBundles(70, 30), (Bundles{{0, 30}, {30, 70}}));
  EXPECT_EQ(SplitIntoBundles(75, 30), (Bundles{{0, 30}, {30, 60}, {60, 75}}));
  EXPECT_EQ(SplitIntoBundles(5, 30), (Bundles{{0, 5}}));
  EXPECT_TRUE(SplitIntoBundles(0, 30).empty());
}

const PinholeCamera kCamera{9, 9, 100, 100, 4, 4};

// One set pixel at the centre of the image, at the given depth.
struct OnePixel {
  explicit OnePixel(float z) : mask(9, 9, 0), none(9, 9, 0), depth(9, 9, z) { mask(4, 4) = 1; }
  MaskImage mask;
  MaskImage none;
  DepthImage depth;
};

TEST(BundleDifferenceSet, MovesPixelsToTheBundleFrame) {
  BundleDifferenceSet set({});
  RigidTransform T_bundle_camera = RigidTransform::Identity();
  T_bundle_camera.translation() = Vec3(0.1, 0, 0);
  const OnePixel frame(0.5f);
  set.AddFrame(frame.mask, frame.mask, frame.depth, kCamera, T_bundle_camera);
  const BundlePoints points = set.Points();
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_LT((points.points.positions[0] - Vec3(0.1, 0, 0.5)).norm(), 1e-7);  // depth is a float
  EXPECT_LT((points.points.viewing_rays[0] - Vec3(0, 0, 1)).norm(), 1e-12);
  EXPECT_EQ(points.points.counts[0], 1);
  EXPECT_TRUE(points.on_edge[0]);
}

TEST(BundleDifferenceSet, PointsSeenInTooFewFramesAreDropped) {
  BundleOptions options;
  options.min_frames = 3;
  BundleDifferenceSet set(options);
  const OnePixel wire(0.5f), noise(0.7f);
  for (int i = 0; i < 3; ++i) {
    set.AddFrame(wire.mask, wire.none, wire.depth, kCamera, RigidTransform::Identity());
  }
  set.AddFrame(noise.mask, noise.none, noise.depth, kCamera, RigidTransform::Identity());
  const BundlePoints points = set.Points();
  ASSERT_EQ(points.points.size(), 1u);
  EXPECT_EQ(points.points.counts[0], 3);
  EXPECT_FALSE(points.on_edge[0]);
}

TEST(BundleDifferenceSet, FramePointsAreWhatEachFrameSaw) {
  BundleDifferenceSet set({});
  const OnePixel first(0.5f), second(0.7f);
  set.AddFrame(first.mask, first.none, first.depth, kCamera, RigidTransform::Identity());
  set.AddFrame(second.mask, second.none, second.depth, kCamera, RigidTransform::Identity());
  const std::vector<ObservedPoints> frames = set.FramePoints(set.Points().voxels);
  ASSERT_EQ(frames.size(), 2u);
  ASSERT_EQ(frames[1].size(), 1u);
  EXPECT_NEAR(frames[1].positions[0].z(), 0.7, 1e-7);  // depth is a float
  EXPECT_TRUE(set.FramePoints({})[0].empty());
}

TEST(BundleDifferenceSet, ABundleOfFewFramesAsksForNoMoreThanItHas) {
  BundleOptions options;
  options.min_frames = 3;
  BundleDifferenceSet set(options);
  const OnePixel wire(0.5f);
  set.AddFrame(wire.mask, wire.none, wire.depth, kCamera, RigidTransform::Identity());
  EXPECT_EQ(set.Points().points.size(), 1u);
}

TEST(BundleDifferenceSet, EmptyGivesNoPoints) {
  EXPECT_TRUE(BundleDifferenceSet({}).Points().points.empty());
}

}  // namespace
}  // namespace curvefusion
