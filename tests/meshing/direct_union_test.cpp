#include "meshing/direct_union.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

namespace curvefusion {
namespace {

// A cube of side 1 about the origin, moved.
struct Cube {
  RigidTransform T_world_cube = RigidTransform::Identity();

  UnionMesh Mesh() const {
    UnionMesh mesh;
    for (int i = 0; i < 8; ++i) {
      mesh.vertices.push_back(T_world_cube *
                              (Vec3(i & 1, i >> 1 & 1, i >> 2 & 1) - Vec3::Constant(0.5)));
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
  }

  bool Contains(const Vec3& p) const {
    return (T_world_cube.inverse() * p).cwiseAbs().maxCoeff() < 0.5;
  }
};

Cube Shifted(const Vec3& shift) {
  Cube cube;
  cube.T_world_cube.translation() = shift;
  return cube;
}

double VolumeOf(const UnionMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c])) / 6;
  }
  return volume;
}

TEST(UniteDirectly, CubesThatOverlap) {
  const auto united = UniteDirectly(Cube().Mesh(), Shifted({0.31, 0.27, 0.43}).Mesh());
  ASSERT_TRUE(united);
  // Rounding of a few coordinates of size 1.
  EXPECT_NEAR(VolumeOf(*united), 2 - 0.69 * 0.73 * 0.57, 1e-14);
  // The corner of either cube that is inside the other is gone; the borders of their common box
  // that lie on one face each of both cross six edges, and have nodes on the diagonals of faces.
  EXPECT_GE(united->vertices.size(), 14U + 6U);
}

TEST(UniteDirectly, ACubeInAnotherVanishes) {
  Cube small;
  UnionMesh inner = small.Mesh();
  for (Vec3& v : inner.vertices) v = 0.3 * v + Vec3(0.05, 0.02, 0.01);
  for (const bool swapped : {false, true}) {
    const UnionMesh outer = Cube().Mesh();
    const auto united = swapped ? UniteDirectly(inner, outer) : UniteDirectly(outer, inner);
    ASSERT_TRUE(united);
    EXPECT_EQ(united->triangles.size(), 12U);
    EXPECT_NEAR(VolumeOf(*united), 1, 1e-14);
  }
}

TEST(UniteDirectly, CubesApartStay) {
  const auto united = UniteDirectly(Cube().Mesh(), Shifted({1.2, 0.1, 0.2}).Mesh());
  ASSERT_TRUE(united);
  EXPECT_EQ(united->triangles.size(), 24U);
  EXPECT_NEAR(VolumeOf(*united), 2, 1e-14);
}

TEST(UniteDirectly, NothingInSpecialPosition) {
  EXPECT_FALSE(UniteDirectly(Cube().Mesh(), Cube().Mesh()));
  EXPECT_FALSE(UniteDirectly(Cube().Mesh(), Shifted({1, 0, 0}).Mesh()));      // common face
  EXPECT_FALSE(UniteDirectly(Cube().Mesh(), Shifted({0.5, 0.5, 1}).Mesh()));  // in one plane
}

// A peg through a face, far from its edges: the border is a closed loop within one triangle.
TEST(UniteDirectly, PegThroughAFace) {
  UnionMesh peg = Cube().Mesh();
  for (Vec3& v : peg.vertices) v = Vec3(0.1, 0.1, 1).cwiseProduct(v) + Vec3(0.22, -0.17, 0.6);
  const auto united = UniteDirectly(Cube().Mesh(), peg);
  ASSERT_TRUE(united);
  EXPECT_NEAR(VolumeOf(*united), 1 + 0.01 * 0.6, 1e-14);
}

TEST(UniteDirectly, TurnedCubesHaveTheVolumeOfTheirUnion) {
  std::mt19937_64 random(7);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  for (int run = 0; run < 50; ++run) {
    Cube cube = Shifted(Vec3(uniform(), uniform(), uniform()));
    cube.T_world_cube.rotate(
        Eigen::AngleAxisd(6 * uniform(), Vec3(uniform(), uniform() - 0.5, 1).normalized()));
    const auto united = UniteDirectly(Cube().Mesh(), cube.Mesh());
    ASSERT_TRUE(united) << run;
    constexpr int kSamples = 20000;
    int common = 0;
    for (int i = 0; i < kSamples; ++i) {
      common += cube.Contains(Vec3(uniform(), uniform(), uniform()) - Vec3::Constant(0.5));
    }
    const double overlap = static_cast<double>(common) / kSamples;
    // Five standard errors of the share of samples.
    EXPECT_NEAR(VolumeOf(*united), 2 - overlap, 5 * 0.5 / std::sqrt(kSamples)) << run;
  }
}

}  // namespace
}  // namespace curvefusion
