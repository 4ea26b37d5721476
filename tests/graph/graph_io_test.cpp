#include "graph/graph_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "kernel/error.h"
#include "tests/graph/graph_fixtures.h"
#include "tests/temporary_path.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

SkeletonGraph RandomGraph(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const auto point = [&]() -> Vec3 {
    return {coordinate(random), coordinate(random) * 1e-9, coordinate(random) * 1e5};
  };
  SkeletonGraph graph;
  for (int i = 0; i < 5; ++i) graph.AddNode(point());
  for (int i = 0; i < 8; ++i) {
    const NodeId a = static_cast<NodeId>(random() % 5);
    const NodeId b = static_cast<NodeId>(random() % 5);
    SkeletonEdge edge{{a, b}, {graph.position(a), point(), point(), graph.position(b)}, {}, {}};
    if (i % 2 == 0) edge.radii = {0.1, 0.2, 0.3 + i, 1.0 / 3};
    if (i % 4 == 1) edge.radii = {0.1, 0.1, 0.1, 0.1};
    if (i % 3 == 0) edge.observations = {1, 2, 0.1, 1e-300};
    graph.AddEdge(edge);
  }
  return graph;
}

void ExpectSameGraph(const SkeletonGraph& a, const SkeletonGraph& b) {
  ASSERT_EQ(a.node_count(), b.node_count());
  ASSERT_EQ(a.edge_count(), b.edge_count());
  for (int i = 0; i < a.node_count(); ++i)
    EXPECT_EQ(a.position(a.Nodes()[i]), b.position(b.Nodes()[i]));
  for (int i = 0; i < a.edge_count(); ++i) {
    const SkeletonEdge& edge_a = a.edge(a.Edges()[i]);
    const SkeletonEdge& edge_b = b.edge(b.Edges()[i]);
    EXPECT_EQ(edge_a.points, edge_b.points);
    EXPECT_EQ(edge_a.radii, edge_b.radii);
    EXPECT_EQ(edge_a.observations, edge_b.observations);
  }
}

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
      {File(nodes, edge(points + R"(,"radius":0)")), "radius 0, not positive"},
      {File(nodes, edge(points + R"(,"radii":[1])")), "radii holds 1 values for 2 points"},
      {File(nodes, edge(points + R"(,"radii":[1,-1])")), "radius -1, not positive"},
      {File(nodes, edge(points + R"(,"observations":[1,-1])")), "observations holds -1"},
  };
  for (const auto& [text, reason] : cases) {
    try {
      SkeletonFromJson(text, "bad.json");
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), HasSubstr("bad.json"));
      EXPECT_THAT(error.what(), HasSubstr(reason));
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    }
  }
}

class GraphIoFiles : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  const std::filesystem::path folder_ = TemporaryPath("graph_io");
};

TEST_F(GraphIoFiles, AFileComesBackAndAMissingOneIsNamed) {
  const SkeletonGraph graph = RandomGraph(7);
  WriteSkeleton(folder_ / "skeleton.json", graph);
  ExpectSameGraph(graph, ReadSkeleton(folder_ / "skeleton.json"));
  EXPECT_THROW(ReadSkeleton(folder_ / "missing.json"), Error);
  EXPECT_THROW(ReadSkeleton(folder_), Error);
}

TEST_F(GraphIoFiles, LinesHaveOneSegmentLessThanVerticesPerEdge) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  graph.AddPolyline({{0, 1, 0}, {1, 1, 0}});
  WriteSkeletonLines(folder_ / "lines.ply", graph, {{255, 0, 0}, {0, 255, 0}});
  std::ifstream stream(folder_ / "lines.ply");
  std::stringstream text;
  text << stream.rdbuf();
  EXPECT_THAT(text.str(), HasSubstr("element vertex 5\n"));
  EXPECT_THAT(text.str(), HasSubstr("element edge 3\n"));
  EXPECT_THAT(text.str(), testing::EndsWith("0 1 255 0 0\n1 2 255 0 0\n3 4 0 255 0\n"));
}

}  // namespace
}  // namespace curvefusion
