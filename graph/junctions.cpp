#include "graph/junctions.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "graph/edge_curve.h"
#include "kernel/buckets.h"
#include "kernel/disjoint_sets.h"

namespace curvefusion {

namespace {

// The displacement of a merged node fades over this many times its length. Chosen: bends of at most
// 14 degrees.
constexpr double kReach = 4;
// Chosen: an edge between nodes that become one goes with them up to so many snap distances.
constexpr double kLinkInSnaps = 3;
// Chosen: displacements below this many times the longest link are rounding: no bend.
constexpr double kBendInLinks = 1e-3;
// What merging nodes needs is fetched from memory so many nodes ahead, step by step. Chosen:
// only the time depends on it.
constexpr size_t kLookahead = 6;

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
    if (places_.empty()) return {};
    SortPlaces();
    nodes_.resize(places_.size());
    graph_.Reserve(places_.size(), 2 * places_.size());
    for (size_t i = 0; i < places_.size();) {
      FetchAhead(i);
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
  };

  // By edge, and along each.
  void SortPlaces() {
    const auto [first, last] =
        std::minmax_element(places_.begin(), places_.end(),
                            [](const Place& a, const Place& b) { return a.edge < b.edge; });
    const EdgeId first_edge = first->edge;
    const int edge_count = last->edge - first_edge + 1;
    std::vector<int> buckets;
    buckets.reserve(places_.size());
    for (const Place& place : places_) buckets.push_back(place.edge - first_edge);
    const Buckets by_edge = SortIntoBuckets(buckets, edge_count);
    std::vector<Place> sorted;
    sorted.reserve(places_.size());
    for (const int i : by_edge.members) sorted.push_back(places_[i]);
    for (int k = 0; k < edge_count; ++k)
      std::sort(sorted.begin() + by_edge.first[k], sorted.begin() + by_edge.first[k + 1],
                [](const Place& a, const Place& b) { return a.arc_length < b.arc_length; });
    places_ = std::move(sorted);
  }

  // Fetches the edges that will be cut next, and what they need.
  void FetchAhead(size_t i) const {
    if (i + 2 * kLookahead < places_.size()) graph_.FetchEdge(places_[i + 2 * kLookahead].edge);
    if (i + kLookahead >= places_.size()) return;
    const EdgeId next = places_[i + kLookahead].edge;
    graph_.FetchPoints(next);
    for (const NodeId node : graph_.edge(next).nodes) graph_.FetchNode(node);
  }

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
      SkeletonEdge part = PartOfEdge(whole, lengths, splits[i].first, splits[i + 1].first, snap_);
      part.nodes = {splits[i].second, splits[i + 1].second};
      graph_.AddEdge(std::move(part));
    }
  }

  NodeId NodeAt(EdgeId id, const std::vector<double>& lengths, double arc, Splits& splits) {
    const SkeletonEdge& whole = graph_.edge(id);
    const double length = lengths.back();
    if (std::min(arc, length - arc) <= snap_) return whole.nodes[arc <= length - arc ? 0 : 1];
    const NodeId node = graph_.AddNode(CutPoint(whole, lengths, arc));
    splits.emplace_back(arc, node);
    return node;
  }

  SkeletonGraph& graph_;
  double snap_;
  std::vector<Place> places_;
  std::vector<NodeId> nodes_;  // of places by their number
};

// Few nodes or edges, most often.
using Few = boost::container::small_vector<int, 8>;

// Removes the edges within a group that are no longer than max_link.
void RemoveLinks(SkeletonGraph& graph, std::span<const NodeId> group, double max_link) {
  Few nodes(group.begin(), group.end());
  std::sort(nodes.begin(), nodes.end());
  Few links;
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

Vec3 WeightedMean(const SkeletonGraph& graph, std::span<const NodeId> nodes,
                  std::span<const double> weights) {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    sum += weights[i] * graph.position(nodes[i]);
    weight += weights[i];
  }
  return sum / weight;
}

// Nodes that links hang together, set by set: each ascending, ordered by their first node.
struct LinkedNodes {
  std::vector<NodeId> nodes;
  std::vector<int> begins;  // of each set; one more closes the last
};

LinkedNodes SetsOf(const std::vector<std::pair<NodeId, NodeId>>& links) {
  std::vector<NodeId> nodes;
  nodes.reserve(2 * links.size());
  for (const auto& [a, b] : links) nodes.insert(nodes.end(), {a, b});
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.empty()) return {{}, {0}};
  std::vector<int> numbers(nodes.back() - nodes.front() + 1);
  for (size_t i = 0; i < nodes.size(); ++i) numbers[nodes[i] - nodes.front()] = static_cast<int>(i);
  const auto index = [&](NodeId node) { return numbers[node - nodes.front()]; };
  DisjointSets sets(nodes.size());
  for (const auto& [a, b] : links) sets.Unite(index(a), index(b));
  // Sorted by counting; a set is numbered as its first node.
  const int count = static_cast<int>(nodes.size());
  LinkedNodes linked{std::vector<NodeId>(nodes.size()), std::vector<int>(nodes.size() + 1, 0)};
  for (int i = 0; i < count; ++i) ++linked.begins[sets.Root(i) + 1];
  std::partial_sum(linked.begins.begin(), linked.begins.end(), linked.begins.begin());
  std::vector<int> ends(linked.begins.begin(), linked.begins.end() - 1);
  for (int i = 0; i < count; ++i) linked.nodes[ends[sets.Root(i)]++] = nodes[i];
  return linked;
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

void MergeGroup(SkeletonGraph& graph, std::span<const NodeId> nodes,
                std::span<const double> weights, double max_link) {
  RemoveLinks(graph, nodes, max_link);
  const Vec3 mean = WeightedMean(graph, nodes, weights);
  for (const NodeId node : nodes) {
    if (max_link > 0) {
      Bend(graph, node, mean, max_link);
    } else {
      graph.MoveNode(node, mean);
    }
  }
  for (const NodeId node : nodes) graph.MergeNodes(nodes[0], node);
}

// Fetches what merging the nodes behind a position will need.
void FetchAhead(const SkeletonGraph& graph, const std::vector<NodeId>& nodes, size_t i) {
  const auto ahead = [&](size_t distance, const auto& fetch) {
    for (size_t k = i + distance; k < std::min(i + distance + 2, nodes.size()); ++k)
      if (graph.HasNode(nodes[k]))
        for (const EdgeId id : graph.IncidentEdges(nodes[k])) fetch(id);
  };
  for (size_t k = i + 3 * kLookahead; k < std::min(i + 3 * kLookahead + 2, nodes.size()); ++k)
    graph.FetchNode(nodes[k]);
  ahead(2 * kLookahead, [&graph](EdgeId id) { graph.FetchEdge(id); });
  ahead(kLookahead, [&graph](EdgeId id) { graph.FetchPoints(id); });
}

// Merges each set of nodes, weighted by their degrees before the first is. How many sets.
int MergeLinked(SkeletonGraph& graph, const LinkedNodes& linked, double max_link) {
  std::vector<double> weights;
  weights.reserve(linked.nodes.size());
  for (size_t i = 0; i < linked.nodes.size(); ++i) {
    if (i + kLookahead < linked.nodes.size()) graph.FetchNode(linked.nodes[i + kLookahead]);
    weights.push_back(std::max(1, graph.Degree(linked.nodes[i])));
  }
  int merged = 0;
  for (size_t i = 0; i + 1 < linked.begins.size(); ++i) {
    FetchAhead(graph, linked.nodes, static_cast<size_t>(linked.begins[i]));
    const auto begin = static_cast<size_t>(linked.begins[i]);
    const size_t count = static_cast<size_t>(linked.begins[i + 1]) - begin;
    if (count < 2) continue;
    MergeGroup(graph, {linked.nodes.data() + begin, count}, {weights.data() + begin, count},
               max_link);
    ++merged;
  }
  return merged;
}

}  // namespace

void MergeNodeGroups(SkeletonGraph& graph, const std::vector<NodeGroup>& groups, double max_link) {
  for (const NodeGroup& group : groups) MergeGroup(graph, group.nodes, group.weights, max_link);
  RemoveZeroLengthSegments(graph);
}

int MergeLinkedNodes(SkeletonGraph& graph, const std::vector<std::pair<NodeId, NodeId>>& links,
                     double max_link) {
  const int merged = MergeLinked(graph, SetsOf(links), max_link);
  RemoveZeroLengthSegments(graph);
  return merged;
}

void JoinLocations(SkeletonGraph& graph, const std::vector<LocationPair>& pairs, double snap) {
  const int before = graph.version();
  const std::vector<std::pair<NodeId, NodeId>> links = EdgeCutter(graph, snap).Cut(pairs);
  MergeLinked(graph, SetsOf(links), kLinkInSnaps * snap);
  RemoveZeroLengthSegments(graph, before);
}

}  // namespace curvefusion
