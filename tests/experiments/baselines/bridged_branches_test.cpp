// Branches of Huang et al. 2013 on samples that lie on lines, as contraction leaves them.
#include "experiments/baselines/bridged_branches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace curvefusion {
namespace {

constexpr double kSpacing = 3 * kMillimetre;
constexpr double kRadius = 25 * kMillimetre;

void AddLine(const Vec3& from, const Vec3& step, int count, double directionality,
             ContractedSamples& samples) {
  samples.spacing = kSpacing;
  for (int i = 0; i < count; ++i) {
    samples.positions.push_back(from + i * step);
    samples.directions.push_back(step.normalized());
    samples.directionality.push_back(directionality);
  }
}

SkeletonGraph GraphOf(const ContractedSamples& samples) {
  SkeletonGraph graph;
  AddBridgedBranches(samples, kRadius, graph);
  return graph;
}

int JunctionCount(const SkeletonGraph& graph) {
  int count = 0;
  for (const NodeId node : graph.Nodes()) count += graph.Degree(node) > 2;
  return count;
}

// Farther apart than kSpacing, so that none is taken for one beside another.
const Vec3 kRight = 3.1 * kMillimetre * Vec3::UnitX();
const Vec3 kUp = 3.1 * kMillimetre * Vec3::UnitY();

TEST(BridgedBranches, ALineIsOneBranch) {
  ContractedSamples samples;
  AddLine(Vec3::Zero(), kRight, 20, 0.95, samples);
  const SkeletonGraph graph = GraphOf(samples);
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 19 * kRight.norm(), 1e-9);
}

TEST(BridgedBranches, FewerThanFiveSamplesOrNoneDirectedAreNoBranch) {
  ContractedSamples few, undirected;
  AddLine(Vec3::Zero(), kRight, 4, 0.95, few);
  AddLine(Vec3::Zero(), kRight, 20, 0.85, undirected);
  EXPECT_TRUE(GraphOf(few).empty());
  EXPECT_TRUE(GraphOf(undirected).empty());
  EXPECT_TRUE(GraphOf({}).empty());
}

TEST(BridgedBranches, GoOnThroughSamplesWithoutDirection) {
  ContractedSamples samples;
  AddLine(Vec3::Zero(), kRight, 10, 0.95, samples);
  AddLine(10 * kRight, kRight, 3, 0.5, samples);
  AddLine(13 * kRight, kRight, 10, 0.95, samples);
  const SkeletonGraph graph = GraphOf(samples);
  EXPECT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 22 * kRight.norm(), 1e-9);
}

TEST(BridgedBranches, ABranchThatRunsIntoAnotherMakesAJunction) {
  ContractedSamples samples;
  AddLine(Vec3::Zero(), kRight, 21, 0.98, samples);
  AddLine(10 * kRight + 2 * kUp, kUp, 10, 0.95, samples);
  const SkeletonGraph graph = GraphOf(samples);
  EXPECT_EQ(graph.edge_count(), 3);
  EXPECT_EQ(JunctionCount(graph), 1);
}

// What CurveFusion's figure 5 shows: at two wires that meet in one place of low sigma, where their
// samples are not in line, one branch bridges and the other ends run into it at two places.
TEST(BridgedBranches, OneCrossingCanBecomeTwoJunctions) {
  ContractedSamples samples;
  AddLine(-12 * kRight, kRight, 10, 0.98, samples);
  AddLine(-2 * kRight, kRight, 5, 0.5, samples);
  AddLine(3 * kRight, kRight, 10, 0.98, samples);
  AddLine(-kRight + 3 * kUp, kUp, 10, 0.95, samples);
  AddLine(kRight - 12 * kUp, kUp, 10, 0.95, samples);
  EXPECT_EQ(JunctionCount(GraphOf(samples)), 2);
}

TEST(BridgedBranches, OfARingCloseIt) {
  ContractedSamples samples;
  samples.spacing = kSpacing;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::numbers::pi * i / 40;
    samples.positions.push_back(20 * kMillimetre * Vec3(std::cos(angle), std::sin(angle), 0));
    samples.directions.push_back(Vec3(-std::sin(angle), std::cos(angle), 0));
    samples.directionality.push_back(0.95);
  }
  const SkeletonGraph graph = GraphOf(samples);
  EXPECT_EQ(graph.CycleRank(), 1);
  EXPECT_EQ(JunctionCount(graph), 0);
}

}  // namespace
}  // namespace curvefusion
