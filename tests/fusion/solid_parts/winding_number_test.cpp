#include "fusion/solid_parts/winding_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

// A ball of radius .1 about the origin whose part below `lowest` is missing.
TriangleMesh Cap(double lowest) {
  constexpr int kRows = 40, kColumns = 80;
  TriangleMesh mesh;
  for (int row = 0; row <= kRows; ++row) {
    const double polar = row * std::acos(lowest / 0.1) / kRows;
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2 * std::numbers::pi * column / kColumns;
      mesh.vertices.push_back((0.1 * Vec3(std::sin(polar) * std::cos(azimuth),
                                          std::sin(polar) * std::sin(azimuth), std::cos(polar)))
                                  .cast<float>());
    }
  }
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const int a = row * kColumns + column, b = row * kColumns + (column + 1) % kColumns;
      mesh.triangles.push_back({a, a + kColumns, b + kColumns});
      mesh.triangles.push_back({a, b + kColumns, b});
    }
  }
  return mesh;
}

TEST(WindingNumber, IsOneInsideAndNoneOutsideOfAClosedSurface) {
  const WindingNumber winding(Cap(-0.1), 0.04);
  // Dipoles are off by some percent of a group's share.
  EXPECT_NEAR(winding.At({0, 0, 0}), 1, 0.02);
  EXPECT_NEAR(winding.At({0.09, 0, 0}), 1, 0.02);
  EXPECT_NEAR(winding.At({0.11, 0, 0}), 0, 0.02);
  EXPECT_NEAR(winding.At({1, 2, 3}), 0, 1e-3);
}

TEST(WindingNumber, OfHalfABallIsOneHalfInTheMiddleOfItsRim) {
  const WindingNumber winding(Cap(0), 0.04);
  EXPECT_NEAR(winding.At({0, 0, 0}), 0.5, 0.01);
  EXPECT_GT(winding.At({0, 0, 0.05}), 0.6);
  EXPECT_LT(winding.At({0, 0, -0.05}), 0.4);
}

TEST(WindingNumber, OfGroupsIsThatOfSingleTriangles) {
  const TriangleMesh mesh = Cap(0.03);
  const WindingNumber grouped(mesh, 0.04), single(mesh, 1e6);  // one group: all is near
  for (const double x : {-0.3, -0.12, 0.0, 0.05, 0.2}) {
    const Vec3 p(x, 0.02, 0.04);
    EXPECT_NEAR(grouped.At(p), single.At(p), 0.01) << x;
  }
}

TEST(WindingNumber, WithoutTrianglesIsNone) { EXPECT_EQ(WindingNumber({}, 0.04).At({0, 0, 0}), 0); }

}  // namespace
}  // namespace curvefusion
