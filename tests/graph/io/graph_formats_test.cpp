#include "graph/io/graph_formats.h"

#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

#include "graph/io/cut_list.h"
#include "graph/io/graph_io.h"
#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/file_contents.h"
#include "tests/graph/graph_fixtures.h"
#include "tests/graph/random_graph.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class GraphFormats : public testing::Test {
 protected:
  SkeletonGraph RoundTrip(const SkeletonGraph& graph, const std::string& name) {
    losses_ = ExportSkeleton(folder_ / name, graph);
    return ReadSkeleton(folder_ / name);
  }

  SkeletonGraph Read(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return ReadSkeleton(folder_ / name);
  }

  std::string Text(const std::string& name) const { return FileText(folder_ / name); }

  // Expects an Error(kBadInput) that names the file and the reason, for each text.
  void ExpectRejected(const std::string& name,
                      const std::vector<std::pair<std::string, std::string>>& cases) const {
    for (const auto& [text, reason] : cases) {
      EXPECT_THAT(MessageOf(ErrorKind::kBadInput, [&] { Read(name, text); }),
                  AllOf(HasSubstr(name), HasSubstr(reason)))
          << text;
    }
  }

  const TemporaryFolder folder_{"graph_formats"};
  std::vector<std::string> losses_;
};

// A 2 x 2 lattice (one cycle), a ring and a free curve, none of which touch; five nodes of degree 2
// are those of the lattice and the ring.
SkeletonGraph LatticeRingAndCurve() {
  SkeletonGraph graph = Lattice(3, 3, 0.1, 0.03);
  graph.AddPolyline(Ring(0.05, 7, {1, 1, 1.0 / 3}));
  graph.AddPolyline({{2, 0, 0}, {2.1, 0.1, 0.2}, {2.3, 0, 1e-9}});
  return graph;
}

int CountCurveNodes(const SkeletonGraph& graph) {
  int count = 0;
  for (const NodeId node : graph.Nodes()) {
    const std::span<const EdgeId> edges = graph.IncidentEdges(node);
    count += edges.size() == 2 && edges[0] != edges[1] ? 1 : 0;
  }
  return count;
}

std::set<std::array<double, 3>> PointsOf(const SkeletonGraph& graph) {
  std::set<std::array<double, 3>> points;
  for (const EdgeId id : graph.Edges())
    for (const Vec3& p : graph.edge(id).points) points.insert({p.x(), p.y(), p.z()});
  return points;
}

// The same curves, with nodes only where they must be.
void ExpectSameCurves(SkeletonGraph expected, const SkeletonGraph& graph) {
  expected.DissolveDegree2Nodes();
  EXPECT_EQ(graph.node_count(), expected.node_count());
  EXPECT_EQ(graph.edge_count(), expected.edge_count());
  EXPECT_EQ(graph.CycleRank(), expected.CycleRank());
  EXPECT_EQ(graph.ComponentCount(), expected.ComponentCount());
  // The same segments, added up in another order.
  EXPECT_NEAR(graph.TotalLength(), expected.TotalLength(), 1e-12);
  EXPECT_EQ(PointsOf(graph), PointsOf(expected));
}

TEST_F(GraphFormats, GraphmlComesBackBitForBit) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const SkeletonGraph graph = RandomGraph(seed);
    ExpectSameGraph(graph, RoundTrip(graph, "graph.graphml"));
    EXPECT_THAT(losses_, IsEmpty());
  }
  ExpectSameGraph({}, RoundTrip({}, "empty.graphml"));
}

TEST_F(GraphFormats, GraphmlOfOtherProgramsIsRead) {
  const SkeletonGraph graph = Read("other.graphml", R"(<?xml version='1.0' encoding='utf-8'?>
<!-- a "comment" with <tags> --><graphml xmlns="http://graphml.graphdrawing.org/xmlns">
<key id="d0" for="node" attr.name="x" attr.type="int"/>
<key id="d1" for="node" attr.name="y" attr.type="float"/>
<key id="d2" for="node" attr.name="z" attr.type="string"/>
<key id="d3" for="node" attr.name="label" attr.type="string"/>
<key id="d4" for="edge" attr.name="radius" attr.type="double"><default>0.5</default></key>
<graph edgedefault="undirected">
<node id="a"><data key="d0">1</data><data key="d1">0.5</data><data key="d2">0.1</data>
<data key="d3">A &lt; B</data></node>
<node id="b"><data key="d0">2</data><data key="d1">0</data><data key="d2">-1</data></node>
<edge source="b" target="a"/></graph></graphml>)");
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_THAT(graph.edge(0).points, ElementsAre(Vec3(2, 0, -1), Vec3(1, 0.5, 0.1)));
  EXPECT_THAT(graph.edge(0).radii, ElementsAre(0.5, 0.5));
}

std::string Graphml(const std::string& body, const std::string& points_type = "string") {
  return R"(<graphml><key id="x" for="node" attr.name="x" attr.type="double"/>
<key id="y" for="node" attr.name="y" attr.type="double"/>
<key id="z" for="node" attr.name="z" attr.type="double"/>
<key id="p" for="edge" attr.name="points" attr.type=")" +
         points_type + R"("/><key id="r" for="edge" attr.name="radii" attr.type="string"/>
<graph edgedefault="undirected">)" +
         body + "</graph></graphml>";
}

std::string GraphmlNode(const std::string& id, const std::string& x) {
  return "<node id=\"" + id + "\"><data key=\"x\">" + x +
         "</data><data key=\"y\">0</data><data key=\"z\">0</data></node>";
}

TEST_F(GraphFormats, MalformedGraphmlIsRejected) {
  const std::string nodes = GraphmlNode("a", "0") + GraphmlNode("b", "1");
  const auto edge = [&nodes](const std::string& data, const std::string& target = "b") {
    return Graphml(nodes + "<edge source=\"a\" target=\"" + target + "\">" + data + "</edge>");
  };
  EXPECT_NO_THROW(Read("good.graphml", edge("<data key=\"p\">0 0 0 1 0 0</data>")));
  std::string deep;
  for (int i = 0; i < 200000; ++i) deep += "<a b='</a>'>";
  ExpectRejected("bad.graphml",
                 {{"", "not a GraphML graph"},
                  {"<graphml>", "not a GraphML graph"},
                  {deep, "nested deeper than 32"},
                  {"</a>", "closes more elements"},
                  {"<!DOCTYPE a [<!ENTITY b 'c'>]><graphml/>", "DOCTYPE"},
                  {Graphml(GraphmlNode("a", "nan")), "node 0 has no finite"},
                  {Graphml(GraphmlNode("a", "1e999")), "not a GraphML graph"},
                  {Graphml("<node id=\"a\"/>"), "node 0 has no finite"},
                  {edge("", "c"), "an edge names a node that is not there"},
                  {edge("<data key=\"p\">0 0 0 1 0</data>"), "edges[0].points holds 5 numbers"},
                  {edge("<data key=\"p\">0 0 0 1 0 x</data>"), "edges[0].points[5] is 'x'"},
                  {edge("<data key=\"p\">0 0 0 1 0 1</data>"), "node 1 as its last point"},
                  {edge("<data key=\"p\">0 0 0 0 0 0 1 0 0</data>"), "points[1] repeats"},
                  {edge("<data key=\"r\">1</data>"), "radii holds 1 values for 2 points"},
                  {edge("<data key=\"r\">1 -1</data>"), "radii[1] is -1"},
                  {edge("", "a"), "points[1] repeats"}});
  ExpectRejected("bad.graphml", {{Graphml(nodes + "<edge source=\"a\" target=\"b\"><data "
                                                  "key=\"p\">1</data></edge>",
                                          "double"),
                                  "not a GraphML graph"}});
}

TEST_F(GraphFormats, LinesKeepCurvesAndLoseNodesInsideThem) {
  const SkeletonGraph graph = LatticeRingAndCurve();
  ASSERT_EQ(CountCurveNodes(graph), 4);
  for (const char* name : {"lines.ply", "lines.obj"}) {
    ExpectSameCurves(graph, RoundTrip(graph, name));
    EXPECT_THAT(losses_, ElementsAre("4 nodes of two edges become points of curves")) << name;
  }
}

TEST_F(GraphFormats, OnlyPlyKeepsRadiiAndTellsWhereTheyDiffer) {
  SkeletonGraph graph = YShape(0.02, {0, 0, 0}, 0.01);
  for (const EdgeId id : graph.Edges()) {
    const Polyline points = graph.edge(id).points;
    graph.SetCurve(id, points, std::vector<double>(points.size(), 0.1), {1, 2, 3});
  }
  const SkeletonGraph same = RoundTrip(graph, "y.ply");
  EXPECT_THAT(same.edge(0).radii, ElementsAre(0.1, 0.1, 0.1));
  EXPECT_THAT(losses_, ElementsAre("observation counts are not kept"));
  EXPECT_THAT(RoundTrip(graph, "y.obj").edge(0).radii, IsEmpty());
  EXPECT_THAT(losses_, ElementsAre("observation counts are not kept", "radii are not kept"));

  graph.SetCurve(0, graph.edge(0).points, {0.4, 0.4, 0.4});
  EXPECT_THAT(RoundTrip(graph, "y.ply").edge(0).radii,
              ElementsAre(testing::DoubleEq(0.2), 0.4, 0.4));
  EXPECT_THAT(losses_, ElementsAre("observation counts are not kept",
                                   "1 nodes whose edges differ in radius get the mean"));
}

TEST_F(GraphFormats, LinesOfOtherProgramsAreRead) {
  const SkeletonGraph obj = Read("blender.obj",
                                 "o wires\r\nv 0 0 0\r\nv 1 0 0\r\nv 2 0 0\r\nv 2 1 0\r\n"
                                 "l 1 2\r\nl 2/1 -2/7\r\nl 3 4\r\nf 1 2 3\r\n");
  ASSERT_EQ(obj.edge_count(), 1);
  EXPECT_EQ(obj.edge(0).points.size(), 4u);
  const SkeletonGraph ply =
      Read("other.ply",
           "ply\nformat ascii 1.0\ncomment c\nelement vertex 3\nproperty uchar red\nproperty float "
           "x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int "
           "vertex_indices\nelement edge 2\nproperty int vertex1\nproperty int vertex2\n"
           "end_header\n255 0 0 0\n255 1 0 0\n255 2 0 0\n3 0 1 2\n0 1\n2 1\n");
  ASSERT_EQ(ply.edge_count(), 1);
  EXPECT_EQ(ply.edge(0).points, (Polyline{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
}

TEST_F(GraphFormats, MalformedLinesAreRejected) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 0 0\n";
  ExpectRejected("bad.obj", {{"v 0 0\n", "line 1: '' is not a finite number"},
                             {"v 0 0 nan\n", "line 1: 'nan'"},
                             {"v 0 0 1e999\n", "line 1: '1e999'"},
                             {v + "l 1\n", "line 4: a line needs two"},
                             {v + "l 1 4\n", "line 4: there is no vertex '4' among 3"},
                             {v + "l 0 1\n", "there is no vertex '0'"},
                             {v + "l -4 1\n", "there is no vertex '-4'"},
                             {v + "l 1 3\n", "from vertex 1 to vertex 3 has length zero"},
                             {v + "l 2 2\n", "from vertex 2 to vertex 2 has length zero"},
                             {v + "l 1 2\nl 2 1\n", "between vertices 1 and 2 is there twice"}});
  const std::string position = "property double x\nproperty double y\nproperty double z\n";
  const auto ply = [&position](const std::string& vertices, const std::string& edges) {
    return "ply\nformat ascii 1.0\nelement vertex " + vertices + position + "element edge " + edges;
  };
  const std::string ends = "property int vertex1\nproperty int vertex2\nend_header\n0 0 0\n1 0 0\n";
  EXPECT_NO_THROW(Read("good.ply", ply("2\n", "1\n" + ends + "0 1\n")));
  ExpectRejected(
      "bad.ply",
      {{"", "begins with 'ply'"},
       {"ply\nformat ascii 1.0\n", "does not end"},
       {"ply\nformat binary_little_endian 1.0\nend_header\n", "only ascii"},
       {"ply\nproperty int x\n", "before any element"},
       {"ply\nelement vertex -1\n", "needs a name and a count"},
       {"ply\nelement vertex 3000000000\n", "needs a name and a count"},
       {"ply\nelement vertex 1\nproperty list uchar int x\n", "a list in the element vertex"},
       {"ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nend_header\n1\n", "property y"},
       {ply("2\n", "1\n" + ends), "ends in edge 0 of 1"},
       {ply("2\n", "1\n" + ends + "0 2\n"), "line 13: vertex2 is 2, but there are 2 vertices"},
       {ply("2\n", "1\n" + ends + "0.5 1\n"), "vertex1 is 0.5"},
       {ply("2\n", "1\n" + ends + "-1 1\n"), "vertex1 is -1"},
       {ply("2\n", "1\n" + ends + "nan 1\n"), "vertex1 is 'nan'"},
       {ply("1\n", "0\nend_header\n0 inf 0\n"), "line 9: y is 'inf'"}});
}

// The columns of a sample.
struct Sample {
  int id = 0, type = 0, parent = 0;
  Vec3 position;
  double radius = 0;
};

std::vector<Sample> SamplesOf(const std::string& text) {
  std::vector<Sample> samples;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    Sample s;
    std::istringstream(line) >> s.id >> s.type >> s.position.x() >> s.position.y() >>
        s.position.z() >> s.radius >> s.parent;
    samples.push_back(s);
  }
  return samples;
}

TEST_F(GraphFormats, SwcIsInMicrometresAndParentsPrecede) {
  SkeletonGraph graph;
  graph.AddPolyline({{0.001, 0, 0}, {0.002, 0, 0}, {0.002, 0.004, 0}});
  graph.SetCurve(0, graph.edge(0).points, {0.0005, 0.0005, 0.00025});
  graph.AddNode({1, 1, 1});
  const SkeletonGraph same = RoundTrip(graph, "curve.swc");
  const std::vector<Sample> samples = SamplesOf(Text("curve.swc"));
  ASSERT_EQ(samples.size(), 4u);
  for (size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(samples[i].id, static_cast<int>(i) + 1);
    EXPECT_LT(samples[i].parent, samples[i].id);
  }
  // One rounding of a product.
  EXPECT_NEAR(samples[2].position.y(), 4000, 1e-9);
  EXPECT_NEAR(samples[0].radius, 500, 1e-9);
  EXPECT_EQ(samples[0].parent, -1);
  EXPECT_EQ(samples[3].parent, -1);
  EXPECT_EQ(same.node_count(), 3);
  ASSERT_EQ(same.edge_count(), 1);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_LT((same.edge(0).points[i] - graph.edge(0).points[i]).norm(), 1e-15);
    EXPECT_NEAR(same.edge(0).radii[i], graph.edge(0).radii[i], 1e-15);
  }
}

TEST_F(GraphFormats, SwcCutsEveryCycleAndSaysWhere) {
  SkeletonGraph graph = Lattice(3, 4, 0.1, 0.03);
  graph.AddPolyline(Ring(0.05, 7, {1, 1, 1}));
  ASSERT_EQ(graph.CycleRank(), 7);
  const SkeletonGraph forest = RoundTrip(graph, "forest.swc");
  EXPECT_EQ(forest.CycleRank(), 0);
  EXPECT_EQ(forest.ComponentCount(), 2);
  // Every curve is there, to the rounding of micrometres.
  EXPECT_NEAR(forest.TotalLength(), graph.TotalLength(), 1e-12);
  EXPECT_LT(MaxDistance(forest, graph), 1e-15);
  ASSERT_EQ(losses_.size(), 8u);  // seven cuts, and nodes of two edges
  for (int i = 0; i < 7; ++i) EXPECT_THAT(losses_[i], HasSubstr("would close a cycle"));
  EXPECT_EQ(losses_[6],
            "edge 17 would close a cycle; it is cut at node 12, at (1050.000, 1000.000, 1000.000) "
            "mm, and ends there in sample " +
                std::to_string(SamplesOf(Text("forest.swc")).size()));
}

TEST_F(GraphFormats, MalformedSwcIsRejected) {
  const std::string root = "# comment\n\n1 1 0 0 0 5 -1\n";
  EXPECT_EQ(Read("good.swc", root + "7 3 1 0 0 5 1\n").edge_count(), 1);
  ExpectRejected("bad.swc", {{"x 1 0 0 0 1 -1\n", "line 1: the sample is 'x'"},
                             {"1.5 1 0 0 0 1 -1\n", "line 1: the sample is '1.5'"},
                             {"1 1 0 0 nan 1 -1\n", "line 1: a coordinate is 'nan'"},
                             {"1 1 0 0 0 1\n", "line 1: the parent is ''"},
                             {"1 1 0 0 0 -1 -1\n", "sample 1 has a negative radius"},
                             {"1 1 0 0 0 1 2\n", "sample 1 has the parent 2"},
                             {"1 1 0 0 0 1 1\n", "sample 1 has the parent 1"},
                             {root + "1 1 1 0 0 5 -1\n", "line 4: sample 1 is there twice"},
                             {root + "2 1 0 0 0 5 1\n", "lies where its parent 1 lies"}});
}

// What dxflib itself reads.
class DxfContent : public DL_CreationAdapter {
 public:
  void addPolyline(const DL_PolylineData& data) override { flags.push_back(data.flags); }
  void addVertex(const DL_VertexData& v) override { points.emplace_back(v.x, v.y, v.z); }

  std::vector<int> flags;
  Polyline points;
};

TEST_F(GraphFormats, DxfHasThreeDimensionalPolylinesInMillimetres) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {0.5, 0.25, 0.125}});
  graph.AddPolyline({{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 1, 0}});
  graph.AddNode({5, 5, 5});
  EXPECT_THAT(ExportSkeleton(folder_ / "wires.DXF", graph),
              ElementsAre("curves meet by coordinates only, not by nodes",
                          "1 nodes without edges are left out"));
  DxfContent content;
  ASSERT_TRUE(DL_Dxf().in((folder_ / "wires.DXF").string(), &content));
  EXPECT_THAT(content.flags, ElementsAre(8, 9));  // 3D; and closed
  EXPECT_THAT(content.points, ElementsAre(Vec3(0, 0, 0), Vec3(500, 250, 125), Vec3(1000, 1000, 0),
                                          Vec3(2000, 1000, 0), Vec3(2000, 2000, 0)));
}

// A quarter of a circle of 100 mm with one width, and a straight edge without radii known.
SkeletonGraph ArcAndLine() {
  SkeletonEdge arc;
  for (int i = 0; i <= 90; ++i) {
    arc.points.emplace_back(0.1 * std::sin(M_PI * i / 180), 0.1 * std::cos(M_PI * i / 180), 0);
    arc.radii.push_back(0.002);
  }
  SkeletonGraph graph;
  arc.nodes = {graph.AddNode(arc.points.front()), graph.AddNode(arc.points.back())};
  graph.AddEdge(arc);
  graph.AddPolyline({arc.points.back(), {0.1, 0, 0.3}});
  return graph;
}

class DxfSplines : public DL_CreationAdapter {
 public:
  void addSpline(const DL_SplineData& data) override {
    degrees.push_back(static_cast<int>(data.degree));
    control_counts.push_back(static_cast<int>(data.nControl));
  }
  void addControlPoint(const DL_ControlPointData& p) override {
    points.emplace_back(p.x, p.y, p.z);
  }
  void addKnot(const DL_KnotData& data) override { knots.push_back(data.k); }

  std::vector<int> degrees;
  std::vector<int> control_counts;
  Polyline points;
  std::vector<double> knots;
};

TEST_F(GraphFormats, DxfSplinesAreReadBack) {
  const SplineFigures figures =
      ExportSplines(folder_ / "wires.dxf", ArcAndLine(), 0.5 * kMillimetre);
  EXPECT_EQ(figures.polyline_points, 93u);
  EXPECT_EQ(figures.control_points, 8u);
  EXPECT_LE(figures.deviation, 0.5 * kMillimetre);
  DxfSplines content;
  ASSERT_TRUE(DL_Dxf().in((folder_ / "wires.dxf").string(), &content));
  EXPECT_THAT(content.degrees, ElementsAre(3, 3));
  EXPECT_THAT(content.control_counts, ElementsAre(4, 4));
  ASSERT_EQ(content.points.size(), 8u);
  ASSERT_EQ(content.knots.size(), 16u);
  EXPECT_LT((content.points[0] - Vec3(0, 100, 0)).norm(), 1e-9);
  EXPECT_LT((content.points[7] - Vec3(100, 0, 300)).norm(), 1e-9);
}

// dxflib leaves a handle to chance where it does not know the style: unlike bytes in every run.
TEST_F(GraphFormats, DimensionsOfDxfSplinesNameTheirTextStyle) {
  ExportSplines(folder_ / "wires.dxf", ArcAndLine(), 0.5 * kMillimetre);
  std::ifstream stream(folder_ / "wires.dxf");
  std::string code, value, entity, style, named;
  while (std::getline(stream, code) && std::getline(stream, value)) {
    if (std::stoi(code) == 0) entity = value;
    if (entity == "STYLE" && std::stoi(code) == 5) style = value;
    if (entity == "DIMSTYLE" && std::stoi(code) == 340) named = value;
  }
  EXPECT_FALSE(style.empty());
  EXPECT_EQ(named, style);
}

// Runs a command of another program; skips where the program is missing (exit code 77).
#define EXPECT_FOREIGN(command)                                    \
  {                                                                \
    const int status = std::system((command).c_str());             \
    if (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127) { \
      GTEST_SKIP() << "not installed here: " << (command);         \
    }                                                              \
    EXPECT_EQ(status, 0) << (command);                             \
  }

// ezdxf checks the structure and evaluates the splines itself.
TEST_F(GraphFormats, EzdxfFindsTheCurveInDxfSplines) {
  ExportSplines(folder_ / "wires.dxf", ArcAndLine(), 0.5 * kMillimetre);
  std::ofstream(folder_ / "check.py") << R"(
import sys
try:
    import ezdxf
except ImportError:
    sys.exit(77)
document = ezdxf.readfile(sys.argv[1])
assert not document.audit().has_errors, document.audit().errors
assert document.units == 4, document.units
splines = list(document.modelspace().query("SPLINE"))
assert len(splines) == 2, splines
curve = splines[0].construction_tool()
for i in range(101):
    x, y, z = curve.point(curve.max_t * i / 100)
    assert abs((x * x + y * y) ** .5 - 100) < .5 and z == 0, (x, y, z)
x, y, z = curve.point(0)
assert abs(x) < 1e-9 and abs(y - 100) < 1e-9
)";
  EXPECT_FOREIGN("/usr/bin/python3 '" + (folder_ / "check.py").string() + "' '" +
                 (folder_ / "wires.dxf").string() + "'");
}

TEST_F(GraphFormats, SvgHasThreeViewsInMillimetres) {
  const FormatLosses losses = ExportSkeleton(folder_ / "wires.svg", ArcAndLine());
  EXPECT_THAT(losses, testing::Contains(HasSubstr("three views")));
  const std::string text = Text("wires.svg");
  for (const char* view : {"\"front\"", "\"side\"", "\"top\""}) EXPECT_THAT(text, HasSubstr(view));
  // x from 0 to 100 and z from 0 to 300, with half the widths around: 4 mm of the arc, 1 unknown.
  EXPECT_THAT(text, HasSubstr(">104.0 mm<"));
  EXPECT_THAT(text, HasSubstr(">302.5 mm<"));
  EXPECT_THAT(text, HasSubstr("stroke-width=\"4.000\""));
  EXPECT_FOREIGN("xmllint --noout '" + (folder_ / "wires.svg").string() + "'");
}

// The numbers of a list "name = [...]", without their brackets.
std::vector<double> Numbers(const std::string& text, const std::string& name) {
  const size_t begin = text.find('[', text.find(" " + name + " = "));
  std::string list = text.substr(begin + 1, text.find(']', begin) - begin - 1);
  std::replace_if(
      list.begin(), list.end(),
      [](char c) { return std::string("(),").find(c) != std::string::npos; }, ' ');
  std::istringstream stream(list);
  return {std::istream_iterator<double>(stream), {}};
}

TEST_F(GraphFormats, UsdaHasLinearAndBezierCurvesWithWidths) {
  const SkeletonGraph graph = ArcAndLine();
  ExportSkeleton(folder_ / "wires.usda", graph);
  const std::string linear = Text("wires.usda");
  EXPECT_EQ(linear.substr(0, 10), "#usda 1.0\n");
  EXPECT_THAT(linear, HasSubstr("metersPerUnit = 1\n"));
  EXPECT_THAT(linear, HasSubstr("token type = \"linear\""));
  EXPECT_THAT(Numbers(linear, "curveVertexCounts"), ElementsAre(91, 2));
  EXPECT_EQ(Numbers(linear, "points").size(), 93u * 3);
  EXPECT_EQ(Numbers(linear, "widths").size(), 93u);
  EXPECT_EQ(Numbers(linear, "widths")[0], 0.004);
  ExportSplines(folder_ / "wires.usda", graph, 0.5 * kMillimetre);
  const std::string cubic = Text("wires.usda");
  EXPECT_THAT(cubic, HasSubstr("token type = \"cubic\""));
  EXPECT_THAT(cubic, HasSubstr("token basis = \"bezier\""));
  EXPECT_THAT(Numbers(cubic, "curveVertexCounts"), ElementsAre(4, 4));
  EXPECT_EQ(Numbers(cubic, "points").size(), 8u * 3);
  EXPECT_NEAR(Numbers(cubic, "points")[1], 0.1, 1e-8);
}

TEST_F(GraphFormats, StepSplinesHaveTheirMultiplicities) {
  ExportSplines(folder_ / "wires.step", ArcAndLine(), 0.5 * kMillimetre);
  const std::string text = Text("wires.step");
  EXPECT_EQ(text.substr(0, 14), "ISO-10303-21;\n");
  EXPECT_THAT(text, HasSubstr("SI_UNIT(.MILLI.,.METRE.)"));
  EXPECT_THAT(text, HasSubstr("B_SPLINE_CURVE_WITH_KNOTS('edge 0',3,(#14,#15,#16,#17)"));
  EXPECT_THAT(text, HasSubstr(",(4,4),(0.00000000000000,"));
  EXPECT_THAT(text, HasSubstr("CARTESIAN_POINT('',(0.00000000000000,100.000000000000,0.0000"));
  for (const char* name : {"wires.stp", "wires.svg", "wires.json"}) {
    EXPECT_THROW(ExportSplines(folder_ / name, ArcAndLine(), 1e-3), Error) << name;
  }
  EXPECT_THROW(ExportSkeleton(folder_ / "a.step", ArcAndLine()), Error);
}

TEST_F(GraphFormats, TheCutListHasARowForEachBendAndOneForTheEnd) {
  SkeletonGraph graph;
  SkeletonEdge edge;
  edge.points = {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.05, 0}, {0.1, 0.05, 0.02}};
  edge.radii.assign(4, 0.0015);
  edge.nodes = {graph.AddNode(edge.points.front()), graph.AddNode(edge.points.back())};
  graph.AddEdge(edge);
  graph.AddPolyline({{1, 0, 0}, {1, 0.25, 0}});
  WriteCutList(folder_ / "wires.csv", graph, kMillimetre);
  EXPECT_EQ(Text("wires.csv"),
            "edge,from,to,length_mm,diameter_mm,bends,step,straight_mm,rotation_deg,bend_deg,"
            "radius_mm,arc_mm\n"
            "0,0,1,170.00,3.00,2,1,100.00,,90.0,,0.00\n"
            "0,0,1,170.00,3.00,2,2,50.00,90.0,90.0,,0.00\n"
            "0,0,1,170.00,3.00,2,3,20.00,,,,\n"
            "1,2,3,250.00,,0,1,250.00,,,,\n");
}

TEST_F(GraphFormats, SwcSaysWhereALoopCloses) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}});
  ExportSkeleton(folder_ / "loop.swc", graph);
  EXPECT_THAT(Text("loop.swc"),
              HasSubstr("# sample 4 closes a loop: it is the same place as sample 1\n"));
}

TEST_F(GraphFormats, WhatCannotBeWrittenLeavesNoFile) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {std::numeric_limits<double>::infinity(), 0, 0}});
  for (const char* name :
       {"a.json", "a.graphml", "a.swc", "a.ply", "a.obj", "a.dxf", "a.svg", "a.usda"}) {
    EXPECT_THROW(ExportSkeleton(folder_ / name, graph), Error) << name;
    EXPECT_THROW(ExportSkeleton(folder_ / "none" / name, {}), Error) << name;
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  for (const char* name : {"a.stl", "a.dxf"}) {
    MessageOf(ErrorKind::kUsage, [&] { ReadSkeleton(folder_ / name); });
  }
  EXPECT_THROW(ExportSkeleton(folder_ / "a.stl", {}), Error);
}

}  // namespace
}  // namespace curvefusion
