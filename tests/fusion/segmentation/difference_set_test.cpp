#include "fusion/segmentation/difference_set.h"

#include <gtest/gtest.h>

#include "capture/depth_noise.h"
#include "fusion/segmentation/depth_opening.h"

namespace curvefusion {
namespace {

const PinholeCamera kCamera{160, 120, 145, 145, 79.5, 59.5};
constexpr float kWall = 1.0f;
constexpr float kWire = 0.6f;

// A wall with a vertical wire of 4 pixels before it; at z = 0.6 m and f = 145 that is 16 mm.
DepthImage WallWithWire() {
  DepthImage depth(kCamera.width, kCamera.height, kWall);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 78; u < 82; ++u) depth(u, v) = kWire;
  }
  return depth;
}

int Count(const MaskImage& mask) {
  int count = 0;
  for (size_t i = 0; i < mask.size(); ++i) count += mask.data()[i];
  return count;
}

TEST(ImageDifferenceSet, FindsTheWireTheVolumeMissed) {
  const DepthImage wall(kCamera.width, kCamera.height, kWall);
  const MaskImage mask = ImageDifferenceSet(WallWithWire(), wall, wall, {});
  EXPECT_EQ(Count(mask), 4 * kCamera.height);
  EXPECT_EQ(mask(79, 60), 1);
  EXPECT_EQ(mask(90, 60), 0);
}

TEST(ImageDifferenceSet, FindsTheWireTheVolumeCaught) {
  const DepthImage rendering = WallWithWire();
  const DepthImage kept = OpenDepth(rendering, kCamera, {}, {});
  const MaskImage mask = ImageDifferenceSet(WallWithWire(), rendering, kept, {});
  EXPECT_EQ(Count(mask), 4 * kCamera.height);
}

TEST(ImageDifferenceSet, BackgroundSeenPastARemovedPartIsNotThin) {
  const DepthImage rendering = WallWithWire();
  const DepthImage kept = OpenDepth(rendering, kCamera, {}, {});
  EXPECT_EQ(Count(ImageDifferenceSet(DepthImage(160, 120, kWall), rendering, kept, {})), 0);
}

TEST(ImageDifferenceSet, NothingRenderedIsThinOnlyWhereAccepted) {
  const DepthImage nothing(kCamera.width, kCamera.height, 0);
  DifferenceSetOptions options;
  EXPECT_EQ(Count(ImageDifferenceSet(WallWithWire(), nothing, nothing, options)), 160 * 120);
  options.accept_where_nothing_rendered = false;
  EXPECT_EQ(Count(ImageDifferenceSet(WallWithWire(), nothing, nothing, options)), 0);
}

// 283 columns for 848: a third, rounded up.
TEST(ImageDifferenceSet, KnowsTheSizeOfSmallerRenderingsThatWasRounded) {
  const PinholeCamera camera{848, 480, 425, 425, 423.5, 239.5};
  const PinholeCamera small = camera.Scaled(1.0 / 3);
  ASSERT_EQ(small.width, 283);
  DepthImage rendering(small.width, small.height, kWall);
  for (int v = 0; v < small.height; ++v) {
    for (int u = 200; u < small.width; ++u) rendering(u, v) = 0;
  }
  DifferenceSetOptions options;
  options.accept_where_nothing_rendered = false;
  const DepthImage wire(camera.width, camera.height, kWire);
  const MaskImage mask = ImageDifferenceSet(wire, rendering, rendering, options);
  EXPECT_EQ(mask(599, 240), 1);
  EXPECT_EQ(mask(600, 240), 0);
}

TEST(ImageDifferenceSet, NoiseOfASurfaceIsNotThin) {
  const DepthImage wall(kCamera.width, kCamera.height, kWall);
  // Two standard deviations in front: less than the default three.
  const auto noisy = static_cast<float>(kWall - 2 * DepthNoise(kWall));
  EXPECT_EQ(Count(ImageDifferenceSet(DepthImage(160, 120, noisy), wall, wall, {})), 0);
}

TEST(ImageDifferenceSet, ASilhouetteCountsBeyondItsBorder) {
  DepthImage rendering(kCamera.width, kCamera.height, kWall);
  DepthImage depth = rendering;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 83; ++u) {
      depth(u, v) = kWire;  // a box, three pixels wider than the volume says
      if (u < 80) rendering(u, v) = kWire;
    }
  }
  DifferenceSetOptions options;
  EXPECT_EQ(Count(ImageDifferenceSet(depth, rendering, rendering, options)), 3 * 120);
  options.silhouette_margin_px = 6;
  EXPECT_EQ(Count(ImageDifferenceSet(depth, rendering, rendering, options)), 0);
}

TEST(ImageDifferenceSet, LonePixelsLackNeighbours) {
  const DepthImage wall(kCamera.width, kCamera.height, kWall);
  DepthImage depth = WallWithWire();
  depth(20, 20) = kWire;
  DifferenceSetOptions options;
  options.min_neighbours = 8;
  const MaskImage mask = ImageDifferenceSet(depth, wall, wall, options);
  EXPECT_EQ(mask(20, 20), 0);
  EXPECT_EQ(mask(79, 60), 1);
}

TEST(ImageDifferenceSet, RenderingMayBeSmaller) {
  const DepthImage wall(80, 60, kWall);
  EXPECT_EQ(Count(ImageDifferenceSet(WallWithWire(), wall, wall, {})), 4 * kCamera.height);
}

}  // namespace
}  // namespace curvefusion
