#include "meshing/tube_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr double kRadius = 0.004;
constexpr double kLength = 0.1;
constexpr double kCapsule = std::numbers::pi * kRadius * kRadius * (kLength + 4.0 / 3 * kRadius);

void AddWire(const Vec3& from, const Vec3& to, SkeletonGraph& graph) {
  const NodeId a = graph.AddNode(from);
  const NodeId b = graph.AddNode(to);
  graph.AddEdge({{a, b}, {from, to}, {kRadius, kRadius}, {}});
}

TEST(VolumeOfTubes, OneStraightWireIsExact) {
  SkeletonGraph graph;
  AddWire({0, 0, 0}, {kLength, 0, 0}, graph);
  const SampledVolume sampled = VolumeOfTubes(graph, 100);
  EXPECT_NEAR(sampled.volume / kCapsule, 1, 1e-12);
  EXPECT_EQ(sampled.relative_error, 0);
}

TEST(VolumeOfTubes, WhatIsThereTwiceCountsOnce) {
  SkeletonGraph graph;
  AddWire({0, 0, 0}, {kLength, 0, 0}, graph);
  AddWire({kLength, 0, 0}, {0, 0, 0}, graph);
  EXPECT_NEAR(VolumeOfTubes(graph, 100).volume / kCapsule, 1, 1e-12);
}

// Two cylinders of radius r that cross at right angles share 16/3 r^3 (Archimedes).
TEST(VolumeOfTubes, CrossingWiresShareTheirCrossing) {
  SkeletonGraph graph;
  AddWire({-kLength / 2, 0, 0}, {kLength / 2, 0, 0}, graph);
  AddWire({0, -kLength / 2, 0}, {0, kLength / 2, 0}, graph);
  const double expected = 2 * kCapsule - 16.0 / 3 * std::pow(kRadius, 3);
  const SampledVolume sampled = VolumeOfTubes(graph, 20000);
  EXPECT_GT(sampled.relative_error, 0);
  EXPECT_LT(sampled.relative_error, 0.002);
  // Four standard errors: one draw in 16000 is farther off.
  EXPECT_NEAR(sampled.volume / expected, 1, 4 * sampled.relative_error);
}

TEST(VolumeOfTubes, NothingHasNoVolume) { EXPECT_EQ(VolumeOfTubes({}, 100).volume, 0); }

}  // namespace
}  // namespace curvefusion
