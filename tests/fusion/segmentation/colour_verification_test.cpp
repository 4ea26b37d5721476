#include "fusion/segmentation/colour_verification.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

const PinholeCamera kCamera{64, 48, 60, 60, 31.5, 23.5};

// Grey on the left, `right` from column 32 on.
ColorImage TwoHalves(const Rgb& right) {
  ColorImage image(64, 48, Rgb{100, 100, 100});
  for (int v = 0; v < 48; ++v) {
    for (int u = 32; u < 64; ++u) image(u, v) = right;
  }
  return image;
}

TEST(ColourEdges, FindsAStepInOneChannel) {
  // Luma of both halves is nearly equal: the step is in blue alone.
  const MaskImage edges = ColourEdges(TwoHalves({100, 100, 200}), {});
  int near_step = 0, elsewhere = 0;
  for (int v = 4; v < 44; ++v) {
    for (int u = 0; u < 64; ++u) (u >= 30 && u <= 33 ? near_step : elsewhere) += edges(u, v);
  }
  EXPECT_EQ(near_step, 40);
  EXPECT_EQ(elsewhere, 0);
}

TEST(ColourEdges, AnEvenImageHasNone) {
  const MaskImage edges = ColourEdges(TwoHalves({100, 100, 100}));
  for (size_t i = 0; i < edges.size(); ++i) EXPECT_EQ(edges.data()[i], 0);
}

TEST(MaskPixelsOnEdges, FollowsTheRegistration) {
  MaskImage edges(64, 48, 0);
  edges(40, 24) = 1;
  const DepthImage depth(64, 48, 0.6f);
  const MaskImage all(64, 48, 1);
  constexpr double kExact = 0;
  RigidTransform T_color_depth = RigidTransform::Identity();
  EXPECT_EQ(MaskPixelsOnEdges(all, depth, edges, kCamera, kCamera, T_color_depth, kExact)(40, 24),
            1);
  T_color_depth.translation() = Vec3(0.05, 0, 0);  // 60 px * 0.05 / 0.6 = 5 px to the right
  const MaskImage shifted =
      MaskPixelsOnEdges(all, depth, edges, kCamera, kCamera, T_color_depth, kExact);
  EXPECT_EQ(shifted(40, 24), 0);
  EXPECT_EQ(shifted(35, 24), 1);
}

TEST(MaskPixelsOnEdges, OnlyMaskPixelsCount) {
  const MaskImage edges(64, 48, 1), none(64, 48, 0);
  const DepthImage depth(64, 48, 0.6f);
  const MaskImage on_edge =
      MaskPixelsOnEdges(none, depth, edges, kCamera, kCamera, RigidTransform::Identity(), 1);
  for (size_t i = 0; i < on_edge.size(); ++i) EXPECT_EQ(on_edge.data()[i], 0);
}

}  // namespace
}  // namespace curvefusion
