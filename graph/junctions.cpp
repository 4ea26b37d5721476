#include "graph/junctions.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <iterator>
#include <tuple>

#include "graph/edge_curve.h"
#include "kernel/disjoint_sets.h"

namespace curvefusion {

namespace {

// The displacement of a merged node fades over this many times its length: bends of at most 14
// degrees.
constexpr double kReach = 4;
constexpr double kLinkInSnaps = 3;
// Displacements below this many times the longest link are rounding: no bend.
constexpr double kBendInLinks = 1e-3;

// Nodes that places on edges have become.
class EdgeCutter {
 public:
  EdgeCutter(SkeletonGraph& graph, double snap) : graph_(graph), snap_(snap) {}

  // Splits all edges at their places; of each pair of places, the nodes they have become.
  std::vector<std::pair<NodeId, NodeId>> Cut(const std::vector<LocationPair>& pairs) {
    places_.reserve(2 * pairs.size());
    for (const auto& [a, b] : pairs)
      for (const CurveLocation& location : {a, b})
        places_.push_back({location.edge, static_cast<int>(places_.size()), location.arc_length});
    std::sort(places_.begin(), places_.end());
    nodes_.resize(places_.size());
    for (size_t i = 0; i < places_.size();) {
      size_t j = i;
      while (j < places_.size() && places_[j].edge == places_[i].edge) ++j;
      CutEdge(i, j);
      i = j;
    }
    std::vector<std::pair<NodeId, NodeId>> nodes;
    nodes.reserve(pairs.size());
    for (size_t i = 0; i < nodes_.size(); i += 2) nodes.emplace_back(nodes_[i], nodes_[i + 1]);
    return nodes;
  }

 private:
  struct Place {
    EdgeId edge;
    int number;  // in the order in which places are given
    double arc_length;
    bool operator<(const Place& other) const {
      return std::tie(edge, arc_length) < std::tie(other.edge, other.arc_length);
    }
  };

  // Arc lengths at which an edge is split, and the nodes there.
  using Splits = boost::container::small_vector<std::pair<double, NodeId>, 8>;

  // Cuts the edge that a range of places is on.
  void CutEdge(size_t begin, size_t end) {
    const EdgeId id = places_[begin].edge;
    const std::vector<double> lengths = CumulativeLength(graph_.edge(id).points);
    Splits splits;
    splits.emplace_back(0.0, graph_.edge(id).nodes[0]);
    for (size_t i = begin; i < end;) {
      double sum = 0;
      size_t j = i;
      for (; j < end && places_[j].arc_length - places_[i].arc_length <= snap_; ++j)
        sum += places_[j].arc_length;
      const NodeId node = NodeAt(id, lengths, sum / static_cast<double>(j - i), splits);
      for (; i < j; ++i) nodes_[places_[i].number] = node;
    }
    if (splits.size() == 1) return;
    const SkeletonEdge whole = graph_.TakeEdge(id);
    splits.emplace_back(lengths.back(), whole.nodes[1]);
    for (size_t i = 0; i + 1 < splits.size(); ++i) {
      SkeletonEdge part = PartOfEdge(whole, lengths, splits[i].first, splits[i + 1].first);
      part.nodes = {splits[i].second, splits[i + 1].second};
      graph_.AddEdge(std::move(part));
    }
  }

  NodeId NodeAt(EdgeId id, const std::vector<double>& lengths, double arc, Splits& splits) {
    const SkeletonEdge& whole = graph_.edge(id);
    const double length = lengths.back();
    if (std::min(arc, length - arc) <= snap_) return whole.nodes[arc <= length - arc ? 0 : 1];
    const SkeletonEdge place = PartOfEdge(whole, lengths, arc, arc);
    const NodeId node = graph_.AddNode(place.points.front());
    splits.emplace_back(arc, node);
    return node;
  }

  SkeletonGraph& graph_;
  double snap_;
  std::vector<Place> places_;
  std::vector<NodeId> nodes_;  // of places by their number
};

// Removes the edges within a group that are no longer than max_link.
void RemoveLinks(SkeletonGraph& graph, std::vector<NodeId> nodes, double max_link) {
  std::sort(nodes.begin(), nodes.end());
  std::vector<EdgeId> links;
  for (const NodeId node : nodes) {
    for (const EdgeId id : graph.IncidentEdges(node)) {
      const NodeId other = graph.OtherEnd(id, node);
      if (other < node || !std::binary_search(nodes.begin(), nodes.end(), other)) continue;
      if (Length(graph.edge(id).points) <= max_link) links.push_back(id);
    }
  }
  for (const EdgeId id : links)
    if (graph.HasEdge(id)) graph.RemoveEdge(id);
}

Vec3 WeightedMean(const SkeletonGraph& graph, const NodeGroup& group) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (size_t i = 0; i < group.nodes.size(); ++i) {
    sum += group.weights[i] * graph.position(group.nodes[i]);
    weight += group.weights[i];
  }
  return sum / weight;
}

// Groups of nodes linked by pairs; each ascending, ordered by their first node.
std::vector<NodeGroup> LinkedGroups(const std::vector<std::pair<NodeId, NodeId>>& links,
                                    const SkeletonGraph& graph) {
  std::vector<NodeId> nodes;
  for (const auto& [a, b] : links) nodes.insert(nodes.end(), {a, b});
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.empty()) return {};
  std::vector<int> numbers(nodes.back() - nodes.front() + 1);
  for (size_t i = 0; i < nodes.size(); ++i) numbers[nodes[i] - nodes.front()] = static_cast<int>(i);
  const auto index = [&](NodeId node) { return numbers[node - nodes.front()]; };
  DisjointSets sets(nodes.size());
  for (const auto& [a, b] : links) sets.Unite(index(a), index(b));
  std::vector<NodeGroup> groups(nodes.size());
  for (size_t i = 0; i < nodes.size(); ++i) {
    NodeGroup& group = groups[sets.Root(static_cast<int>(i))];
    group.nodes.push_back(nodes[i]);
    group.weights.push_back(std::max(1, graph.Degree(nodes[i])));
  }
  groups.erase(std::remove_if(groups.begin(), groups.end(),
                              [](const NodeGroup& group) { return group.nodes.size() < 2; }),
               groups.end());
  return groups;
}

// Moves a node of a group to where the group meets. Its curves bend over a few times the distance
// moved, where that is more than rounding.
void Bend(SkeletonGraph& graph, NodeId node, const Vec3& position, double max_link) {
  const double moved = (position - graph.position(node)).norm();
  if (moved <= kBendInLinks * max_link) {
    graph.MoveNode(node, position);
    return;
  }
  MoveNodeWithBends(graph, node, position, kReach * moved);
}

void MergeGroups(SkeletonGraph& graph, const std::vector<NodeGroup>& groups, double max_link) {
  for (const NodeGroup& group : groups) {
    RemoveLinks(graph, group.nodes, max_link);
    const Vec3 mean = WeightedMean(graph, group);
    for (const NodeId node : group.nodes) {
      if (max_link > 0) {
        Bend(graph, node, mean, max_link);
      } else {
        graph.MoveNode(node, mean);
      }
    }
    for (size_t i = 1; i < group.nodes.size(); ++i)
      graph.MergeNodes(group.nodes[0], group.nodes[i]);
  }
}

}  // namespace

void MergeNodeGroups(SkeletonGraph& graph, const std::vector<NodeGroup>& groups, double max_link) {
  MergeGroups(graph, groups, max_link);
  RemoveZeroLengthSegments(graph);
}

void JoinLocations(SkeletonGraph& graph, const std::vector<LocationPair>& pairs, double snap) {
  const int before = graph.version();
  const std::vector<std::pair<NodeId, NodeId>> links = EdgeCutter(graph, snap).Cut(pairs);
  MergeGroups(graph, LinkedGroups(links, graph), kLinkInSnaps * snap);
  RemoveZeroLengthSegments(graph, before);
}

}  // namespace curvefusion
