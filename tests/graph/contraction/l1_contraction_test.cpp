#include "graph/contraction/l1_contraction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "kernel/cloud_io.h"
#include "kernel/error.h"
#include "kernel/parallel.h"
#include "tests/error_message.h"
#include "tests/graph/noisy_wires.h"
#include "tests/graph/tube_points.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

// Wires as the paper assumes them: 5 mm thick, .5 mm of noise, about 10 points per mm of wire.
constexpr double kRadius = 2.5e-3;
constexpr double kNoise = 0.5e-3;
constexpr double kPointsPerMetre = 10000;

void AddWire(const Vec3& a, const Vec3& b, ObservedPoints& points) {
  const double length = (b - a).norm();
  AddTube({a, b}, kRadius, static_cast<int>(length * kPointsPerMetre), kNoise, points);
}

std::vector<NodeId> NodesOfDegree(const SkeletonGraph& graph, int degree) {
  std::vector<NodeId> nodes;
  for (const NodeId node : graph.Nodes()) {
    if (graph.Degree(node) == degree) nodes.push_back(node);
  }
  return nodes;
}

double DistanceToNearestNode(const SkeletonGraph& graph, const std::vector<NodeId>& nodes,
                             const Vec3& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const NodeId node : nodes) nearest = std::min(nearest, (graph.position(node) - p).norm());
  return nearest;
}

TEST(ExtractL1Skeleton, HelixIsOneOpenCurve) {
  const SkeletonGraph graph = ExtractL1Skeleton(HelixTube(), {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 0);
  // A median over 150 points of 2.5 mm scatter errs by .2 mm per axis; four times that.
  EXPECT_LT(GreatestDistance(graph, {TestHelix()}), 0.8e-3);
  // Medians stop short of a free end, by two spacings of 3 mm at the very most.
  const Polyline& points = graph.edge(graph.Edges()[0]).points;
  EXPECT_NEAR(Length(points), Length(TestHelix()), 2 * 6e-3);
}

TEST(ExtractL1Skeleton, SamplesKeepTheirDistanceAlongTheCurve) {
  const ContractedSamples samples = ContractToMedian(HelixTube(), {});
  ASSERT_GT(samples.size(), 200u);
  std::vector<double> places;
  for (size_t i = 0; i < samples.size(); ++i) {
    EXPECT_NEAR(samples.directions[i].norm(), 1, 1e-12);  // rounding
    EXPECT_GE(samples.directionality[i], 1.0 / 3);
    EXPECT_LE(samples.directionality[i], 1);
    places.push_back(Project(TestHelix(), samples.positions[i]).arc_length);
  }
  std::sort(places.begin(), places.end());
  // Repulsion evens the gaps out; without it (mu = 0) they reach 6.7 mm here. One spacing is 3 mm.
  double widest = 0;
  for (size_t i = 1; i < places.size(); ++i) widest = std::max(widest, places[i] - places[i - 1]);
  EXPECT_LT(widest, 1.5 * samples.spacing);
}

TEST(ExtractL1Skeleton, YHasOneJunctionOfThree) {
  ObservedPoints points;
  for (const double angle : {0.0, 2.2, 4.3})
    AddWire(Vec3::Zero(), 0.1 * Vec3(std::cos(angle), std::sin(angle), 0.2), points);
  const SkeletonGraph graph = ExtractL1Skeleton(points, {});
  const std::vector<NodeId> junctions = NodesOfDegree(graph, 3);
  ASSERT_EQ(junctions.size(), 1u);
  EXPECT_EQ(graph.edge_count(), 3);
  EXPECT_EQ(graph.ComponentCount(), 1);
  // The arms' lines meet in the truth to within the arms' own error; a spacing is generous.
  EXPECT_LT(graph.position(junctions[0]).norm(), 3e-3);
}

TEST(ExtractL1Skeleton, RingIsOneClosedEdge) {
  Polyline ring;
  for (int i = 0; i <= 360; ++i)
    ring.emplace_back(0.06 * std::cos(i * M_PI / 180), 0.06 * std::sin(i * M_PI / 180), 0);
  ObservedPoints points;
  AddTube(ring, kRadius, 4000, kNoise, points);
  const SkeletonGraph graph = ExtractL1Skeleton(points, {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.node_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 1);
  // Medians of a bent wire lie inside of it by h^2 / (16 * 60 mm) or so, .6 mm at 25 mm, plus
  // noise.
  EXPECT_LT(GreatestDistance(graph, {ring}), 1.5e-3);
}

TEST(ExtractL1Skeleton, LatticeHasItsCrossingsAndMeshes) {
  ObservedPoints points;
  for (const double x : {-0.06, 0.0, 0.06}) {
    AddWire({x, -0.09, 0}, {x, 0.09, 0}, points);
    AddWire({-0.09, x, 0}, {0.09, x, 0}, points);
  }
  const SkeletonGraph graph = ExtractL1Skeleton(points, {});
  const std::vector<NodeId> crossings = NodesOfDegree(graph, 4);
  EXPECT_EQ(crossings.size(), 9u);
  EXPECT_EQ(NodesOfDegree(graph, 1).size(), 12u);
  EXPECT_EQ(graph.node_count(), 21);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.CycleRank(), 4);
  for (const double x : {-0.06, 0.0, 0.06}) {
    for (const double y : {-0.06, 0.0, 0.06})
      EXPECT_LT(DistanceToNearestNode(graph, crossings, {x, y, 0}), 3e-3);  // one spacing
  }
}

TEST(ExtractL1Skeleton, ParallelWiresStayApart) {
  ObservedPoints points;
  // The paper resolves spacings down to 17 mm; 25 mm is what neighbourhoods of 25 mm must manage.
  for (const double y : {0.0, 0.025, 0.05}) AddWire({0, y, 0}, {0.2, y, 0}, points);
  const SkeletonGraph graph = ExtractL1Skeleton(points, {});
  EXPECT_EQ(graph.ComponentCount(), 3);
  EXPECT_EQ(graph.edge_count(), 3);
}

TEST(ExtractL1Skeleton, FewFarPointsAreNoise) {
  ObservedPoints points = HelixTube();
  const size_t wire_points = points.size();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-0.2, 0.2);
  while (points.size() < wire_points + wire_points / 100)  // one in a hundred, as in a depth image
    points.Add({coordinate(random), coordinate(random), coordinate(random)}, Vec3::Zero(), 1);
  const SkeletonGraph graph = ExtractL1Skeleton(points, {});
  EXPECT_EQ(graph.edge_count(), 1);
}

TEST(ExtractL1Skeleton, SameBitsForAnyNumberOfThreads) {
  const ObservedPoints points = HelixTube();
  SkeletonGraph one, two;
  {
    const ThreadLimit limit(1);
    one = ExtractL1Skeleton(points, {});
  }
  {
    const ThreadLimit limit(2);
    two = ExtractL1Skeleton(points, {});
  }
  EXPECT_FALSE(one.empty());
  EXPECT_TRUE(SameBits(one, two));
}

TEST(ExtractL1Skeleton, NothingCurveLikeGivesAnEmptyGraph) {
  ObservedPoints points;
  EXPECT_TRUE(ExtractL1Skeleton(points, {}).empty());
  points.Add(Vec3(1, 2, 3), Vec3::Zero(), 1);
  EXPECT_TRUE(ExtractL1Skeleton(points, {}).empty());
  for (int i = 0; i < 50; ++i) points.Add(Vec3(1, 2, 3), Vec3::Zero(), 1);
  EXPECT_TRUE(ExtractL1Skeleton(points, {}).empty());
}

TEST(ExtractL1Skeleton, NamesAPointThatIsNotFinite) {
  ObservedPoints points = HelixTube();
  points.positions[17].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(MessageOf(ErrorKind::kBadInput, [&] { ExtractL1Skeleton(points, {}); }),
              testing::HasSubstr("point 17 of 6000"));
}

TEST(OptionsForRadius, FollowTheScaleOfTheCloud) {
  const ObservedPoints metres = HelixTube();
  ObservedPoints inches = metres;
  for (Vec3& p : inches.positions) p *= 1 / 0.0254;
  const L1Options options;
  const SkeletonGraph a = ExtractL1Skeleton(metres, options);
  const SkeletonGraph b = ExtractL1Skeleton(inches, OptionsForRadius(15 / 25.4));
  ASSERT_EQ(b.edge_count(), 1);
  // Rounding is the only difference, but contraction amplifies it a little.
  EXPECT_NEAR(b.TotalLength() * 0.0254, a.TotalLength(), 1e-3);
}

// The synthetic scans that the original L1 code was measured on: 37 cycles in 20 s, 5 in 4.8 s.
class SharedClouds
    : public testing::TestWithParam<std::tuple<const char*, int, int, std::array<int, 2>>> {};

TEST_P(SharedClouds, HaveTheirJunctionsAndCycles) {
  const auto [name, junctions, cycles, degrees] = GetParam();
  const auto path = SharedData(std::filesystem::path("clouds") / name);
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  ObservedPoints points = ReadCloud(path);
  for (Vec3& p : points.positions) p *= kMillimetre;
  const SkeletonGraph graph = ExtractL1Skeleton(points, {});
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_EQ(graph.CycleRank(), cycles);
  EXPECT_EQ(graph.node_count(), junctions);
  for (const NodeId node : graph.Nodes()) {
    EXPECT_GE(graph.Degree(node), degrees[0]);
    EXPECT_LE(graph.Degree(node), degrees[1]);
  }
}

INSTANTIATE_TEST_SUITE_P(Clouds, SharedClouds,
                         testing::Values(std::tuple("cageB.xyz", 48, 37, std::array{3, 4}),
                                         std::tuple("cubeB.xyz", 8, 5, std::array{3, 3})));

}  // namespace
}  // namespace curvefusion
