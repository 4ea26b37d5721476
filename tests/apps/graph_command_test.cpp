// Runs `curvefusion graph` as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "graph/io/graph_io.h"
#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GraphCommand : public CommandLine {
 protected:
  // A square of 100 mm whose side is crossed at its middle by a loose curve, which makes no node.
  void SetUp() override {
    CommandLine::SetUp();
    SkeletonGraph graph;
    graph.AddPolyline({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}, {0, 0, 0}});
    graph.AddPolyline({{0.05, -0.05, 0}, {0.05, 0.05, 0}});
    WriteSkeleton(folder_ / "crossing.json", graph);
  }
};

TEST_F(GraphCommand, InfoIsInMillimetresAndWhatHappensWithoutOptions) {
  const Outcome info = Run("graph crossing.json --info");
  EXPECT_EQ(info.exit_code, 0);
  EXPECT_THAT(info.output, HasSubstr("length      500.0 mm"));
  EXPECT_EQ(Run("graph crossing.json").output, info.output);
}

TEST_F(GraphCommand, ValidationNamesEveryPlaceAndIsThree) {
  const Outcome invalid = Run("graph crossing.json --validate");
  EXPECT_EQ(invalid.exit_code, 3);
  EXPECT_THAT(invalid.output, HasSubstr("1 violations"));
  EXPECT_THAT(invalid.output, HasSubstr("edge 0 at 0.05 m comes within 0 mm of edge 1 at 0.05 m"));

  std::ofstream(folder_ / "torn.json")
      << R"({"format":"curvefusion-skeleton","version":1,"units":"m",
 "nodes":[{"position":[0,0,0]},{"position":[1,0,0]}],
 "edges":[{"nodes":[0,1],"points":[[0,0,0],[2,0,0]]},{"nodes":[0,5],"points":[[0,0,0],[1,0,0]]}]})";
  const Outcome torn = Run("graph torn.json --validate");
  EXPECT_EQ(torn.exit_code, 3);
  EXPECT_THAT(torn.output, HasSubstr("edges[0].points does not have node 1 as its last point"));
  EXPECT_THAT(torn.output, HasSubstr("edges[1].nodes[1] is 5, but there are 2 nodes"));
}

// Three wires that meet in a star and one more; without an arm the other two are one curve.
TEST_F(GraphCommand, CurvesAreRemovedByTheirNumbers) {
  SkeletonGraph star;
  const NodeId middle = star.AddNode({0, 0, 0});
  for (const Vec3& tip : {Vec3(0.1, 0, 0), Vec3(-0.1, 0, 0), Vec3(0, 0.03, 0)}) {
    star.AddEdge({{middle, star.AddNode(tip)}, {{0, 0, 0}, tip}, {}, {}});
  }
  star.AddPolyline({{0, 0, 0.5}, {0, 0.2, 0.5}});
  WriteSkeleton(folder_ / "star.json", star);
  const Outcome removed = Run("graph star.json --remove 3,2 -o edited.json");
  EXPECT_EQ(removed.exit_code, 0) << removed.output;
  const SkeletonGraph edited = ReadSkeleton(folder_ / "edited.json");
  EXPECT_EQ(edited.edge_count(), 1);
  EXPECT_EQ(edited.node_count(), 2);
  EXPECT_NEAR(edited.TotalLength(), 0.2, 1e-12);
  // Whatever else is written has the numbers of the new file.
  EXPECT_EQ(Run("graph star.json --remove 0,1 -o two.json --cut-list two.csv").exit_code, 0);
  EXPECT_THAT(Text("two.csv"), AllOf(HasSubstr("\n0,0,1,30"), HasSubstr("\n1,2,3,200")));
  const Outcome missing = Run("graph star.json --remove 4 -o edited.json");
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.output, HasSubstr("has 4 curves, counted from 0"));
  EXPECT_EQ(Run("graph star.json --remove 3").exit_code, 2);
}

// Squares of such coordinates overflow, on which exact predicates end in SIGFPE.
TEST_F(GraphCommand, CoordinatesBeyondTheBoundAreThree) {
  std::ofstream(folder_ / "far.json")
      << R"({"format":"curvefusion-skeleton","version":1,"units":"m",
 "nodes":[{"position":[0,0,0]},{"position":[1e308,0,0]},{"position":[0,1e308,0]}],
 "edges":[{"nodes":[0,1],"points":[[0,0,0],[1e308,0,0]]},
          {"nodes":[1,2],"points":[[1e308,0,0],[0,1e308,0]]}]})";
  for (const char* option : {"--validate", "--resolve 1 -o out.json", "--info"}) {
    const Outcome far = Run(std::string("graph far.json ") + option);
    EXPECT_EQ(far.exit_code, 3) << option;
    EXPECT_THAT(far.output, HasSubstr("edges[0].points[1] is not finite, or too far"));
  }
}

TEST_F(GraphCommand, ResolvingMakesTheJunctionThatValidationMissed) {
  EXPECT_EQ(Run("graph crossing.json --resolve 1 --smooth 10 -o mended.graphml").exit_code, 0);
  const Outcome valid = Run("graph mended.graphml --validate --info");
  EXPECT_EQ(valid.exit_code, 0);
  EXPECT_THAT(valid.output, HasSubstr("is valid"));
  EXPECT_THAT(valid.output, HasSubstr("junctions   1\n"));
  EXPECT_THAT(valid.output, HasSubstr("free ends   2\n"));
}

TEST_F(GraphCommand, ConversionTellsWhatIsLost) {
  const Outcome swc = Run("graph crossing.json --convert new/wires.swc");
  EXPECT_EQ(swc.exit_code, 0);
  EXPECT_THAT(swc.output, HasSubstr("Wrote new/wires.swc\n  edge 0 would close a cycle; "
                                    "it is cut at node 0, at (0.000, 0.000, 0.000) mm"));
  EXPECT_EQ(Run("graph crossing.json --convert copy.json").output, "Wrote copy.json\n");
  EXPECT_EQ(Run("graph crossing.json --convert wires.dxf --quiet").output, "");
  EXPECT_EQ(CountFiles(".", "wires."), 2);
}

TEST_F(GraphCommand, FitsSplinesAndListsBends) {
  const Outcome fit = Run("graph crossing.json --fit 0.5mm --convert wires.step");
  EXPECT_EQ(fit.exit_code, 0);
  EXPECT_THAT(fit.output, HasSubstr("cubic B-splines of"));
  EXPECT_EQ(Run("graph crossing.json --fit 0.5 --convert again.step --quiet").exit_code, 0);
  EXPECT_EQ(RunShell("cmp wires.step again.step").exit_code, 0);
  const Outcome list = Run("graph crossing.json --cut-list cut/wires.csv");
  EXPECT_EQ(list.output, "Wrote cut/wires.csv\n");
  EXPECT_EQ(CountFiles("cut", "wires."), 1);
  EXPECT_EQ(Run("graph crossing.json --fit 0.5").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --fit 0.5 --convert a.svg").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --fit 5cm --convert a.dxf").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --fit 0 --convert a.dxf").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --convert a.step").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --cut-list a.txt").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --bend-tolerance 2").exit_code, 2);
}

TEST_F(GraphCommand, WrongUsageIsTwo) {
  EXPECT_EQ(Run("graph crossing.json --resolve 1").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --smooth 60").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json -o out.json").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --resolve 0 -o out.json").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --proximity 1").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.json --convert out.stl").exit_code, 2);
  EXPECT_EQ(Run("graph crossing.dxf").exit_code, 2);
  EXPECT_EQ(Run("graph missing.json").exit_code, 3);
}

}  // namespace
}  // namespace curvefusion
