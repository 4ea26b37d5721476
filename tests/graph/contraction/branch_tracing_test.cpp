#include "graph/contraction/branch_tracing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvefusion {
namespace {

constexpr double kSpacing = 3e-3;

ContractedSamples NoSamples() {
  ContractedSamples samples;
  samples.spacing = kSpacing;
  return samples;
}

void AddSample(const Vec3& position, const Vec3& direction, double directionality,
               ContractedSamples& samples) {
  samples.positions.push_back(position);
  samples.directions.push_back(direction);
  samples.directionality.push_back(directionality);
}

// Samples every millimetre on the way from a to b, ends included, as contraction leaves them.
void AddRun(const Vec3& a, const Vec3& b, ContractedSamples& samples) {
  const int steps = static_cast<int>(std::lround((b - a).norm() / 1e-3));
  for (int i = 0; i <= steps; ++i)
    AddSample(a + (b - a) * i / steps, (b - a).normalized(), 0.99, samples);
}

// Samples without a direction, within a millimetre of p.
void AddJunction(const Vec3& p, ContractedSamples& samples) {
  for (int i = 0; i < 5; ++i)
    AddSample(p + 1e-3 * Vec3(std::cos(i), std::sin(i), 0), Vec3::UnitZ(), 0.6, samples);
}

std::vector<int> Degrees(const SkeletonGraph& graph) {
  std::vector<int> degrees;
  for (const NodeId node : graph.Nodes()) degrees.push_back(graph.Degree(node));
  std::sort(degrees.begin(), degrees.end());
  return degrees;
}

// Bit for bit, which AddEdge asserts in debug builds only.
void ExpectEndsAtNodes(const SkeletonGraph& graph) {
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    EXPECT_EQ(edge.points.front(), graph.position(edge.nodes[0]));
    EXPECT_EQ(edge.points.back(), graph.position(edge.nodes[1]));
    for (size_t i = 1; i < edge.points.size(); ++i) EXPECT_NE(edge.points[i - 1], edge.points[i]);
  }
}

TEST(TraceBranches, RunOfSamplesIsOneEdge) {
  ContractedSamples samples = NoSamples();
  AddRun({0, 0, 0}, {0.1, 0, 0}, samples);
  const SkeletonGraph graph = TraceBranches(samples, {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_NEAR(graph.TotalLength(), 0.1, 1e-12);  // rounding: free ends reach the last sample
}

TEST(TraceBranches, ClusterWithoutDirectionIsAJunctionOfFour) {
  ContractedSamples samples = NoSamples();
  AddJunction(Vec3::Zero(), samples);
  for (int k = 0; k < 4; ++k) {
    const Vec3 arm(std::cos(k * M_PI / 2), std::sin(k * M_PI / 2), 0);
    AddRun(7e-3 * arm, 0.06 * arm, samples);
  }
  const SkeletonGraph graph = TraceBranches(samples, {});
  EXPECT_EQ(Degrees(graph), (std::vector<int>{1, 1, 1, 1, 4}));
  ExpectEndsAtNodes(graph);
}

TEST(TraceBranches, CornerOfThreeLiesWhereTheBranchesPoint) {
  ContractedSamples samples = NoSamples();
  AddJunction({4e-3, 4e-3, 4e-3}, samples);  // drawn to the inside of the corner
  for (int axis = 0; axis < 3; ++axis)
    AddRun(8e-3 * Vec3::Unit(axis), 0.06 * Vec3::Unit(axis), samples);
  const SkeletonGraph graph = TraceBranches(samples, {});
  ASSERT_EQ(Degrees(graph), (std::vector<int>{1, 1, 1, 3}));
  for (const NodeId node : graph.Nodes()) {
    // The mean keeps a weight of .1 against 2 from the lines: 7 mm * .1 / 2.1.
    if (graph.Degree(node) == 3) {
      EXPECT_LT(graph.position(node).norm(), 0.5e-3);
    }
  }
}

TEST(TraceBranches, FarClustersAreTwoJunctionsAndNearOnesAreOne) {
  for (const double distance : {4e-3, 30e-3}) {
    ContractedSamples samples = NoSamples();
    const Vec3 second(distance, 0, 0);
    AddJunction(Vec3::Zero(), samples);
    AddJunction(second, samples);
    if (distance > 20e-3) AddRun({7e-3, 0, 0}, {distance - 7e-3, 0, 0}, samples);
    for (const double side : {-1.0, 1.0}) {
      AddRun({-7e-3, 7e-3 * side, 0}, {-0.05, 0.05 * side, 0}, samples);
      AddRun(second + Vec3(7e-3, 7e-3 * side, 0), second + Vec3(0.05, 0.05 * side, 0), samples);
    }
    const SkeletonGraph graph = TraceBranches(samples, {});
    EXPECT_EQ(Degrees(graph), distance > 20e-3 ? (std::vector<int>{1, 1, 1, 1, 3, 3})
                                               : (std::vector<int>{1, 1, 1, 1, 4}));
  }
}

TEST(TraceBranches, GapsAreBridgedUpToTheReach) {
  const double reach = BranchTracingOptions().join_reach * kSpacing;
  for (const double gap : {0.8 * reach, 1.6 * reach}) {
    ContractedSamples samples = NoSamples();
    AddRun({0, 0, 0}, {0.05, 0, 0}, samples);
    AddRun({0.05 + gap, 0, 0}, {0.1 + gap, 0, 0}, samples);
    const SkeletonGraph graph = TraceBranches(samples, {});
    EXPECT_EQ(graph.edge_count(), gap < reach ? 1 : 2) << "gap " << gap;
    ExpectEndsAtNodes(graph);
  }
}

TEST(TraceBranches, ParallelEndsAreNotBridged) {
  ContractedSamples samples = NoSamples();
  AddRun({0, 0, 0}, {0.05, 0, 0}, samples);
  AddRun({0, 8e-3, 0}, {0.05, 8e-3, 0}, samples);
  EXPECT_EQ(TraceBranches(samples, {}).ComponentCount(), 2);
}

TEST(TraceBranches, EndJoinsTheSideItRunsUpTo) {
  ContractedSamples samples = NoSamples();
  AddRun({-0.05, 0, 0}, {0.05, 0, 0}, samples);
  AddRun({0, 9e-3, 0}, {0, 0.05, 0}, samples);
  const SkeletonGraph graph = TraceBranches(samples, {});
  EXPECT_EQ(Degrees(graph), (std::vector<int>{1, 1, 1, 3}));
  ExpectEndsAtNodes(graph);
}

TEST(TraceBranches, LoneClusterProlongsItsBranchToTheNext) {
  ContractedSamples samples = NoSamples();
  AddRun({0, 0, 0}, {0.05, 0, 0}, samples);
  AddJunction({0.06, 0, 0}, samples);
  AddJunction({0.072, 0, 0}, samples);  // out of reach of the first run's end
  AddRun({0.08, 5e-3, 0}, {0.1, 0.04, 0}, samples);
  AddRun({0.08, -5e-3, 0}, {0.1, -0.04, 0}, samples);
  const SkeletonGraph graph = TraceBranches(samples, {});
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(Degrees(graph), (std::vector<int>{1, 1, 1, 3}));
}

TEST(TraceBranches, ClosedCurveIsOneEdge) {
  ContractedSamples samples = NoSamples();
  for (int i = 0; i < 180; ++i) {
    const double angle = i * M_PI / 90;
    AddSample({0.03 * std::cos(angle), 0.03 * std::sin(angle), 0},
              {-std::sin(angle), std::cos(angle), 0}, 0.95 + 1e-4 * (i % 7), samples);
  }
  const SkeletonGraph graph = TraceBranches(samples, {});
  EXPECT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 1);
  ExpectEndsAtNodes(graph);
}

TEST(TraceBranches, FoldInAJunctionIsNoLoop) {
  for (const double radius : {4e-3, 20e-3}) {
    ContractedSamples samples = NoSamples();
    AddJunction(Vec3::Zero(), samples);
    AddRun({-0.05, 0, 0}, {-7e-3, 0, 0}, samples);
    AddRun({7e-3, 0, 0}, {0.05, 0, 0}, samples);
    const Vec3 center(0, radius + 1e-3, 0);
    const int steps = static_cast<int>(2 * M_PI * radius / 1e-3);
    for (int i = 0; i < steps; ++i) {  // open towards the junction by 60 degrees
      const double angle = -M_PI / 3 + (5 * M_PI / 3) * i / steps;
      AddSample(center + radius * Vec3(std::cos(angle), std::sin(angle), 0),
                {-std::sin(angle), std::cos(angle), 0}, 0.95, samples);
    }
    EXPECT_EQ(TraceBranches(samples, {}).CycleRank(), radius > 10e-3 ? 1 : 0) << radius;
  }
}

TEST(TraceBranches, SharpCornerEndsABranch) {
  ContractedSamples samples = NoSamples();
  AddRun({0, 0, 0}, {0.05, 0, 0}, samples);
  AddRun({0.05, 4e-3, 0}, {0.05, 0.05, 0}, samples);
  BranchTracingOptions options;
  options.join_reach = 1;  // nothing is joined, so that the walk itself is seen
  EXPECT_EQ(TraceBranches(samples, options).edge_count(), 2);
}

TEST(TraceBranches, FewSamplesAreNoBranch) {
  ContractedSamples samples = NoSamples();
  AddRun({0, 0, 0}, {3e-3, 0, 0}, samples);  // four samples; five are asked for
  EXPECT_TRUE(TraceBranches(samples, {}).empty());
  EXPECT_TRUE(TraceBranches(NoSamples(), {}).empty());
}

}  // namespace
}  // namespace curvefusion
