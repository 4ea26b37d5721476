#include "fusion/volume/marching_cubes.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/fusion/mesh_topology.h"
#include "tests/fusion/voxel_field.h"

namespace curvefusion {
namespace {

constexpr double kVoxel = 0.01;

TEST(MarchingCubes, SphereHasItsVolumeAndIsOrientedTowardsThePositiveSide) {
  const Vec3 center(1.3, -2.2, 0.7);
  const double radius = 9.4;
  const TriangleMesh mesh = MarchingCubes(
      SampleField([&](const Vec3& p) { return (p - center).norm() - radius; }, -2, 1), kVoxel);
  EXPECT_TRUE(IsClosedOrientedManifold(mesh));
  EXPECT_EQ(EulerCharacteristic(mesh), 2);
  const double true_volume = 4.0 / 3 * M_PI * std::pow(radius * kVoxel, 3);
  // Edges up to sqrt(3) h long lie up to 3 h^2 / 8 r inside: 9 h^2 / 8 r^2 = 1.3 % of the volume.
  EXPECT_NEAR(SignedVolume(mesh), true_volume, 0.013 * true_volume);
  for (const Vec3f& vertex : mesh.vertices) {
    // Linear interpolation of the distance along an edge: at most h^2 / 8 r off.
    ASSERT_NEAR((vertex.cast<double>() / kVoxel - center).norm(), radius, 1 / (8 * radius));
  }
}

TEST(MarchingCubes, TorusHasGenusOne) {
  const TriangleMesh mesh = MarchingCubes(
      SampleField(
          [](const Vec3& p) {
            return std::hypot(std::hypot(p.x() - 0.4, p.y() + 0.3) - 9, p.z() - 0.2) - 3.3;
          },
          -2, 1),
      kVoxel);
  EXPECT_TRUE(IsClosedOrientedManifold(mesh));
  EXPECT_EQ(EulerCharacteristic(mesh), 0);
}

TEST(MarchingCubes, RandomSignsGiveAClosedManifoldInEveryCase) {
  // 4096 random cells hold every sign pattern and every pair of neighbouring patterns many times;
  // the outermost voxels are positive, so everything must close.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int round = 0; round < 5; ++round) {
    const TriangleMesh mesh =
        MarchingCubes(SampleField(
                          [&](const Vec3& p) {
                            const double sample = value(random);
                            return p.minCoeff() <= -8 || p.maxCoeff() >= 7 ? 1.0 : sample;
                          },
                          -1, 0),
                      kVoxel);
    EXPECT_GT(mesh.triangles.size(), 8000u);
    EXPECT_TRUE(IsClosedOrientedManifold(mesh));
    EXPECT_GT(SignedVolume(mesh), 0);
  }
}

TEST(MarchingCubes, CellsWithAnUnobservedCornerAreLeftOut) {
  const auto plane = [](const Vec3& p) { return p.z() - 0.5; };
  const size_t whole = MarchingCubes(SampleField(plane, -1, 0), kVoxel).triangles.size();
  EXPECT_EQ(whole, 2u * 15 * 15);  // 16 voxels span 15 cells, two triangles each
  VoxelBlockGrid grid = SampleField(plane, -1, 0);
  const int changed = grid.Find({0, 0, 0});
  grid.block(changed).tsdf[3 + 8 * 3] = NAN;
  grid.SetSigns(changed, FindSigns(grid.block(changed)));
  const TriangleMesh mesh = MarchingCubes(grid, kVoxel);
  EXPECT_EQ(mesh.triangles.size(), whole - 2u * 4);
  // The vertex above the unobserved voxel is gone.
  EXPECT_EQ(mesh.vertices.size(), 16u * 16 - 1);
}

TEST(MarchingCubes, NothingGivesNothing) {
  EXPECT_TRUE(MarchingCubes(VoxelBlockGrid(), kVoxel).triangles.empty());
}

}  // namespace
}  // namespace curvefusion
