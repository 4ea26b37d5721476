#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "graph/io/graph_formats.h"
#include "graph/io/graph_io.h"
#include "graph/validate.h"
#include "kernel/error.h"
#include "kernel/json_input.h"

namespace curvefusion {

namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "curvefusion-skeleton";
constexpr int kVersion = 1;          // chosen: that of docs/formats_output.md
constexpr size_t kMaxListed = 1000;  // defects that one message names; chosen

double Finite(double value) {
  if (!std::isfinite(value))
    throw Error(ErrorKind::kBadInput, "skeleton: a value is not finite and cannot be written");
  return value;
}

Json ToJson(const Vec3& p) { return {Finite(p.x()), Finite(p.y()), Finite(p.z())}; }

Json ToJson(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(Finite(value));
  return array;
}

bool AllEqual(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [&values](double value) { return value == values.front(); });
}

void AddRadii(const std::vector<double>& radii, Json& json) {
  if (radii.empty()) return;
  if (AllEqual(radii)) {
    json["radius"] = Finite(radii.front());
    return;
  }
  const double sum = std::accumulate(radii.begin(), radii.end(), 0.0);
  json["radius"] = Finite(sum / static_cast<double>(radii.size()));
  json["radii"] = ToJson(radii);
}

Json ToJson(const SkeletonEdge& edge, const std::map<NodeId, int>& index_of_node) {
  Json json;
  json["nodes"] = {index_of_node.at(edge.nodes[0]), index_of_node.at(edge.nodes[1])};
  json["points"] = Json::array();
  for (const Vec3& p : edge.points) json["points"].push_back(ToJson(p));
  AddRadii(edge.radii, json);
  if (!edge.observations.empty()) json["observations"] = ToJson(edge.observations);
  return json;
}

// The elements of a JSON array, one a line.
std::string Lines(const std::vector<Json>& elements) {
  std::string text = "[";
  for (size_t i = 0; i < elements.size(); ++i) {
    text += i == 0 ? "\n  " : ",\n  ";
    text += elements[i].dump();
  }
  return text + "]";
}

// Reads values out of a parsed file; errors say where in the file.
class SkeletonReader {
 public:
  explicit SkeletonReader(const std::string& source) : source_(source) {}

  SkeletonGraph Read(const Json& root) const {
    if (!root.is_object()) Fail("the file", "is not a JSON object");
    CheckHeader(root);
    SkeletonGraph graph;
    const Json& nodes = Array(root, "nodes", "");
    ForEach(nodes.size(), [&](size_t i) {
      const std::string place = fmt::format("nodes[{}]", i);
      graph.AddNode(Point(Member(nodes[i], "position", place), place + ".position"));
    });
    const Json& edges = Array(root, "edges", "");
    ForEach(edges.size(),
            [&](size_t i) { graph.AddEdge(Edge(edges[i], fmt::format("edges[{}]", i), graph)); });
    return graph;
  }

 private:
  [[noreturn]] void Fail(const std::string& defect) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", source_, defect));
  }

  [[noreturn]] void Fail(const std::string& place, const std::string& reason) const {
    Fail(fmt::format("{} {}", place, reason));
  }

  // Calls read(0) to read(count - 1); throws one error with the messages of all that failed.
  template <class Read>
  void ForEach(size_t count, const Read& read) const {
    std::vector<std::string> defects;
    for (size_t i = 0; i < count && defects.size() < kMaxListed; ++i) {
      try {
        read(i);
      } catch (const Error& error) {
        defects.emplace_back(error.what());
      }
    }
    if (defects.size() == kMaxListed) defects.push_back(source_ + ": and perhaps more");
    if (!defects.empty())
      throw Error(ErrorKind::kBadInput, fmt::format("{}", fmt::join(defects, "\n")));
  }

  void CheckHeader(const Json& root) const {
    const Json& format = Member(root, "format", "");
    if (format != kFormat)
      Fail("format", fmt::format("is {}, expected \"{}\"", format.dump(), kFormat));
    const Json& version = Member(root, "version", "");
    if (version != kVersion)
      Fail("version", fmt::format("is {}, this program reads {}", version.dump(), kVersion));
    const Json& units = Member(root, "units", "");
    if (units != "m") Fail("units", fmt::format("is {}, expected \"m\"", units.dump()));
  }

  const Json& Member(const Json& object, const char* key, const std::string& place) const {
    const std::string where = place.empty() ? "the file" : place;
    if (!object.is_object()) Fail(where, "is not an object");
    const auto found = object.find(key);
    if (found == object.end()) Fail(where, fmt::format("has no \"{}\"", key));
    return *found;
  }

  const Json& Array(const Json& object, const char* key, const std::string& place) const {
    const Json& array = Member(object, key, place);
    if (!array.is_array()) Fail(place.empty() ? key : place + "." + key, "is not an array");
    return array;
  }

  double Number(const Json& json, const std::string& place) const {
    if (!json.is_number()) Fail(place, fmt::format("is {}, not a finite number", json.dump()));
    const double value = json.get<double>();
    if (!std::isfinite(value)) Fail(place, "is not finite");
    return value;
  }

  Vec3 Point(const Json& json, const std::string& place) const {
    if (!json.is_array() || json.size() != 3) Fail(place, "is not an array of three numbers");
    return {Number(json[0], place), Number(json[1], place), Number(json[2], place)};
  }

  NodeId Node(const Json& json, const std::string& place, const SkeletonGraph& graph) const {
    if (!json.is_number_integer()) Fail(place, fmt::format("is {}, not an index", json.dump()));
    const auto index = json.get<int64_t>();
    if (index < 0 || index >= graph.node_count())
      Fail(place, fmt::format("is {}, but there are {} nodes", index, graph.node_count()));
    return static_cast<NodeId>(index);
  }

  SkeletonEdge Edge(const Json& json, const std::string& place, const SkeletonGraph& graph) const {
    const Json& nodes = Array(json, "nodes", place);
    if (nodes.size() != 2) Fail(place + ".nodes", "does not hold two indices");
    SkeletonEdge edge;
    for (int end = 0; end < 2; ++end)
      edge.nodes[end] = Node(nodes[end], fmt::format("{}.nodes[{}]", place, end), graph);
    const Json& points = Array(json, "points", place);
    for (size_t i = 0; i < points.size(); ++i)
      edge.points.push_back(Point(points[i], fmt::format("{}.points[{}]", place, i)));
    edge.radii = Radii(json, edge.points.size(), place);
    if (json.contains("observations")) edge.observations = Values(json, "observations", place);
    const std::vector<std::string> faults = EdgeFaults(edge, graph);
    if (!faults.empty()) Fail(place + "." + faults[0]);
    return edge;
  }

  std::vector<double> Values(const Json& json, const char* key, const std::string& place) const {
    std::vector<double> values;
    for (const Json& value : Array(json, key, place))
      values.push_back(Number(value, place + "." + key));
    return values;
  }

  std::vector<double> Radii(const Json& json, size_t count, const std::string& place) const {
    if (json.contains("radii")) return Values(json, "radii", place);
    if (!json.contains("radius")) return {};
    return std::vector<double>(count, Number(json["radius"], place + ".radius"));
  }

  std::string source_;
};

}  // namespace

std::string SkeletonToJson(const SkeletonGraph& graph) {
  std::vector<Json> nodes;
  std::vector<Json> edges;
  std::map<NodeId, int> index_of_node;
  for (const NodeId node : graph.Nodes()) {
    index_of_node[node] = static_cast<int>(nodes.size());
    nodes.push_back({{"position", ToJson(graph.position(node))}});
  }
  for (const EdgeId edge : graph.Edges()) edges.push_back(ToJson(graph.edge(edge), index_of_node));
  return fmt::format(
      "{{\"format\":\"{}\",\"version\":{},\"units\":\"m\",\n \"nodes\":{},\n \"edges\":{}}}\n",
      kFormat, kVersion, Lines(nodes), Lines(edges));
}

SkeletonGraph SkeletonFromJson(const std::string& text, const std::string& source) {
  return SkeletonReader(source).Read(ParseJson(text, source));
}

}  // namespace curvefusion
