#include "fusion/registration/ray_noise.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

// Points of a straight wire along x, seen along z, with normal noise of a size for each axis.
ObservedPoints NoisyWire(const Vec3& sigma) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  ObservedPoints points;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 noise(sigma.x() * normal(random), sigma.y() * normal(random),
                     sigma.z() * normal(random));
    points.Add(Vec3(0.0001 * i, 0, 0.7) + noise, Vec3::UnitZ(), 1);
  }
  return points;
}

TEST(RayNoiseRatioTest, AThinCloudIsTakenAsItIs) {
  EXPECT_EQ(RayNoiseRatio(NoisyWire({0, 0.001, 0.001}), 0.3), 1);
}

TEST(RayNoiseRatioTest, NoiseAlongTheRaysIsCompressed) {
  EXPECT_GE(RayNoiseRatio(NoisyWire({0, 0.001, 0.015}), 0.3), 4);
}

// The neighbourhood of every point is a ball, which is hardly more curve-like when it is squeezed.
TEST(RayNoiseRatioTest, BlurToAllSidesIsNoNoiseAlongTheRays) {
  const ObservedPoints points = NoisyWire({0, 0.012, 0.012});
  EXPECT_LT(Linearity(points), 0.3);
  EXPECT_EQ(RayNoiseRatio(points, 0.3), 1);
}

TEST(RayNoiseRatioTest, NothingIsNotNoisy) { EXPECT_EQ(RayNoiseRatio({}, 0.3), 1); }

}  // namespace
}  // namespace curvefusion
