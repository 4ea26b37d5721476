#include "experiments/studies/limit_figures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/simulation/limit_objects.h"
#include "experiments/simulation/object_truth.h"
#include "experiments/simulation/scene.h"
#include "experiments/studies/studies.h"

namespace curvefusion {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::Pair;

SkeletonGraph TruthOf(const std::vector<WireCurve>& curves) {
  return TruthSkeleton({"limit", curves});
}

std::vector<std::string> KeysOf(const std::map<std::string, double>& values) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : values) keys.push_back(key);
  return keys;
}

TEST(LimitFigures, APerfectResultFindsEveryPlace) {
  const SkeletonGraph row = TruthOf(ThicknessRow());
  EXPECT_THAT(RecallByThickness(row, row), Each(Pair(testing::_, 1.0)));
  EXPECT_THAT(KeysOf(RecallByThickness(row, row)),
              testing::UnorderedElementsAreArray(ThicknessPlaces()));
  const SkeletonGraph rising = TruthOf(RisingWires());
  EXPECT_THAT(RecallByHeight(rising, rising), Each(Pair(testing::_, 1.0)));
  EXPECT_THAT(KeysOf(RecallByHeight(rising, rising)),
              testing::UnorderedElementsAreArray(HeightPlaces()));
  const SkeletonGraph stars = TruthOf(Stars());
  EXPECT_THAT(JunctionsAtHubs(stars, stars),
              ElementsAre(Pair("3", 1), Pair("4", 1), Pair("6", 1), Pair("8", 1)));
  EXPECT_THAT(WholeHubs(stars, stars), Each(Pair(testing::_, 1.0)));
}

TEST(LimitFigures, AnEmptyResultFindsNothing) {
  const SkeletonGraph row = TruthOf(ThicknessRow());
  EXPECT_THAT(RecallByThickness({}, row), Each(Pair(testing::_, 0.0)));
  EXPECT_THAT(JunctionsAtHubs({}, TruthOf(Stars())), Each(Pair(testing::_, 0.0)));
  EXPECT_TRUE(DiameterByTruth({}, row).empty());
}

TEST(LimitFigures, OnlyTheThinWiresMissAreThoseThatAreMissing) {
  const SkeletonGraph row = TruthOf(ThicknessRow());
  SkeletonGraph thick = row;
  for (const EdgeId edge : row.Edges()) {
    if (2 * row.edge(edge).radii.front() < 2 * kMillimetre - 1e-9) thick.RemoveEdge(edge);
  }
  const auto recall = RecallByThickness(thick, row);
  EXPECT_EQ(recall.at("1"), 0);
  EXPECT_EQ(recall.at("1.5"), 0);
  EXPECT_EQ(recall.at("2"), 1);
}

TEST(LimitFigures, AHubInTwoPartsIsTwoJunctions) {
  // Six arms, three at each end of a piece of 10 mm: what the paper warns of.
  SkeletonGraph split;
  const NodeId left = split.AddNode({-0.005, 0, 0}), right = split.AddNode({0.005, 0, 0});
  split.AddEdge({{left, right}, {{-0.005, 0, 0}, {0.005, 0, 0}}});
  const auto add = [&](NodeId from, const Vec3& to) {
    const NodeId end = split.AddNode(to);
    split.AddEdge({{from, end}, {split.position(from), to}});
  };
  for (const double z : {-0.05, 0.05}) {
    add(left, {-0.05, 0, z});
    add(right, {0.05, 0, z});
  }
  SkeletonGraph whole;
  const NodeId hub = whole.AddNode(Vec3::Zero());
  for (const double x : {-0.05, 0.0, 0.05}) {
    for (const double z : {-0.05, 0.05}) {
      const NodeId end = whole.AddNode({x, 0, z});
      whole.AddEdge({{hub, end}, {Vec3::Zero(), {x, 0, z}}});
    }
  }
  EXPECT_THAT(JunctionsAtHubs(split, whole), ElementsAre(Pair("6", 2)));
  EXPECT_THAT(WholeHubs(split, whole), ElementsAre(Pair("6", 0)));
}

TEST(LimitFigures, DiametersAreMeansOfWhatWasMeasuredThere) {
  const SkeletonGraph truth = TruthOf(MixedRadii());
  const auto perfect = DiameterByTruth(truth, truth);
  EXPECT_EQ(perfect.size(), RadiusPlaces().size());
  // Tapering wires count at the nearest place, up to .75 mm away, and evenly to both sides; at the
  // ends of the range to one side only.
  for (const auto& [place, diameter] : perfect) EXPECT_NEAR(diameter, std::stod(place), 0.4);
}

TEST(LimitObjects, TheirWiresAreWhatTheirPlacesSay) {
  const SkeletonGraph mixed = TruthOf(MixedRadii());
  EXPECT_EQ(mixed.edge_count(), 6);
  EXPECT_EQ(TruthOf(RisingWires()).ComponentCount(), 3);
  EXPECT_EQ(TruthOf(Stars()).ComponentCount(), 4);
}

TEST(LimitationsStudy, OnlyRisingWiresTouchTheTable) {
  for (const StudyCase& study_case : LimitationsStudy().cases({.quick = true})) {
    const SimulationOptions& scan = *study_case.scan;
    const WireObject object = MakeObject(scan.object, scan.object_options);
    const Scene scene = MakeScene(object, scan.scene, scan.seed);
    const double gap = scene.object_bounds.min().z() - scene.TableHeight();
    // .1 mm: rounding of the placed object.
    if (LabelOf(study_case.labels, "limit") == "surface") {
      EXPECT_NEAR(gap, 0, 1e-4);
    } else {
      EXPECT_GT(gap, 0.059);
    }
  }
}

}  // namespace
}  // namespace curvefusion
