#include "graph/contraction/hidden_parts.h"

#include <algorithm>
#include <functional>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/junctions.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kStep = 0.5 * kMillimetre;  // between points of a loop; chosen: a sixth of a wire
constexpr int kSpokes = 40;                  // from the middle of a loop to its curves; chosen
constexpr int kPlacesOnSpoke = 10;           // chosen
constexpr int kLinesOfJunction = 3;          // derived: two always nearly meet

// The shortest way between the ends of an edge along others; none where it is longer than asked.
std::vector<EdgeId> ShortestWayAround(const SkeletonGraph& graph, EdgeId without,
                                      double max_length) {
  const auto [from, to] = graph.edge(without).nodes;
  std::map<NodeId, EdgeId> reached_by;
  using Candidate = std::tuple<double, NodeId, EdgeId>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue;
  queue.emplace(0.0, from, -1);
  while (!queue.empty() && !reached_by.contains(to)) {
    const auto [length, node, by] = queue.top();
    queue.pop();
    if (!reached_by.try_emplace(node, by).second) continue;
    for (const EdgeId next : graph.IncidentEdges(node)) {
      const double longer = length + Length(graph.edge(next).points);
      if (next != without && longer <= max_length)
        queue.emplace(longer, graph.OtherEnd(next, node), next);
    }
  }
  std::vector<EdgeId> way;
  if (!reached_by.contains(to)) return way;
  for (NodeId node = to; node != from; node = graph.OtherEnd(way.back(), node))
    way.push_back(reached_by.at(node));
  return way;
}

// How far the places inside a loop are from its curves, at most.
double RadiusOfOpening(const Polyline& loop) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : loop) middle += p / static_cast<double>(loop.size());
  const size_t stride = std::max<size_t>(1, loop.size() / kSpokes);
  double most = 0;
  for (size_t i = 0; i < loop.size(); i += stride) {
    for (int k = 0; k < kPlacesOnSpoke; ++k) {
      const Vec3 place = middle + static_cast<double>(k) / kPlacesOnSpoke * (loop[i] - middle);
      double nearest = (loop[0] - place).norm();
      for (const Vec3& p : loop) nearest = std::min(nearest, (p - place).norm());
      most = std::max(most, nearest);
    }
  }
  return most;
}

bool IsFilled(const SkeletonGraph& graph, const std::vector<EdgeId>& loop, double pixel_size) {
  Polyline points;
  std::vector<double> radii;
  for (const EdgeId id : loop) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.radii.empty()) return false;
    const Polyline dense = Resample(edge.points, kStep);
    points.insert(points.end(), dense.begin(), dense.end());
    radii.insert(radii.end(), dense.size(), Median(edge.radii));
  }
  return 2 * (RadiusOfOpening(points) - Median(std::move(radii))) < pixel_size;
}

// The radius of the thickest edge at each of the first `count` node handles.
std::vector<double> ThickestAt(const SkeletonGraph& graph, size_t count) {
  std::vector<double> radii(count, 0);
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.radii.empty()) continue;
    for (const NodeId node : edge.nodes) radii[node] = std::max(radii[node], Median(edge.radii));
  }
  return radii;
}

}  // namespace

int OpenFilledLoops(SkeletonGraph& graph, double pixel_size,
                    const JunctionRefinementOptions& options) {
  // Derived: both sides of a loop lie in the zone that contraction blurs.
  const double max_length = 2 * options.reach;
  std::vector<std::pair<double, EdgeId>> longest_first;
  for (const EdgeId id : graph.Edges()) {
    const double length = Length(graph.edge(id).points);
    const auto [a, b] = graph.edge(id).nodes;
    if (a != b && length < max_length) longest_first.emplace_back(length, id);
  }
  std::ranges::sort(longest_first, std::greater());
  std::set<NodeId> opened;
  int loops = 0;
  for (const auto& [length, id] : longest_first) {
    std::vector<EdgeId> loop = ShortestWayAround(graph, id, max_length - length);
    if (loop.empty()) continue;
    const bool is_longest = std::ranges::all_of(loop, [&, most = length](EdgeId other) {
      return Length(graph.edge(other).points) <= most;
    });
    loop.push_back(id);
    if (!is_longest || !IsFilled(graph, loop, pixel_size)) continue;
    for (const EdgeId part : loop)
      for (const NodeId node : graph.edge(part).nodes) opened.insert(node);
    graph.RemoveEdge(id);
    ++loops;
  }
  graph.DissolveDegree2Nodes();
  for (const NodeId node : opened)
    if (graph.HasNode(node) && graph.Degree(node) >= 3)
      PlaceByLines(graph, node, kLinesOfJunction, options);
  return loops;
}

int MergeHiddenJunctions(SkeletonGraph& graph) {
  const std::vector<NodeId> nodes = graph.Nodes();
  if (nodes.empty()) return 0;
  const std::vector<double> radii = ThickestAt(graph, nodes.back() + 1);
  std::vector<std::pair<NodeId, NodeId>> hidden;
  double longest = 0;
  for (const EdgeId id : graph.Edges()) {
    const auto [a, b] = graph.edge(id).nodes;
    const double length = Length(graph.edge(id).points);
    const bool joins_junctions = a != b && graph.Degree(a) >= 3 && graph.Degree(b) >= 3;
    if (!joins_junctions || length >= 2 * std::max(radii[a], radii[b])) continue;
    hidden.emplace_back(a, b);
    longest = std::max(longest, length);
  }
  return MergeLinkedNodes(graph, hidden, longest);
}

}  // namespace curvefusion
