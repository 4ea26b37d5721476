#include "fusion/curve_graph/viewed_region.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

constexpr int kCameras = 24;
constexpr PinholeCamera kCamera = {640, 480, 580, 580, 319.5, 239.5};

// Cameras .6 m from the origin, which they look at, spread over so many radians of a circle.
Sequence LookingAtOrigin(double spread) {
  Sequence sequence;
  sequence.color_camera = sequence.depth_camera = kCamera;
  for (int i = 0; i < kCameras; ++i) {
    const double angle = spread * (i / (kCameras - 1.0) - 0.5);
    RigidTransform T = RigidTransform::Identity();
    T.rotate(Eigen::AngleAxisd(angle, Vec3::UnitY()));
    T.translate(Vec3(0, 0, -0.6));
    sequence.frames.emplace_back().T_world_camera = T;
  }
  return sequence;
}

TEST(RegionSeenByMost, HoldsWhatCamerasCircle) {
  const Eigen::AlignedBox3d region = RegionSeenByMost(LookingAtOrigin(M_PI / 2));
  EXPECT_TRUE(region.contains(Vec3::Zero()));
  EXPECT_TRUE(region.contains(Vec3(0.1, 0.1, 0.1)));
  // Half of the cameras no longer see what lies far to a side.
  EXPECT_LT(region.sizes().x(), 2);
}

// A path of 50 mm shows no depth beyond a metre.
TEST(RegionSeenByMost, EndsWhereTheImagesShowNoDepth) {
  Sequence sequence = LookingAtOrigin(0);
  for (int i = 0; i < kCameras; ++i)
    sequence.frames[i].T_world_camera.translation().x() = 0.05 * i / (kCameras - 1);
  const Eigen::AlignedBox3d region = RegionSeenByMost(sequence);
  // Distances are tried in steps of a tenth.
  EXPECT_NEAR(region.min().z(), -0.6 + 0.1, 0.02);
  EXPECT_NEAR(region.max().z(), -0.6 + 1, 0.12);
}

TEST(RegionSeenByMost, IsEmptyWhereTheCameraStandsOrLooksAround) {
  EXPECT_TRUE(RegionSeenByMost(LookingAtOrigin(0)).isEmpty());
  Sequence sequence = LookingAtOrigin(2 * M_PI);
  for (SequenceFrame& frame : sequence.frames)
    frame.T_world_camera = frame.T_world_camera * Eigen::AngleAxisd(M_PI, Vec3::UnitY());
  EXPECT_TRUE(RegionSeenByMost(sequence).isEmpty());
}

}  // namespace
}  // namespace curvefusion
