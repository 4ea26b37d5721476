#include "fusion/volume/block_allocation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/fusion/analytic_depth.h"

namespace curvefusion {
namespace {

TEST(BlockAllocation, CoversEveryVoxelWithinTheTruncationAndLittleMore) {
  const TsdfScale scale{0.01, 0.04};
  const PinholeCamera camera = KinectCamera(0.5);
  const RigidTransform pose = LookAt({0.3, -0.2, -0.4}, {0.1, 0.1, 0.6});
  const DepthAlongRay scene =
      Union(Sphere({0, 0, 0.5}, 0.15), Plane(Vec3(0.3, 0.1, 1).normalized(), 0.9));
  DepthImage depth = RenderDepth(scene, camera, pose);
  const IntegrationFrame frame(depth, camera, pose, 4.0);
  const std::vector<VoxelKey> keys = FindMissingBlocks(frame, scale, VoxelBlockGrid());
  const std::set<VoxelKey> found(keys.begin(), keys.end());
  EXPECT_EQ(found.size(), keys.size());
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  std::set<VoxelKey> needed;
  for (int z = -80; z < 200; ++z) {
    for (int y = -120; y < 120; ++y) {
      for (int x = -120; x < 120; ++x) {
        const Vec3 p = pose.inverse() * (scale.voxel_size * Vec3(x, y, z));
        if (p.z() <= 0) continue;
        const Vec2 pixel = camera.Project(p);
        if (!camera.Contains(pixel)) continue;
        const float measured = depth(static_cast<int>(std::lround(pixel.x())),
                                     static_cast<int>(std::lround(pixel.y())));
        // 1e-6: rounding may decide at the very limit.
        if (measured == 0 || std::abs(measured - p.z()) > scale.truncation - 1e-6) continue;
        needed.insert(VoxelOf(Vec3(x, y, z), kBlockSide));
      }
    }
  }
  ASSERT_GT(needed.size(), 200u);
  for (const VoxelKey& key : needed) {
    ASSERT_TRUE(found.count(key)) << key.x << " " << key.y << " " << key.z;
  }
  // Boxes around tubes of 4 pixels, 9 mm, dilate the bands of 80 mm.
  EXPECT_LT(found.size(), 1.3 * static_cast<double>(needed.size()));
}

TEST(BlockAllocation, LonePixelsAllocateNothing) {
  const PinholeCamera camera = KinectCamera(0.25);
  DepthImage depth(camera.width, camera.height, 0);
  for (int v = 0; v < camera.height; v += 4) {
    for (int u = 0; u < camera.width; u += 4) depth(u, v) = depth(u + 1, v + 1) = 1.0f;
  }
  const RigidTransform pose = RigidTransform::Identity();
  const IntegrationFrame frame(depth, camera, pose, 4);
  EXPECT_TRUE(FindMissingBlocks(frame, {0.01, 0.04}, VoxelBlockGrid()).empty());
}

TEST(BlockAllocation, ReportsOnlyWhatIsMissing) {
  const TsdfScale scale{0.01, 0.04};
  const PinholeCamera camera = KinectCamera(0.25);
  const RigidTransform pose = RigidTransform::Identity();
  const IntegrationFrame frame(RenderDepth(Plane(Vec3::UnitZ(), 1), camera, pose), camera, pose, 4);
  VoxelBlockGrid grid;
  for (const VoxelKey& key : FindMissingBlocks(frame, scale, grid)) grid.Insert(key);
  EXPECT_GT(grid.size(), 100);
  EXPECT_TRUE(FindMissingBlocks(frame, scale, grid).empty());
}

TEST(IntegrationFrame, MaxDepthIsABoundWithinAnyRectangle) {
  const PinholeCamera camera{37, 23, 30, 30, 18, 11};
  DepthImage depth(37, 23, 0);
  for (int i = 0; i < 37 * 23; ++i) depth.data()[i] = static_cast<float>((i * 7919) % 1000) / 250;
  const IntegrationFrame frame(depth, camera, RigidTransform::Identity(), 3.0);
  for (int v0 = -3; v0 < 23; v0 += 2) {
    for (int u0 = -3; u0 < 37; u0 += 3) {
      for (const int size : {0, 2, 9, 40}) {
        float expected = 0;
        for (int v = std::max(0, v0); v <= std::min(22, v0 + size); ++v) {
          for (int u = std::max(0, u0); u <= std::min(36, u0 + size); ++u) {
            if (depth(u, v) <= 3) expected = std::max(expected, depth(u, v));
          }
        }
        EXPECT_GE(frame.MaxDepthWithin(u0, v0, u0 + size, v0 + size), expected);
      }
    }
  }
  EXPECT_EQ(frame.MaxDepthWithin(-9, 0, -2, 10), 0);
  EXPECT_EQ(frame.MaxDepthWithin(40, 0, 50, 10), 0);
}

}  // namespace
}  // namespace curvefusion
