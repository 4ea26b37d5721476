#include "graph/graph_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "kernel/atomic_file.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "curvefusion-skeleton";
constexpr int kVersion = 1;

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
    for (size_t i = 0; i < nodes.size(); ++i) {
      const std::string place = fmt::format("nodes[{}]", i);
      graph.AddNode(Point(Member(nodes[i], "position", place), place + ".position"));
    }
    const Json& edges = Array(root, "edges", "");
    for (size_t i = 0; i < edges.size(); ++i)
      graph.AddEdge(Edge(edges[i], fmt::format("edges[{}]", i), graph));
    return graph;
  }

 private:
  [[noreturn]] void Fail(const std::string& place, const std::string& reason) const {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {} {}", source_, place, reason));
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
    edge.points = Points(Array(json, "points", place), place + ".points");
    CheckEnds(edge, place, graph);
    edge.radii = Radii(json, edge.points.size(), place);
    if (json.contains("observations")) {
      edge.observations = Values(json, "observations", edge.points.size(), place);
      for (const double count : edge.observations)
        if (count < 0) Fail(place + ".observations", fmt::format("holds {} < 0", count));
    }
    return edge;
  }

  Polyline Points(const Json& json, const std::string& place) const {
    if (json.size() < 2)
      Fail(place, fmt::format("holds {} points, at least 2 needed", json.size()));
    Polyline points;
    points.reserve(json.size());
    for (size_t i = 0; i < json.size(); ++i) {
      const std::string point_place = fmt::format("{}[{}]", place, i);
      points.push_back(Point(json[i], point_place));
      if (i > 0 && points[i] == points[i - 1]) Fail(point_place, "repeats the point before it");
    }
    return points;
  }

  void CheckEnds(const SkeletonEdge& edge, const std::string& place,
                 const SkeletonGraph& graph) const {
    const std::pair<const char*, Vec3> ends[2] = {{"first", edge.points.front()},
                                                  {"last", edge.points.back()}};
    for (int end = 0; end < 2; ++end) {
      if (ends[end].second == graph.position(edge.nodes[end])) continue;
      Fail(place + ".points",
           fmt::format("does not have node {} as its {} point", edge.nodes[end], ends[end].first));
    }
  }

  std::vector<double> Values(const Json& json, const char* key, size_t count,
                             const std::string& place) const {
    const Json& array = Array(json, key, place);
    const std::string array_place = place + "." + key;
    if (array.size() != count)
      Fail(array_place, fmt::format("holds {} values for {} points", array.size(), count));
    std::vector<double> values;
    values.reserve(count);
    for (const Json& value : array) values.push_back(Number(value, array_place));
    return values;
  }

  std::vector<double> Radii(const Json& json, size_t count, const std::string& place) const {
    std::vector<double> radii;
    if (json.contains("radii")) {
      radii = Values(json, "radii", count, place);
    } else if (json.contains("radius")) {
      radii.assign(count, Number(json["radius"], place + ".radius"));
    }
    for (const double radius : radii)
      if (!(radius > 0)) Fail(place, fmt::format("has radius {}, not positive", radius));
    return radii;
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
  Json root;
  try {
    root = Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: not valid JSON: {}", source, error.what()));
  }
  return SkeletonReader(source).Read(root);
}

void WriteSkeleton(const std::filesystem::path& path, const SkeletonGraph& graph) {
  const std::string text = SkeletonToJson(graph);
  WriteStreamAtomically(path, [&text](std::ostream& stream) { stream << text; });
}

SkeletonGraph ReadSkeleton(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path))
    throw Error(ErrorKind::kBadInput, path.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  return SkeletonFromJson(text, path.string());
}

void WriteSkeletonLines(const std::filesystem::path& path, const SkeletonGraph& graph,
                        const std::vector<Rgb>& edge_colors) {
  const std::vector<EdgeId> edges = graph.Edges();
  assert(edge_colors.empty() || edge_colors.size() == edges.size());
  size_t vertex_count = 0;
  for (const EdgeId edge : edges) vertex_count += graph.edge(edge).points.size();
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement edge {}\nproperty int vertex1\nproperty int vertex2\n{}"
      "end_header\n",
      vertex_count, vertex_count - edges.size(),
      edge_colors.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n");
  for (const EdgeId edge : edges)
    for (const Vec3& p : graph.edge(edge).points)
      text += fmt::format("{} {} {}\n", p.x(), p.y(), p.z());
  size_t first_vertex = 0;
  for (size_t i = 0; i < edges.size(); ++i) {
    const Rgb color = edge_colors.empty() ? Rgb{} : edge_colors[i];
    const std::string suffix =
        edge_colors.empty() ? "" : fmt::format(" {} {} {}", color[0], color[1], color[2]);
    const size_t count = graph.edge(edges[i]).points.size();
    for (size_t j = first_vertex; j + 1 < first_vertex + count; ++j)
      text += fmt::format("{} {}{}\n", j, j + 1, suffix);
    first_vertex += count;
  }
  WriteStreamAtomically(path, [&text](std::ostream& stream) { stream << text; });
}

}  // namespace curvefusion
