#include "graph/contraction/curve_network.h"

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "graph/merge.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

struct Link {
  double cost;
  double length;
  int a;
  int b;
  bool operator<(const Link& other) const {
    return std::tie(cost, a, b) < std::tie(other.cost, other.a, other.b);
  }
};

// Links so far, with a search for short paths that touches only the points around its start.
class LinkGraph {
 public:
  explicit LinkGraph(size_t points)
      : neighbours_(points), distance_(points, std::numeric_limits<double>::infinity()) {}

  void Add(const Link& link) {
    neighbours_[link.a].push_back({link.b, link.length});
    neighbours_[link.b].push_back({link.a, link.length});
  }

  // Whether a path from a to b of at most `limit` exists (Dijkstra, cut off at the limit).
  bool HasPath(int a, int b, double limit) {
    bool found = false;
    Reach(a, 0);
    while (!queue_.empty() && !found) {
      const auto [distance, point] = queue_.top();
      queue_.pop();
      found = point == b;
      if (distance > distance_[point]) continue;
      for (const auto& [next, length] : neighbours_[point]) {
        if (distance + length <= limit) Reach(next, distance + length);
      }
    }
    for (const int point : touched_) distance_[point] = std::numeric_limits<double>::infinity();
    touched_.clear();
    queue_ = {};
    return found;
  }

  int Degree(int point) const { return static_cast<int>(neighbours_[point].size()); }

  const std::vector<std::pair<int, double>>& Neighbours(int point) const {
    return neighbours_[point];
  }

 private:
  using Entry = std::pair<double, int>;

  void Reach(int point, double distance) {
    if (distance >= distance_[point]) return;
    distance_[point] = distance;
    touched_.push_back(point);
    queue_.push({distance, point});
  }

  std::vector<std::vector<std::pair<int, double>>> neighbours_;
  std::vector<double> distance_;
  std::vector<int> touched_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

std::vector<Link> CandidateLinks(const RidgePoints& ridge, const CurveNetworkOptions& options) {
  const PointGrid grid(ridge.positions, options.max_link);
  std::vector<Link> links;
  for (int a = 0; a < static_cast<int>(ridge.size()); ++a) {
    grid.ForEachWithin(ridge.positions[a], options.max_link, [&](int b, const Vec3& p) {
      if (b <= a) return;
      const Vec3 d = p - ridge.positions[a];
      const double length = d.norm();
      if (length <= 0) return;
      const double alignment =
          std::min(std::abs(d.dot(ridge.directions[a])), std::abs(d.dot(ridge.directions[b]))) /
          length;
      links.push_back({length * (1 + options.direction_penalty * (1 - alignment)), length, a, b});
    });
  }
  std::sort(links.begin(), links.end());
  return links;
}

// Follows a chain of links from `start` over `next` to the next node.
std::vector<int> FollowChain(const LinkGraph& links, int start, int next,
                             const std::vector<NodeId>& node_of_point) {
  std::vector<int> chain{start, next};
  while (node_of_point[chain.back()] < 0) {
    const auto& around = links.Neighbours(chain.back());
    const int before = chain[chain.size() - 2];
    chain.push_back(around[0].first == before ? around[1].first : around[0].first);
  }
  return chain;
}

// Makes edges of all chains that begin at a node point.
void TraceFrom(int start, const LinkGraph& links, const RidgePoints& ridge,
               const std::vector<NodeId>& node_of_point, std::vector<char>& traced,
               SkeletonGraph& graph) {
  for (const auto& [next, length] : links.Neighbours(start)) {
    if (node_of_point[next] < 0 && traced[next]) continue;
    if (node_of_point[next] >= 0 && next < start) continue;
    const std::vector<int> chain = FollowChain(links, start, next, node_of_point);
    SkeletonEdge edge{{node_of_point[start], node_of_point[chain.back()]}, {}, {}, {}};
    for (const int point : chain) {
      traced[point] = 1;
      edge.points.push_back(ridge.positions[point]);
    }
    graph.AddEdge(std::move(edge));
  }
}

SkeletonGraph TraceChains(const LinkGraph& links, const RidgePoints& ridge) {
  SkeletonGraph graph;
  const int n = static_cast<int>(ridge.size());
  std::vector<NodeId> node_of_point(n, -1);
  std::vector<char> traced(n, 0);
  for (int i = 0; i < n; ++i) {
    if (links.Degree(i) == 2 || links.Degree(i) == 0) continue;
    node_of_point[i] = graph.AddNode(ridge.positions[i]);
  }
  for (int i = 0; i < n; ++i) {
    if (node_of_point[i] >= 0) TraceFrom(i, links, ridge, node_of_point, traced, graph);
  }
  for (int i = 0; i < n; ++i) {
    if (links.Degree(i) != 2 || traced[i]) continue;
    node_of_point[i] = graph.AddNode(ridge.positions[i]);
    TraceFrom(i, links, ridge, node_of_point, traced, graph);
  }
  return graph;
}

}  // namespace

void VisitOptions(CurveNetworkOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"max_link", "m", 0.0005, 0.1,
                 "Deviation: longest link between ridge points; must stay below the spacing of "
                 "parallel wires."},
                options.max_link);
  visitor.Visit({"min_loop", "m", 0, 1,
                 "Deviation: a link may close a loop only where the path around is longer."},
                options.min_loop);
  visitor.Visit({"direction_penalty", "", 0, 100,
                 "Deviation: how much longer a link counts that is perpendicular to the ridge."},
                options.direction_penalty);
  visitor.Visit({"min_spur", "m", 0, 1, "Deviation: shorter dead ends are noise."},
                options.min_spur);
}

SkeletonGraph ConnectRidgePoints(const RidgePoints& ridge, const CurveNetworkOptions& options) {
  LinkGraph links(ridge.size());
  for (const Link& link : CandidateLinks(ridge, options)) {
    if (!links.HasPath(link.a, link.b, options.min_loop)) links.Add(link);
  }
  SkeletonGraph graph = TraceChains(links, ridge);
  PruneSpurs(graph, options.min_spur);
  return graph;
}

}  // namespace curvefusion
