#include "fusion/paper/colour_edge_samples.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

Sequence Cameras(double color_scale) {
  Sequence sequence;
  sequence.depth_camera = {64, 48, 60, 60, 31.5, 23.5};
  sequence.color_camera = sequence.depth_camera.Scaled(color_scale);
  sequence.T_color_depth = RigidTransform::Identity();
  return sequence;
}

int Covered(const DepthImage& image) {
  int count = 0;
  for (size_t i = 0; i < image.size(); ++i) count += image.data()[i] > 0;
  return count;
}

TEST(RegisteredDepth, OfTheSameCameraIsTheDepthImage) {
  DepthImage depth(64, 48, 1.5f);
  depth(10, 20) = 0;
  const DepthImage registered = RegisteredDepth(depth, Cameras(1));
  for (int v = 0; v < 48; ++v)
    for (int u = 0; u < 64; ++u) EXPECT_EQ(registered(u, v), depth(u, v)) << u << " " << v;
}

// "We observed no discernible difference" between colour of 640 and of 1280 columns.
TEST(RegisteredDepth, CoversAFinerColourImage) {
  const DepthImage registered = RegisteredDepth(DepthImage(64, 48, 1), Cameras(2));
  ASSERT_EQ(registered.width(), 128);
  EXPECT_EQ(Covered(registered), 128 * 96);
}

TEST(RegisteredDepth, KeepsTheNearestOfSeveral) {
  Sequence sequence = Cameras(1);
  sequence.T_color_depth.translation() = Vec3(0.05, 0, 0);
  DepthImage depth(64, 48, 2);
  for (int v = 0; v < 48; ++v) depth(30, v) = 1;
  const DepthImage registered = RegisteredDepth(depth, sequence);
  EXPECT_EQ(registered(33, 20), 1);  // moved by 60 * .05 / 1 px, the wall by half of it
  EXPECT_EQ(registered(40, 20), 2);
}

}  // namespace
}  // namespace curvefusion
