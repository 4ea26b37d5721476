#include "graph/merge.h"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

#include "graph/contacts.h"
#include "graph/junctions.h"
#include "graph/parallel_edges.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr int kMaxRounds = 8;
// Curves that were joined at both ends of a stretch within the threshold may part a little between.
constexpr double kParallelSlack = 1.5;

bool IsDangling(const SkeletonGraph& graph, const SkeletonEdge& edge) {
  return graph.Degree(edge.nodes[0]) == 1 || graph.Degree(edge.nodes[1]) == 1;
}

// Pairs of junctions within a distance, nearest first.
std::vector<std::tuple<double, int, int>> NearPairs(const std::vector<Vec3>& positions,
                                                    double distance) {
  const PointIndex index(positions);
  std::vector<std::tuple<double, int, int>> pairs;
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(positions.size()); ++i) {
    index.WithinRadius(positions[i], distance, found);
    for (const int j : found)
      if (j > i) pairs.emplace_back((positions[i] - positions[j]).norm(), i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Junctions, united step by step into clusters.
class JunctionClusters {
 public:
  explicit JunctionClusters(const SkeletonGraph& graph) {
    for (const NodeId node : graph.Nodes()) {
      if (graph.Degree(node) < 3) continue;
      cluster_of_.push_back(static_cast<int>(groups_.size()));
      groups_.push_back({{node}, {static_cast<double>(graph.Degree(node))}});
      members_.push_back({cluster_of_.back()});
      means_.push_back(graph.position(node));
      weights_.push_back(graph.Degree(node));
    }
  }

  /// Weighted mean of each cluster; at first, the positions of the junctions.
  const std::vector<Vec3>& means() const { return means_; }

  /// Unites the clusters of two junctions if their means are within the distance.
  void Unite(int i, int j, double distance) {
    const int a = std::min(cluster_of_[i], cluster_of_[j]);
    const int b = std::max(cluster_of_[i], cluster_of_[j]);
    if (a == b || (means_[a] - means_[b]).norm() > distance) return;
    means_[a] = (weights_[a] * means_[a] + weights_[b] * means_[b]) / (weights_[a] + weights_[b]);
    weights_[a] += weights_[b];
    for (const int member : members_[b]) cluster_of_[member] = a;
    MoveAll(members_[b], members_[a]);
    MoveAll(groups_[b].nodes, groups_[a].nodes);
    MoveAll(groups_[b].weights, groups_[a].weights);
  }

  std::vector<NodeGroup> Groups() const {
    std::vector<NodeGroup> united;
    for (const NodeGroup& group : groups_)
      if (group.nodes.size() > 1) united.push_back(group);
    return united;
  }

 private:
  template <class T>
  static void MoveAll(std::vector<T>& from, std::vector<T>& to) {
    to.insert(to.end(), from.begin(), from.end());
    from.clear();
  }

  std::vector<NodeGroup> groups_;          // one per cluster; empty once it is part of another
  std::vector<std::vector<int>> members_;  // junctions of each cluster
  std::vector<int> cluster_of_;            // of each junction
  std::vector<Vec3> means_;
  std::vector<double> weights_;
};

// Short edges of a graph, shortest first.
std::vector<EdgeId> ShortEdges(const SkeletonGraph& graph, double length) {
  std::vector<std::pair<double, EdgeId>> found;
  for (const EdgeId id : graph.Edges()) {
    const double edge_length = Length(graph.edge(id).points);
    if (edge_length < length) found.emplace_back(edge_length, id);
  }
  std::sort(found.begin(), found.end());
  std::vector<EdgeId> edges;
  edges.reserve(found.size());
  for (const auto& entry : found) edges.push_back(entry.second);
  return edges;
}

}  // namespace

void MergeNearbyJunctions(SkeletonGraph& graph, double distance) {
  JunctionClusters clusters(graph);
  for (const auto& [apart, i, j] : NearPairs(clusters.means(), distance))
    clusters.Unite(i, j, distance);
  MergeNodeGroups(graph, clusters.Groups(), 2 * distance);
}

void MergeOverlappingEdges(SkeletonGraph& graph, double distance) {
  for (int round = 0; round < kMaxRounds; ++round) {
    MergeParallelEdges(graph, kParallelSlack * distance);
    graph.DissolveDegree2Nodes();
    std::vector<LocationPair> places;
    for (const Contact& contact : FindContacts(graph, distance)) {
      if (!contact.overlap) continue;
      const std::vector<LocationPair> ends =
          PlacesToJoin(contact, distance, kConnectedReach * distance);
      places.insert(places.end(), ends.begin(), ends.end());
    }
    if (places.empty()) return;
    JoinLocations(graph, places, distance);
  }
  MergeParallelEdges(graph, kParallelSlack * distance);
}

void ContractEdges(SkeletonGraph& graph, const std::vector<EdgeId>& edges) {
  std::vector<NodeGroup> groups;
  std::set<NodeId> touched;
  double longest = 0;
  for (const EdgeId id : edges) {
    const std::array<NodeId, 2> nodes = graph.edge(id).nodes;
    const bool is_free = std::none_of(nodes.begin(), nodes.end(),
                                      [&touched](NodeId node) { return touched.count(node) > 0; });
    if (!is_free) continue;
    NodeGroup group;
    for (const NodeId node : nodes) {
      group.nodes.push_back(node);
      group.weights.push_back(graph.Degree(node));
      touched.insert(node);
    }
    groups.push_back(std::move(group));
    longest = std::max(longest, Length(graph.edge(id).points));
  }
  MergeNodeGroups(graph, groups, longest);
}

void RemoveShortEdges(SkeletonGraph& graph, double length) {
  graph.DissolveDegree2Nodes();
  for (std::vector<EdgeId> edges = ShortEdges(graph, length); !edges.empty();
       edges = ShortEdges(graph, length)) {
    std::vector<EdgeId> links;
    for (const EdgeId id : edges) {
      const SkeletonEdge& edge = graph.edge(id);
      if (edge.nodes[0] == edge.nodes[1] || IsDangling(graph, edge)) {
        graph.RemoveEdge(id);
      } else {
        links.push_back(id);
      }
    }
    ContractEdges(graph, links);
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
  }
}

void PruneSpurs(SkeletonGraph& graph, double length) {
  graph.DissolveDegree2Nodes();
  const auto is_spur = [&graph](EdgeId id) {
    const std::array<NodeId, 2>& nodes = graph.edge(id).nodes;
    return IsDangling(graph, graph.edge(id)) &&
           std::max(graph.Degree(nodes[0]), graph.Degree(nodes[1])) >= 3;
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (const EdgeId id : ShortEdges(graph, length)) {
      if (!is_spur(id)) continue;
      graph.RemoveEdge(id);
      changed = true;
    }
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
  }
}

void RemoveSmallLoops(SkeletonGraph& graph, double length, int since) {
  for (const EdgeId id : graph.Edges(since)) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.nodes[0] == edge.nodes[1] && Length(edge.points) <= length) graph.RemoveEdge(id);
  }
  graph.RemoveIsolatedNodes(since);
}

}  // namespace curvefusion
