#include "graph/contraction/ridge_contrast.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/graph/noisy_wires.h"

namespace curvefusion {
namespace {

const Polyline kLeft{{0, 0, 0}, {0.1, 0, 0}};
const Polyline kRight{{0, 0.02, 0}, {0.1, 0.02, 0}};
const std::vector<Vec3> kPlaces{{0.05, 0, 0}, {0.05, 0.01, 0}, {0.05, 0.02, 0}};

ObservedPoints StrongWires() {
  ObservedPoints points = NoisyWires({kLeft, kRight});
  for (float& count : points.counts) count *= 30;
  return points;
}

TEST(StandsOut, NoiseBetweenWiresDoesNot) {
  ObservedPoints points = StrongWires();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(0, 0.1), across(0, 0.02), height(-0.004, 0.004);
  for (int i = 0; i < 2000; ++i) {
    points.Add({along(random), across(random), height(random)}, Vec3::Zero(), 1);
  }
  // Ridges of noise run in any direction.
  for (const Vec3& direction : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())}) {
    const std::vector<char> stands_out =
        StandsOut(points, kPlaces, {Vec3::UnitX(), direction, Vec3::UnitX()}, {});
    EXPECT_EQ(stands_out, (std::vector<char>{1, 0, 1}));
  }
}

TEST(StandsOut, WeakWireWithClearSidesDoes) {
  ObservedPoints points = StrongWires();
  Append(points, NoisyWires({{{0.05, -0.05, 0}, {0.05, 0.07, 0}}}, 1e-3, 0.5e-3));
  EXPECT_EQ(
      StandsOut(points, {{0.05, -0.03, 0}, {0.05, 0.05, 0}}, {Vec3::UnitY(), Vec3::UnitY()}, {}),
      (std::vector<char>{1, 1}));
}

// Depth noise fills the space before and behind a wire, which is no reason to drop it.
TEST(StandsOut, WeakWireScatteredAlongItsRaysDoes) {
  ObservedPoints points = StrongWires();
  const ObservedPoints weak = NoisyWires({{{0.05, -0.05, 0}, {0.05, 0.07, 0}}}, 1e-3, 0.5e-3);
  for (size_t i = 0; i < weak.size(); ++i) {
    for (const double behind : {-0.01, -0.005, 0.0, 0.005, 0.01}) {
      points.Add(weak.positions[i] + behind * Vec3::UnitZ(), Vec3::UnitZ(), 1);
    }
  }
  const std::vector<Vec3> places{{0.05, 0, 0}, {0.05, -0.015, 0}};
  const std::vector<Vec3> directions{Vec3::UnitX(), Vec3::UnitY()};
  EXPECT_EQ(StandsOut(points, places, directions, {}), (std::vector<char>{1, 1}));
  points.viewing_rays.assign(points.size(), Vec3::Zero());
  EXPECT_EQ(StandsOut(points, places, directions, {}), (std::vector<char>{1, 0}));
}

TEST(StandsOut, EqualNeighboursDoNotMatter) {
  std::vector<Polyline> wires;
  std::vector<Vec3> places;
  for (int i = 0; i < 4; ++i) {
    wires.push_back({{0, 0.008 * i, 0}, {0.1, 0.008 * i, 0}});
    places.emplace_back(0.05, 0.008 * i, 0);
  }
  EXPECT_EQ(StandsOut(NoisyWires(wires), places, std::vector<Vec3>(4, Vec3::UnitX()), {}),
            std::vector<char>(4, 1));
}

TEST(StandsOut, NothingGivesNothing) {
  EXPECT_TRUE(StandsOut({}, {}, {}, {}).empty());
  EXPECT_EQ(StandsOut({}, {Vec3::Zero()}, {Vec3::UnitX()}, {}).size(), 1U);
}

}  // namespace
}  // namespace curvefusion
