#include "experiments/simulation/families/families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/metrics/curve_metrics.h"
#include "experiments/simulation/object_truth.h"
#include "graph/validate.h"
#include "kernel/error.h"
#include "kernel/spatial_search.h"
#include "tests/error_message.h"

namespace curvefusion {
namespace {

constexpr uint64_t kSeeds = 5;

class ShapeFamilies : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(All, ShapeFamilies, testing::ValuesIn(ShapeFamilyNames()),
                         [](const auto& test) { return test.param; });

double LargestExtent(const WireObject& object) {
  Eigen::AlignedBox3d bounds;
  for (const WireCurve& wire : object.curves) {
    for (const Vec3& p : wire.points) bounds.extend(p);
  }
  return bounds.sizes().maxCoeff();
}

// How much air is least between wires away from what joins them, as a share of what their radii
// take; 1 where they touch.
double LeastGap(const SkeletonGraph& truth) {
  const SkeletonSamples samples = SampleSkeleton(truth, 0.002);
  const PointIndex index(samples.positions);
  std::vector<Vec3> nodes;
  for (const NodeId node : truth.Nodes()) nodes.push_back(truth.position(node));
  const PointIndex node_index(nodes);
  double least = 2;
  std::vector<int> near;
  for (size_t i = 0; i < samples.size(); ++i) {
    const double reach = 4 * 0.006;  // four of the greatest radii: at a weld wires run into another
    node_index.WithinRadius(samples.positions[i], reach, near);
    if (!near.empty()) continue;
    index.WithinRadius(samples.positions[i], 0.012, near);
    for (const int j : near) {
      const bool same = samples.edges[i] == samples.edges[j];
      const double separation = std::abs(samples.arc_lengths[i] - samples.arc_lengths[j]);
      const double length = Length(truth.edge(samples.edges[i]).points);
      if (same && std::min(separation, length - separation) < 0.035) continue;
      const double touching = samples.radii[i] + samples.radii[j];
      least = std::min(least, (samples.positions[i] - samples.positions[j]).norm() / touching);
    }
  }
  return least;
}

TEST_P(ShapeFamilies, KeepTheirRangesAndAValidTruth) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const WireObject object = MakeFamilyObject(GetParam(), seed);
    const std::string name = GetParam() + " " + std::to_string(seed);
    EXPECT_GE(LargestExtent(object), 0.15) << name;
    EXPECT_LE(LargestExtent(object), 0.9) << name;
    for (const WireCurve& wire : object.curves) {
      for (size_t i = 0; i < wire.points.size(); ++i) {
        EXPECT_GE(wire.DiameterAt(i), 0.0025 * (1 - 1e-12)) << name;  // rounding of millimetres
        EXPECT_LE(wire.DiameterAt(i), 0.012 * (1 + 1e-12)) << name;
      }
    }
    const SkeletonGraph truth = TruthSkeleton(object);
    // No two axes nearer than 2 mm but where they are welded: the thinnest wires would overlap.
    EXPECT_EQ(Violations(truth, 0.002), std::vector<std::string>{}) << name;
    EXPECT_GE(LeastGap(truth), 0.9) << name;
  }
}

// Seed 61 draws wires so thick that their scrolls need smaller gaps to fit into their cells.
TEST(Scrolls, ComeNearerWhereTheirCellIsSmall) {
  const SkeletonGraph truth = TruthSkeleton(MakeFamilyObject("scrolls", 61));
  EXPECT_EQ(Violations(truth, 0.002), std::vector<std::string>{});
  EXPECT_GE(LeastGap(truth), 0.9);
}

TEST_P(ShapeFamilies, AreGivenByTheirSeed) {
  const WireObject object = MakeFamilyObject(GetParam(), 7);
  const WireObject again = MakeFamilyObject(GetParam(), 7);
  const WireObject other = MakeFamilyObject(GetParam(), 8);
  ASSERT_EQ(object.curves.size(), again.curves.size());
  for (size_t i = 0; i < object.curves.size(); ++i) {
    EXPECT_EQ(object.curves[i].points, again.curves[i].points);
    EXPECT_EQ(object.curves[i].diameter, again.curves[i].diameter);
    EXPECT_EQ(object.curves[i].diameters, again.curves[i].diameters);
  }
  EXPECT_NE(object.curves[0].points, other.curves[0].points);
}

std::vector<SkeletonGraph> TruthsOf(const std::string& family) {
  std::vector<SkeletonGraph> truths;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    truths.push_back(TruthSkeleton(MakeFamilyObject(family, seed)));
  }
  return truths;
}

int GreatestValence(const SkeletonGraph& truth) {
  int greatest = 0;
  for (const NodeId node : truth.Nodes()) greatest = std::max(greatest, truth.Degree(node));
  return greatest;
}

TEST(ShapeFamily, HaveWhatTheirNamesSay) {
  for (const SkeletonGraph& truth : TruthsOf("umbrella")) {
    EXPECT_GE(GreatestValence(truth), 8);
    EXPECT_LE(GreatestValence(truth), 12);
  }
  for (const SkeletonGraph& truth : TruthsOf("tree")) {
    EXPECT_EQ(truth.CycleRank(), 0);
    EXPECT_EQ(truth.ComponentCount(), 1);
    for (const EdgeId edge : truth.Edges()) {
      EXPECT_NE(truth.edge(edge).radii.front(), truth.edge(edge).radii.back());
    }
  }
  for (const SkeletonGraph& truth : TruthsOf("knot")) {
    EXPECT_EQ(truth.CycleRank(), truth.ComponentCount());
    EXPECT_EQ(truth.edge_count(), truth.ComponentCount());
  }
  // A shoot winds around its stake and is not joined to it: two pieces for each.
  for (const SkeletonGraph& truth : TruthsOf("vine")) EXPECT_EQ(truth.ComponentCount() % 2, 0);
  for (const SkeletonGraph& truth : TruthsOf("cables")) {
    EXPECT_GE(truth.ComponentCount(), 2);
    EXPECT_EQ(truth.CycleRank(), 0);
  }
}

TEST(ShapeFamily, UnknownNameIsRefusedWithTheNearest) {
  EXPECT_THAT(MessageOf(ErrorKind::kUsage, [] { MakeFamilyObject("umbrela", 1); }),
              testing::HasSubstr("umbrella?"));
}

}  // namespace
}  // namespace curvefusion
