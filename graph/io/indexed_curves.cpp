#include "graph/io/indexed_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "kernel/error.h"

namespace curvefusion {

namespace {

// Radii of the edge ends at a node.
std::vector<double> RadiiAt(const SkeletonGraph& graph, NodeId node) {
  const std::span<const EdgeId> incident = graph.IncidentEdges(node);
  const std::set<EdgeId> edges(incident.begin(), incident.end());  // a self-loop stands there twice
  std::vector<double> radii;
  for (const EdgeId id : edges) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.radii.empty()) continue;
    if (edge.nodes[0] == node) radii.push_back(edge.radii.front());
    if (edge.nodes[1] == node) radii.push_back(edge.radii.back());
  }
  return radii;
}

double MeanOrZero(const std::vector<double>& values) {
  if (values.empty()) return 0;
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  // Equal radii come back as they are, not as their rounded mean.
  return std::clamp(mean, *std::min_element(values.begin(), values.end()),
                    *std::max_element(values.begin(), values.end()));
}

// The segments of curves and which of them meet at each vertex.
class SegmentNetwork {
 public:
  SegmentNetwork(const IndexedCurves& curves, const std::string& source)
      : curves_(curves), segments_at_(curves.vertices.size()) {
    for (const std::vector<int>& curve : curves.curves)
      for (size_t i = 1; i < curve.size(); ++i) AddSegment({curve[i - 1], curve[i]}, source);
    RequireSingle(source);
    is_used_.assign(segments_.size(), false);
  }

  SkeletonGraph Trace() {
    const int vertex_count = static_cast<int>(curves_.vertices.size());
    for (int v = 0; v < vertex_count; ++v)
      if (segments_at_[v].size() != 2) AddNode(v);
    for (int v = 0; v < vertex_count; ++v)
      if (segments_at_[v].size() != 2) TraceFrom(v);
    for (int v = 0; v < vertex_count; ++v) {  // what is left are closed curves
      if (segments_at_[v].size() != 2 || is_used_[segments_at_[v][0]]) continue;
      AddNode(v);
      TraceFrom(v);
    }
    return std::move(graph_);
  }

 private:
  using Segment = std::array<int, 2>;

  void AddSegment(const Segment& segment, const std::string& source) {
    const auto [a, b] = segment;
    if (curves_.vertices[a] == curves_.vertices[b]) {
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: the segment from vertex {} to vertex {} has length zero", source,
                              a + 1, b + 1));
    }
    const int index = static_cast<int>(segments_.size());
    segments_.push_back(segment);
    segments_at_[a].push_back(index);
    segments_at_[b].push_back(index);
  }

  void RequireSingle(const std::string& source) const {
    std::vector<Segment> sorted = segments_;
    for (auto& [a, b] : sorted)
      if (a > b) std::swap(a, b);
    std::sort(sorted.begin(), sorted.end());
    const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
    if (twice == sorted.end()) return;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: the segment between vertices {} and {} is there twice", source,
                            (*twice)[0] + 1, (*twice)[1] + 1));
  }

  void AddNode(int vertex) { node_of_[vertex] = graph_.AddNode(curves_.vertices[vertex]); }

  void TraceFrom(int vertex) {
    for (const int segment : segments_at_[vertex])
      if (!is_used_[segment]) AddEdge(vertex, segment);
  }

  // Follows segments from a node to the next one.
  void AddEdge(int vertex, int segment) {
    SkeletonEdge edge;
    edge.nodes[0] = node_of_.at(vertex);
    Append(vertex, edge);
    while (true) {
      is_used_[segment] = true;
      const auto [a, b] = segments_[segment];
      vertex = a == vertex ? b : a;
      Append(vertex, edge);
      const auto node = node_of_.find(vertex);
      if (node != node_of_.end()) {
        edge.nodes[1] = node->second;
        break;
      }
      const std::vector<int>& next = segments_at_[vertex];
      segment = next[0] == segment ? next[1] : next[0];
    }
    if (std::count(edge.radii.begin(), edge.radii.end(), 0.0) > 0) edge.radii.clear();
    graph_.AddEdge(std::move(edge));
  }

  void Append(int vertex, SkeletonEdge& edge) const {
    edge.points.push_back(curves_.vertices[vertex]);
    if (!curves_.radii.empty()) edge.radii.push_back(curves_.radii[vertex]);
  }

  const IndexedCurves& curves_;
  std::vector<Segment> segments_;
  std::vector<std::vector<int>> segments_at_;  // per vertex
  std::vector<bool> is_used_;
  std::map<int, NodeId> node_of_;
  SkeletonGraph graph_;
};

}  // namespace

IndexedCurves CurvesOf(const SkeletonGraph& graph) {
  IndexedCurves indexed;
  std::map<NodeId, int> vertex_of;
  bool has_radii = false;
  for (const NodeId node : graph.Nodes()) {
    vertex_of[node] = static_cast<int>(indexed.vertices.size());
    indexed.vertices.push_back(graph.position(node));
    indexed.radii.push_back(MeanOrZero(RadiiAt(graph, node)));
  }
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    has_radii = has_radii || !edge.radii.empty();
    std::vector<int> curve = {vertex_of.at(edge.nodes[0])};
    for (size_t i = 1; i + 1 < edge.points.size(); ++i) {
      curve.push_back(static_cast<int>(indexed.vertices.size()));
      indexed.vertices.push_back(edge.points[i]);
      indexed.radii.push_back(edge.radii.empty() ? 0 : edge.radii[i]);
    }
    curve.push_back(vertex_of.at(edge.nodes[1]));
    indexed.curves.push_back(std::move(curve));
  }
  if (!has_radii) indexed.radii.clear();
  return indexed;
}

SkeletonGraph GraphOf(const IndexedCurves& curves, const std::string& source) {
  return SegmentNetwork(curves, source).Trace();
}

FormatLosses LossesOfIndexedCurves(const SkeletonGraph& graph, bool radii_are_kept) {
  FormatLosses losses;
  int inner_nodes = 0, uneven_nodes = 0;
  for (const NodeId node : graph.Nodes()) {
    const std::span<const EdgeId> edges = graph.IncidentEdges(node);
    inner_nodes += edges.size() == 2 && edges[0] != edges[1] ? 1 : 0;
    const std::vector<double> radii = RadiiAt(graph, node);
    uneven_nodes +=
        std::adjacent_find(radii.begin(), radii.end(), std::not_equal_to<>()) != radii.end() ? 1
                                                                                             : 0;
  }
  bool has_radii = false, has_observations = false;
  for (const EdgeId id : graph.Edges()) {
    has_radii = has_radii || !graph.edge(id).radii.empty();
    has_observations = has_observations || !graph.edge(id).observations.empty();
  }
  if (inner_nodes > 0)
    losses.push_back(fmt::format("{} nodes of two edges become points of curves", inner_nodes));
  if (has_observations) losses.push_back("observation counts are not kept");
  if (has_radii && !radii_are_kept) losses.push_back("radii are not kept");
  if (uneven_nodes > 0 && radii_are_kept)
    losses.push_back(
        fmt::format("{} nodes whose edges differ in radius get the mean", uneven_nodes));
  return losses;
}

}  // namespace curvefusion
