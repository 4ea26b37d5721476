#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/graphml.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "graph/io/graph_formats.h"
#include "graph/io/graphml_nesting.h"
#include "graph/validate.h"
#include "kernel/atomic_file.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

struct GraphmlNode {
  Vec3 position = Vec3::Constant(kMissing);
};

// Lists are numbers separated by blanks; points take three each.
struct GraphmlEdge {
  std::string points;
  std::string radii;
  std::string observations;
  double radius = kMissing;
  double length = kMissing;  // for programs that want weights; not read
};

using GraphmlGraph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, GraphmlNode, GraphmlEdge>;
using Vertex = boost::graph_traits<GraphmlGraph>::vertex_descriptor;
using Edge = boost::graph_traits<GraphmlGraph>::edge_descriptor;

[[noreturn]] void Fail(const std::string& source, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", source, what));
}

double NumberOf(const boost::any& value) {
  if (const auto* number = boost::any_cast<double>(&value)) return *number;
  if (const auto* number = boost::any_cast<float>(&value)) return *number;
  if (const auto* number = boost::any_cast<int>(&value)) return *number;
  if (const auto* number = boost::any_cast<long>(&value)) return static_cast<double>(*number);
  const auto* text = boost::any_cast<std::string>(&value);
  return text == nullptr ? kMissing : ParseNumber(*text).value_or(kMissing);
}

// A property that is declared as a double; Boost's own maps would write six digits, and read only
// what is declared as they are.
template <class Key>
class ExactNumberMap : public boost::dynamic_property_map {
 public:
  using Access = std::function<double&(const Key&)>;
  explicit ExactNumberMap(Access access) : access_(std::move(access)) {}

  boost::any get(const boost::any& key) override { return At(key); }
  std::string get_string(const boost::any& key) override { return fmt::format("{}", At(key)); }
  void put(const boost::any& key, const boost::any& value) override { At(key) = NumberOf(value); }
  const std::type_info& key() const override { return typeid(Key); }
  const std::type_info& value() const override { return typeid(double); }

 private:
  double& At(const boost::any& key) const { return access_(boost::any_cast<Key>(key)); }

  Access access_;
};

template <class Key>
void AddNumber(const char* name, const typename ExactNumberMap<Key>::Access& access,
               boost::dynamic_properties& properties) {
  properties.insert(name, boost::make_shared<ExactNumberMap<Key>>(access));
}

// What is written and read of nodes and edges; other properties of a file are ignored.
boost::dynamic_properties PropertiesOf(GraphmlGraph& graph) {
  boost::dynamic_properties properties(&boost::ignore_other_properties);
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    AddNumber<Vertex>(
        kAxes[axis], [&graph, axis](Vertex v) -> double& { return graph[v].position[axis]; },
        properties);
  properties.property("points", boost::get(&GraphmlEdge::points, graph));
  properties.property("radii", boost::get(&GraphmlEdge::radii, graph));
  properties.property("observations", boost::get(&GraphmlEdge::observations, graph));
  AddNumber<Edge>(
      "radius", [&graph](Edge e) -> double& { return graph[e].radius; }, properties);
  AddNumber<Edge>(
      "length", [&graph](Edge e) -> double& { return graph[e].length; }, properties);
  return properties;
}

GraphmlEdge GraphmlEdgeOf(const SkeletonEdge& edge) {
  GraphmlEdge written;
  written.length = Length(edge.points);
  for (const Vec3& p : edge.points)
    written.points +=
        fmt::format("{}{} {} {}", written.points.empty() ? "" : " ", p.x(), p.y(), p.z());
  written.radii = fmt::format("{}", fmt::join(edge.radii, " "));
  written.observations = fmt::format("{}", fmt::join(edge.observations, " "));
  if (edge.radii.empty()) return written;
  written.radius = 0;
  for (const double radius : edge.radii)
    written.radius += radius / static_cast<double>(edge.radii.size());
  return written;
}

std::vector<double> NumbersOf(std::string_view text, const std::string& place,
                              const std::string& source) {
  std::vector<double> numbers;
  for (std::string_view word = NextWord(text); !word.empty(); word = NextWord(text)) {
    const std::optional<double> number = ParseNumber(word);
    if (!number || !std::isfinite(*number))
      Fail(source, fmt::format("{}[{}] is '{}', not a finite number", place, numbers.size(), word));
    numbers.push_back(*number);
  }
  return numbers;
}

SkeletonEdge SkeletonEdgeOf(const GraphmlEdge& read, const std::array<NodeId, 2>& nodes,
                            const SkeletonGraph& graph, const std::string& place,
                            const std::string& source) {
  SkeletonEdge edge{nodes, {}, {}, {}};
  const std::vector<double> numbers = NumbersOf(read.points, place + ".points", source);
  if (numbers.size() % 3 != 0)
    Fail(source,
         fmt::format("{}.points holds {} numbers, not three a point", place, numbers.size()));
  for (size_t i = 0; i < numbers.size(); i += 3)
    edge.points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
  if (edge.points.empty()) edge.points = {graph.position(nodes[0]), graph.position(nodes[1])};
  edge.radii = NumbersOf(read.radii, place + ".radii", source);
  edge.observations = NumbersOf(read.observations, place + ".observations", source);
  if (edge.radii.empty() && !std::isnan(read.radius))
    edge.radii.assign(edge.points.size(), read.radius);
  const std::vector<std::string> faults = EdgeFaults(edge, graph);
  if (!faults.empty()) Fail(source, fmt::format("{}.{}", place, faults[0]));
  return edge;
}

SkeletonGraph SkeletonOf(const GraphmlGraph& read, const std::string& source) {
  SkeletonGraph graph;
  for (const Vertex v : boost::make_iterator_range(boost::vertices(read))) {
    // Boost makes nodes up that only edges name; those have no position either.
    if (!read[v].position.allFinite())
      Fail(source, fmt::format("node {} has no finite x, y and z; or an edge names a node that is "
                               "not there",
                               v));
    graph.AddNode(read[v].position);
  }
  int index = 0;
  for (const Edge e : boost::make_iterator_range(boost::edges(read))) {
    const std::array<NodeId, 2> nodes = {static_cast<NodeId>(boost::source(e, read)),
                                         static_cast<NodeId>(boost::target(e, read))};
    graph.AddEdge(SkeletonEdgeOf(read[e], nodes, graph, fmt::format("edges[{}]", index++), source));
  }
  return graph;
}

}  // namespace

FormatLosses WriteGraphml(const std::filesystem::path& path, const SkeletonGraph& graph) {
  GraphmlGraph written;
  std::map<NodeId, Vertex> vertex_of;
  for (const NodeId node : graph.Nodes())
    vertex_of[node] = boost::add_vertex({graph.position(node)}, written);
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    boost::add_edge(vertex_of.at(edge.nodes[0]), vertex_of.at(edge.nodes[1]), GraphmlEdgeOf(edge),
                    written);
  }
  WriteStreamAtomically(path, [&written](std::ostream& stream) {
    boost::write_graphml(stream, written, PropertiesOf(written), true);
  });
  return {};
}

SkeletonGraph ReadGraphml(const std::string& text, const std::string& source) {
  RequireShallowXml(text, source);
  GraphmlGraph read;
  boost::dynamic_properties properties = PropertiesOf(read);
  std::istringstream stream(text);
  try {
    boost::read_graphml(stream, read, properties);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    Fail(source, fmt::format("not a GraphML graph: {}", error.what()));
  }
  return SkeletonOf(read, source);
}

}  // namespace curvefusion
