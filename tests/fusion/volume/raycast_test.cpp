#include "fusion/volume/raycast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fusion/analytic_depth.h"
#include "tests/fusion/voxel_field.h"

namespace curvefusion {
namespace {

constexpr double kVoxel = 0.01;

// Trilinear interpolation in double, looking every voxel up; p in voxels.
double InterpolateSlowly(const VoxelBlockGrid& grid, const Vec3& p) {
  const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y())),
            z = static_cast<int>(std::floor(p.z()));
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const int cx = x + (i & 1), cy = y + (i >> 1 & 1), cz = z + (i >> 2 & 1);
    const int block = grid.Find({cx >> 3, cy >> 3, cz >> 3});
    if (block == VoxelBlockGrid::kNone) return NAN;
    const double weight =
        (1 - std::abs(p.x() - cx)) * (1 - std::abs(p.y() - cy)) * (1 - std::abs(p.z() - cz));
    sum += weight * grid.block(block).tsdf[(cx & 7) + 8 * (cy & 7) + 64 * (cz & 7)];
  }
  return sum;
}

// The first crossing found in steps of a fiftieth voxel.
double RaycastSlowly(const VoxelBlockGrid& grid, const Vec3& origin, const Vec3& ray, double end) {
  const double step = 0.02 * kVoxel / ray.norm();
  double last = NAN;
  for (double t = 0; t < end; t += step) {
    const double value = InterpolateSlowly(grid, (origin + t * ray) / kVoxel);
    if (last > 0 && value <= 0) return t - step * value / (value - last);
    last = value;
  }
  return 0;
}

TEST(Raycast, AgreesWithSmallStepsThroughEveryVoxel) {
  // A wavy labyrinth with many silhouettes, partly unobserved, and cameras in and around it.
  VoxelBlockGrid grid = SampleField(
      [](const Vec3& p) {
        return 0.5 * (std::sin(0.35 * p.x()) + std::sin(0.41 * p.y()) + std::sin(0.3 * p.z())) +
               0.3 * std::sin(0.9 * p.x() + 0.7 * p.y());
      },
      -2, 1);
  for (int i = 0; i < kBlockVoxels; i += 97) grid.block(5).tsdf[i] = NAN;
  const PinholeCamera camera{48, 36, 50, 50, 23.5, 17.5};
  const std::vector<RigidTransform> poses = {
      LookAt({0.4, 0.25, -0.3}, {0, 0, 0}), LookAt({-0.35, 0.1, 0.3}, {0, 0, 0}),
      LookAt({0.011, 0.023, 0.031}, {0.1, -0.02, 0}), RigidTransform::Identity()};
  int compared = 0, differing = 0;
  for (const RigidTransform& pose : poses) {
    const DepthImage rendering = RaycastBlocks(grid, FindSurfaceBlocks(grid), kVoxel, camera, pose);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Vec3 ray = pose.linear() * camera.Unproject(u, v, 1);
        const double truth = RaycastSlowly(grid, pose.translation(), ray, 0.9);
        ++compared;
        // A hundredth of a voxel: the fast way refines to a thousandth, the slow way to less.
        differing += std::abs(rendering(u, v) - truth) > 0.01 * kVoxel;
      }
    }
  }
  EXPECT_EQ(compared, 4 * 48 * 36);
  // A grazing ray that dips below zero and comes up again within one cell is let through.
  EXPECT_LE(differing, compared / 100);
}

TEST(Raycast, CameraOnAVoxelLookingAlongAnAxisHasNoHoles) {
  // Every quantity is a whole number: faces, edges and corners of cells are met exactly.
  const VoxelBlockGrid grid = SampleField([](const Vec3& p) { return 0.25 * (8 - p.z()); }, -2, 1);
  const PinholeCamera camera{33, 33, 16, 16, 16, 16};
  const DepthImage rendering =
      RaycastBlocks(grid, FindSurfaceBlocks(grid), kVoxel, camera, RigidTransform::Identity());
  for (int v = 0; v < 33; ++v) {
    for (int u = 0; u < 33; ++u) {
      EXPECT_NEAR(rendering(u, v), 0.08, 1e-6) << u << " " << v;
    }
  }
}

}  // namespace
}  // namespace curvefusion
