#include "tests/meshing/grazing_contacts.h"

#include <gtest/gtest.h>

#include "meshing/surface_mesh.h"
#include "meshing/tubes.h"
#include "tests/meshing/tube_graphs.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.003;
constexpr double kTolerance = 0.02;

// Two wires that cross at right angles, their axes so many diameters apart.
void AddCrossing(double diameters, SkeletonGraph& graph) {
  const double height = 2 * kRadius * diameters;
  AddCurve(graph, {Vec3(-0.03, 0, 0), Vec3(0.03, 0, 0)}, kRadius);
  AddCurve(graph, {Vec3(0, -0.03, height), Vec3(0, 0.03, height)}, kRadius);
}

// Two wires side by side.
void AddPair(double diameters, SkeletonGraph& graph) {
  const double y = 0.05;
  const double across = 2 * kRadius * diameters;
  AddCurve(graph, {Vec3(-0.03, y, 0), Vec3(0.03, y, 0)}, kRadius);
  AddCurve(graph, {Vec3(-0.03, y + across, 0), Vec3(0.03, y + across, 0)}, kRadius);
}

SkeletonGraph Crossing(double diameters) {
  SkeletonGraph graph;
  AddCrossing(diameters, graph);
  return graph;
}

SkeletonGraph CrossingAndPair(double crossing_diameters, double pair_diameters) {
  SkeletonGraph graph = Crossing(crossing_diameters);
  AddPair(pair_diameters, graph);
  return graph;
}

std::optional<Topology> FilledMesh(const SkeletonGraph& graph, const std::vector<Ball>& fillings) {
  return TopologyOfFilled(ToTriangleMesh(BuildTubes(graph, {}).surface), fillings);
}

TEST(GrazingContacts, ContactsBeyondTheToleranceAreWhatTheyAre) {
  const auto apart = FillGrazingContacts(Crossing(1.03), kTolerance);
  ASSERT_TRUE(apart);
  EXPECT_TRUE(apart->fillings.empty());
  EXPECT_EQ(apart->topology, (Topology{2, 2}));
  const auto joined = FillGrazingContacts(Crossing(0.97), kTolerance);
  ASSERT_TRUE(joined);
  EXPECT_TRUE(joined->fillings.empty());
  EXPECT_EQ(joined->topology, (Topology{1, 1}));
}

TEST(GrazingContacts, ContactsWithinTheToleranceMayComeOutEitherWay) {
  for (const double diameters : {0.985, 1.015}) {
    const auto filled = FillGrazingContacts(Crossing(diameters), kTolerance);
    ASSERT_TRUE(filled);
    EXPECT_FALSE(filled->fillings.empty());
    EXPECT_EQ(filled->topology, (Topology{1, 1}));
    EXPECT_EQ(FilledMesh(Crossing(0.97), filled->fillings), filled->topology);
    EXPECT_EQ(FilledMesh(Crossing(1.03), filled->fillings), filled->topology);
  }
}

// Where polygons touch along a line they may touch in many places, with holes between.
TEST(GrazingContacts, TouchesAlongALineCountAsOne) {
  for (const double diameters : {0.99, 0.995, 1.0, 1.005, 1.01}) {
    const SkeletonGraph graph = CrossingAndPair(0.9, diameters);
    const auto filled = FillGrazingContacts(graph, kTolerance);
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->topology, (Topology{2, 2})) << diameters;
    EXPECT_EQ(FilledMesh(graph, filled->fillings), filled->topology) << diameters;
  }
}

// However many contacts graze elsewhere, a mesh with a contact wrong by more than the tolerance has
// another topology.
TEST(GrazingContacts, AnotherContactThatIsWrongShows) {
  const auto apart = FillGrazingContacts(CrossingAndPair(1.025, 1), kTolerance);
  const auto joined = FillGrazingContacts(CrossingAndPair(0.975, 1), kTolerance);
  ASSERT_TRUE(apart && joined);
  EXPECT_EQ(FilledMesh(CrossingAndPair(1.03, 1), apart->fillings), apart->topology);
  EXPECT_NE(FilledMesh(CrossingAndPair(0.97, 1), apart->fillings), apart->topology);
  EXPECT_EQ(FilledMesh(CrossingAndPair(0.97, 1), joined->fillings), joined->topology);
  EXPECT_NE(FilledMesh(CrossingAndPair(1.03, 1), joined->fillings), joined->topology);
}

// A ring whose hole of 1.03 radii has closed in the mesh: one component either way, another genus.
TEST(GrazingContacts, AHoleThatClosedShows) {
  const auto open = FillGrazingContacts(RingGraph(1.03 * kRadius, kRadius), kTolerance);
  ASSERT_TRUE(open);
  EXPECT_EQ(open->topology, (Topology{0, 1}));
  EXPECT_EQ(FilledMesh(RingGraph(1.1 * kRadius, kRadius), open->fillings), open->topology);
  EXPECT_EQ(FilledMesh(RingGraph(0.9 * kRadius, kRadius), open->fillings), (Topology{1, 1}));
}

}  // namespace
}  // namespace curvefusion
