#include "fusion/segmentation/openness.h"

#include <gtest/gtest.h>

#include <limits>

namespace curvefusion {
namespace {

const PinholeCamera kRendered{160, 120, 145, 145, 79.5, 59.5};
const RigidTransform kPose = RigidTransform::Identity();

// A wall at one metre whose left half lets one raw pixel in `every` pass to two metres; 0 = none.
DepthImage RawDepth(int every) {
  DepthImage depth(640, 480, 1.0f);
  int count = 0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (every > 0 && ++count % every == 0) depth(u, v) = 2.0f;
    }
  }
  return depth;
}

OpennessGrid GridOf(const DepthImage& depth, const DepthImage& rendering) {
  OpennessGrid grid;
  for (int i = 0; i < 10; ++i) grid.AddFrame(depth, rendering, kRendered, kPose);
  grid.Pool();
  return grid;
}

TEST(Openness, IsTheShareOfPixelsThatPass) {
  const OpennessGrid grid = GridOf(RawDepth(10), DepthImage(160, 120, 1.0f));
  // One pixel in ten; columns of the pattern fall into a cell or not, one in 27.
  EXPECT_NEAR(grid.Share(Vec3(-0.3, 0, 1.0)), 0.1, 0.1 / 10);
  EXPECT_EQ(grid.Share(Vec3(0.3, 0, 1.0)), 0);
}

TEST(Openness, MarksTheGrilleAlone) {
  const DepthImage rendering(160, 120, 1.0f);
  const MaskImage grilles = GridOf(RawDepth(10), rendering).Grilles(rendering, kRendered, kPose);
  EXPECT_EQ(grilles(40, 60), 1);
  EXPECT_EQ(grilles(120, 60), 0);
}

TEST(Openness, NoiseDoesNotPass) {
  DepthImage depth = RawDepth(0);
  for (size_t i = 0; i < depth.size(); i += 3) depth.data()[i] = 1.015f;  // within 20 mm
  EXPECT_EQ(GridOf(depth, DepthImage(160, 120, 1.0f)).Share(Vec3(0, 0, 1.0)), 0);
}

TEST(Openness, SilhouettesAreNotCounted) {
  // A box before a wall, and depth that has the box five pixels too far left: drift of the pose.
  DepthImage rendering(160, 120, 2.0f), depth(640, 480, 2.0f);
  for (int v = 0; v < 120; ++v) {
    for (int u = 60; u < 100; ++u) rendering(u, v) = 1.0f;
  }
  for (int v = 0; v < 480; ++v) {
    for (int u = 235; u < 395; ++u) depth(u, v) = 1.0f;
  }
  const OpennessGrid grid = GridOf(depth, rendering);
  for (int u = 60; u < 100; ++u) EXPECT_EQ(grid.Share(kRendered.Unproject(u, 60, 1.0)), 0) << u;
}

TEST(Openness, NothingMeasuredIsClosed) {
  const OpennessGrid grid = GridOf(DepthImage(640, 480, 0), DepthImage(160, 120, 1.0f));
  EXPECT_EQ(grid.Share(Vec3(0, 0, 1.0)), 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(GridOf(DepthImage(640, 480, nan), DepthImage(160, 120, 1.0f)).Share(Vec3(0, 0, 1.0)),
            0);
}

}  // namespace
}  // namespace curvefusion
