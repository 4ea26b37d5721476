#include "graph/io/graph_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "kernel/bounds.h"
#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/graph/graph_fixtures.h"
#include "tests/graph/random_graph.h"
#include "tests/temporary_path.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

TEST(GraphIo, EveryDoubleComesBackBitForBit) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const SkeletonGraph graph = RandomGraph(seed);
    ExpectSameGraph(graph, SkeletonFromJson(SkeletonToJson(graph), "memory"));
  }
}

TEST(GraphIo, AnEmptyGraphComesBack) {
  EXPECT_TRUE(SkeletonFromJson(SkeletonToJson(SkeletonGraph()), "memory").empty());
}

TEST(GraphIo, HandlesAreCompactedInTheFile) {
  SkeletonGraph graph = YShape(0.1);
  graph.RemoveEdge(graph.Edges()[0]);
  graph.RemoveIsolatedNodes();
  const SkeletonGraph read = SkeletonFromJson(SkeletonToJson(graph), "memory");
  ExpectSameGraph(graph, read);
  EXPECT_EQ(read.Edges(), (std::vector<EdgeId>{0, 1}));
}

TEST(GraphIo, RadiusIsTheMeanAndRadiiOnlyWhereTheyDiffer) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({0, 0, 0});
  const NodeId b = graph.AddNode({1, 0, 0});
  graph.AddEdge({{a, b}, {{0, 0, 0}, {1, 0, 0}}, {0.25, 0.75}, {}});
  EXPECT_THAT(SkeletonToJson(graph), HasSubstr("\"radius\":0.5"));
  graph.SetCurve(0, {{0, 0, 0}, {1, 0, 0}}, {0.25, 0.25});
  EXPECT_THAT(SkeletonToJson(graph), testing::Not(HasSubstr("radii")));
}

TEST(GraphIo, AValueThatIsNotFiniteIsNotWritten) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {std::numeric_limits<double>::infinity(), 0, 0}});
  EXPECT_THROW(SkeletonToJson(graph), Error);
}

std::string File(const std::string& nodes, const std::string& edges) {
  return R"({"format":"curvefusion-skeleton","version":1,"units":"m","nodes":)" + nodes +
         R"(,"edges":)" + edges + "}";
}

TEST(GraphIo, MalformedInputIsRejectedWithPlaceAndReason) {
  const std::string nodes = R"([{"position":[0,0,0]},{"position":[1,0,0]}])";
  const auto edge = [](const std::string& rest) { return R"([{"nodes":[0,1])" + rest + "}]"; };
  const std::string points = R"(,"points":[[0,0,0],[1,0,0]])";
  EXPECT_NO_THROW(SkeletonFromJson(File(nodes, edge(points)), "good.json"));
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "not valid JSON"},
      {"[1]", "is not a JSON object"},
      {R"({"version":1})", "has no \"format\""},
      {R"({"format":"x","version":1,"units":"m"})", "format is \"x\""},
      {R"({"format":"curvefusion-skeleton","version":2,"units":"m"})", "version is 2"},
      {R"({"format":"curvefusion-skeleton","version":1,"units":"mm"})", "units is \"mm\""},
      {File("[{}]", "[]"), "nodes[0] has no \"position\""},
      {File("3", "[]"), "nodes is not an array"},
      {File(R"([{"position":[0,0]}])", "[]"), "nodes[0].position is not an array of three"},
      {File(R"([{"position":[0,0,null]}])", "[]"), "nodes[0].position is null"},
      {File(R"([{"position":[0,0,1e999]}])", "[]"), "not valid JSON"},
      {File(nodes, R"([{"points":[]}])"), "edges[0] has no \"nodes\""},
      {File(nodes, R"([{"nodes":[0,2],"points":[]}])"), "edges[0].nodes[1] is 2"},
      {File(nodes, R"([{"nodes":[-1,0],"points":[]}])"), "edges[0].nodes[0] is -1"},
      {File(nodes, R"([{"nodes":[0.5,0],"points":[]}])"), "edges[0].nodes[0] is 0.5"},
      {File(nodes, R"([{"nodes":[0],"points":[]}])"), "edges[0].nodes does not hold two"},
      {File(nodes, edge("")), "edges[0] has no \"points\""},
      {File(nodes, edge(R"(,"points":[[0,0,0]])")), "edges[0].points holds 1 points"},
      {File(nodes, edge(R"(,"points":[[0,0,0],[1,0,1e-17]])")), "node 1 as its last point"},
      {File(nodes, edge(R"(,"points":[[0,0,0],[0,0,0],[1,0,0]])")), "points[1] repeats"},
      {File(nodes, edge(R"(,"points":[[0,0,0],["a",0,0],[1,0,0]])")), "points[1] is \"a\""},
      {File(nodes, edge(points + R"(,"radius":0)")), "radii[0] is 0, not positive"},
      {File(nodes, edge(points + R"(,"radii":[1])")), "radii holds 1 values for 2 points"},
      {File(nodes, edge(points + R"(,"radii":[1,-1])")), "radii[1] is -1, not positive"},
      {File(nodes, edge(points + R"(,"observations":[1,-1])")), "observations[1] is -1"},
  };
  for (const auto& [text, reason] : cases) {
    EXPECT_THAT(MessageOf(ErrorKind::kBadInput, [&] { SkeletonFromJson(text, "bad.json"); }),
                AllOf(HasSubstr("bad.json"), HasSubstr(reason)))
        << text;
  }
}

TEST(GraphIo, CoordinatesBeyondTheBoundAreRefusedInEveryFormat) {
  SkeletonGraph near;
  near.AddPolyline({{0, 0, 0}, {0.99 * kMaxCoordinate, 0, 0}});
  SkeletonGraph far;
  far.AddPolyline({{0, 0, 0}, {1e9, 0, 0}});
  for (const char* extension : {".json", ".graphml", ".swc", ".ply", ".obj"}) {
    const std::string path = TemporaryPath("far").string() + extension;
    ExportSkeleton(path, near);
    EXPECT_NO_THROW(ReadSkeleton(path)) << extension;
    ExportSkeleton(path, far);
    EXPECT_THAT(
        MessageOf(ErrorKind::kBadInput, [&] { ReadSkeleton(path); }),
        AllOf(HasSubstr(path), HasSubstr("is away from the origin by more than 10,000 km")));
    std::filesystem::remove(path);
  }
}

TEST(GraphIo, RadiiBeyondTheBoundAreRefused) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({0, 0, 0});
  const NodeId b = graph.AddNode({1, 0, 0});
  graph.AddEdge({{a, b}, {{0, 0, 0}, {1, 0, 0}}, {0.002, 1e200}, {}});
  const std::string path = TemporaryPath("wide").string() + ".json";
  WriteSkeleton(path, graph);
  EXPECT_THROW(ReadSkeleton(path), Error);
  std::filesystem::remove(path);
}

TEST(GraphIo, EveryDefectiveEdgeIsNamed) {
  const std::string text = File(R"([{"position":[0,0,0]},{"position":[1,0,0]}])",
                                R"([{"nodes":[0,7],"points":[[0,0,0],[1,0,0]]},
                                    {"nodes":[0,1],"points":[[0,0,0],[1,0,0]]},
                                    {"nodes":[0,1],"points":[[0,0,0],[2,0,0]]}])");
  EXPECT_EQ(MessageOf([&] { SkeletonFromJson(text, "bad.json"); }),
            "bad.json: edges[0].nodes[1] is 7, but there are 2 nodes\n"
            "bad.json: edges[2].points does not have node 1 as its last point");
}

TEST(GraphIo, DeepNestingIsAnErrorAndNotTheEndOfTheStack) {
  // A million levels overflow the stack of a recursive parser, and printing such a value does so.
  EXPECT_THROW(SkeletonFromJson(std::string(1000000, '['), "deep.json"), Error);
}

class GraphIoFiles : public testing::Test {
 protected:
  const TemporaryFolder folder_{"graph_io"};
};

TEST_F(GraphIoFiles, AFileComesBackAndAMissingOneIsNamed) {
  const SkeletonGraph graph = RandomGraph(7);
  WriteSkeleton(folder_ / "skeleton.json", graph);
  ExpectSameGraph(graph, ReadSkeleton(folder_ / "skeleton.json"));
  std::filesystem::copy_file(folder_ / "skeleton.json", folder_ / "without_extension");
  ExpectSameGraph(graph, ReadSkeleton(folder_ / "without_extension"));
  EXPECT_THROW(ReadSkeleton(folder_ / "missing.json"), Error);
  EXPECT_THROW(ReadSkeleton(folder_), Error);
}

}  // namespace
}  // namespace curvefusion
