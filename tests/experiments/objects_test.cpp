#include "experiments/simulation/objects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "experiments/metrics/truth.h"
#include "experiments/simulation/object_truth.h"
#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

// Independent counts: made with another program from the same drawings (junctions by valence,
// components, cycles, free ends, length of wire in metres by diameter in millimetres).
struct ObjectCounts {
  std::string name;
  std::map<int, int> valences;
  int components;
  int cycles;
  int free_ends;
  std::map<double, double> lengths;
};

std::vector<ObjectCounts> KnownCounts() {
  return {
      {"dish", {{3, 14}}, 1, 8, 0, {{9, 1.32}, {5, 3.26}}},
      {"cage", {{3, 20}, {4, 30}}, 1, 41, 0, {{4.5, 6.14}}},
      {"cat", {{3, 22}}, 1, 12, 0, {{6, 1.95}, {4.5, 0.66}}},
      {"deco", {{3, 14}}, 1, 8, 0, {{5.5, 2.58}}},
      {"hanger", {{3, 30}}, 1, 16, 0, {{12, 1.79}, {4, 6.18}}},
      {"rack", {{3, 32}}, 1, 17, 0, {{11, 2.07}, {5.5, 5.61}}},
      {"chair", {{3, 70}, {4, 266}}, 1, 300, 4, {{4.5, 21.29}, {12, 2.17}}},
      {"wine", {{3, 12}}, 1, 7, 0, {{6, 3.12}}},
      {"cubeframe", {{3, 6}, {4, 4}, {5, 3}}, 1, 12, 1, {{4.5, 2.72}, {7, 0.355}}},
      {"stool",
       {{3, 16}, {4, 4}, {12, 1}},
       1,
       16,
       4,
       {{8, 1.454}, {6, 0.691}, {5, 0.874}, {4.5, 1.32}}},
      {"basket", {{3, 46}, {4, 26}}, 1, 50, 0, {{7, 0.488}, {6, 0.915}, {5, 0.646}, {4.5, 5.691}}},
      {"shelf", {{3, 48}, {4, 12}}, 1, 33, 8, {{8, 1.6}, {6, 3.24}, {5, 4.8}}},
      {"ladder", {{3, 18}}, 1, 8, 4, {{8, 0.907}, {5, 1.44}}},
      {"dome", {{5, 12}}, 1, 19, 0, {{5, 4.732}}},
      {"spring", {}, 1, 0, 2, {{5, 3.032}}},
      {"knot", {{2, 1}}, 1, 1, 0, {{6, 1.585}}},
      {"coat_stand", {{4, 3}, {5, 1}}, 1, 0, 11, {{12, 0.42}, {8, 0.522}, {5, 0.742}}}};
}

std::map<int, int> CountDegrees(const SkeletonGraph& graph) {
  std::map<int, int> degrees;
  for (const NodeId node : graph.Nodes()) ++degrees[graph.Degree(node)];
  return degrees;
}

class Objects : public testing::TestWithParam<ObjectCounts> {};

TEST_P(Objects, TruthSkeletonHasTheCountedTopology) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject(GetParam().name));
  std::map<int, int> expected = GetParam().valences;
  if (GetParam().free_ends > 0) expected[1] = GetParam().free_ends;
  EXPECT_EQ(CountDegrees(truth), expected);
  EXPECT_EQ(truth.ComponentCount(), GetParam().components);
  EXPECT_EQ(truth.CycleRank(), GetParam().cycles);
}

TEST_P(Objects, WireLengthsByDiameterAreThoseCounted) {
  std::map<double, double> lengths;
  for (const WireCurve& curve : MakeObject(GetParam().name).curves) {
    lengths[std::round(curve.diameter * 1e4) / 10] += Length(curve.points);
  }
  ASSERT_EQ(lengths.size(), GetParam().lengths.size());
  // 5 mm: the counts are given to a centimetre.
  for (const auto& [diameter, length] : GetParam().lengths) {
    EXPECT_NEAR(lengths[diameter], length, 0.0051) << diameter << " mm wire";
  }
}

TEST_P(Objects, TruthSkeletonKeepsLengthAndRadii) {
  const WireObject object = MakeObject(GetParam().name);
  const SkeletonGraph truth = TruthSkeleton(object);
  double length = 0;
  for (const WireCurve& curve : object.curves) length += Length(curve.points);
  // 0.05 %: polygons miss the true meeting of their curves by up to 0.05 mm at a contact.
  EXPECT_NEAR(truth.TotalLength(), length, 0.0005 * length);
  for (const EdgeId edge : truth.Edges()) {
    EXPECT_EQ(truth.edge(edge).radii.size(), truth.edge(edge).points.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Counted, Objects, testing::ValuesIn(KnownCounts()),
                         [](const auto& test) { return test.param.name; });

TEST(StudyObjects, HaveTheStructureTheirStudiesNeed) {
  EXPECT_EQ(TruthSkeleton(MakeObject("triangles")).ComponentCount(), 4);
  EXPECT_EQ(TruthSkeleton(MakeObject("triangles")).CycleRank(), 4);
  EXPECT_EQ(TruthSkeleton(MakeObject("parallel_wires")).ComponentCount(), 6);
  EXPECT_EQ(CountDegrees(TruthSkeleton(MakeObject("valence6"))),
            (std::map<int, int>{{1, 6}, {6, 1}}));
  EXPECT_EQ(CountDegrees(TruthSkeleton(MakeObject("breadholder"))), (std::map<int, int>{{3, 10}}));
  EXPECT_EQ(CountDegrees(TruthSkeleton(MakeObject("mesh_panel"))),
            (std::map<int, int>{{3, 24}, {4, 36}}));
  EXPECT_TRUE(MakeObject("empty").curves.empty());
  EXPECT_TRUE(TruthSkeleton(MakeObject("empty")).empty());
}

TEST(StudyObjects, ObeySpacingAndDiameter) {
  const WireObject wires = MakeObject("parallel_wires", {.wire_diameter = 0.003, .spacing = 0.012});
  ASSERT_EQ(wires.curves.size(), 6u);
  // Rounding of millimetres to metres only.
  EXPECT_NEAR((wires.curves[1].points[0] - wires.curves[0].points[0]).norm(), 0.012, 1e-12);
  for (const WireCurve& curve : wires.curves) EXPECT_EQ(curve.diameter, 0.003);
}

TEST(StudyObjects, EveryNameMakesAnObject) {
  for (const std::string& name : ObjectNames()) EXPECT_EQ(MakeObject(name).name, name);
}

TEST(StudyObjects, UnknownNameIsRefusedWithTheNearest) {
  EXPECT_THAT(MessageOf(ErrorKind::kUsage, [] { MakeObject("cagee"); }),
              testing::HasSubstr("'cage'"));
}

TEST(TruthSkeleton, WiresThatShareAPointAreWeldedAndOthersPass) {
  // Two wires cross in a shared point, a third passes 0.5 mm above the crossing.
  const WireObject object{"cross",
                          {{{{-0.1, 0, 0}, {0, 0, 0}, {0.1, 0, 0}}, 0.004},
                           {{{0, -0.1, 0}, {0, 0, 0}, {0, 0.1, 0}}, 0.004},
                           {{{-0.1, -0.1, 0.0005}, {0.1, 0.1, 0.0005}}, 0.004}},
                          WeldRule::kSharedPoints};
  const SkeletonGraph truth = TruthSkeleton(object);
  EXPECT_EQ(CountDegrees(truth), (std::map<int, int>{{1, 6}, {4, 1}}));
  EXPECT_EQ(truth.ComponentCount(), 2);
  WireObject near = object;
  near.welds = WeldRule::kNearness;
  EXPECT_EQ(TruthSkeleton(near).ComponentCount(), 1);
}

TEST(TruthSkeleton, RadiiFollowAWireThatTapers) {
  // Thins from 8 to 4 mm over 100 mm; a branch leaves where it is 7 mm thick.
  const WireObject object{"branch",
                          {{{{0, 0, 0}, {0, 0, 0.025}, {0, 0, 0.1}}, 0.006, {0.008, 0.007, 0.004}},
                           {{{0, 0, 0.025}, {0.1, 0, 0.025}}, 0.003}},
                          WeldRule::kSharedPoints};
  const SkeletonGraph truth = TruthSkeleton(object);
  ASSERT_EQ(truth.edge_count(), 3);
  for (const EdgeId id : truth.Edges()) {
    const SkeletonEdge& edge = truth.edge(id);
    for (size_t i = 0; i < edge.points.size(); ++i) {
      const bool branch = edge.points.back().x() > 0 || edge.points.front().x() > 0;
      const double expected = branch ? 0.0015 : 0.004 - 0.02 * edge.points[i].z();
      EXPECT_NEAR(edge.radii[i], expected, 1e-15);  // rounding
    }
  }
}

TEST(TruthSkeleton, CurvesFileKeepsTheTaper) {
  const WireObject object{"taper", {{{{0, 0, 0}, {0, 0, 0.1}}, 0.006, {0.008, 0.004}}}};
  const std::filesystem::path path = TemporaryPath("objects_curves.json");
  WriteCurves(path, object);
  const SkeletonGraph truth = ReadTruth(path);
  std::filesystem::remove(path);
  ASSERT_EQ(truth.edge_count(), 1);
  EXPECT_EQ(truth.edge(truth.Edges()[0]).radii, (std::vector<double>{0.004, 0.002}));
}

}  // namespace
}  // namespace curvefusion
