#include "graph/branch_continuations.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <utility>

#include "graph/hermite_bridge.h"
#include "graph/open_ends.h"
#include "graph/sampled_curves.h"
#include "kernel/point_grid.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen, in metres unless said; a shorter gap is left to the closing of free ends.
constexpr double kMaxGap = 0.060;
constexpr double kMinGap = 0.010;
// So near to a curve the path ahead meets it, and so much farther for each metre. Chosen:
// directions are not exact.
constexpr double kBaseMiss = 0.004;
constexpr double kMissPerGap = 0.15;  // 9 degrees
constexpr double kFitLength = 0.020;  // of the end piece that gives the direction
constexpr double kStep = 0.0015;
// Chosen: curves that run along the path do not cross it.
constexpr double kParallelCosine = 0.8;  // of 37 degrees
constexpr double kFacingCosine = 0.85;   // of 32 degrees, for ends that look at each other
constexpr double kLeastBranch = 0.012;   // shorter ones are not continued
// Chosen: at the very end of a branch the ridges of other wires draw it sideways.
constexpr double kBlurred = 0.006;
constexpr std::array<double, 6> kShifts = {0.003, -0.003, 0.006, -0.006, 0.009, -0.009};

// Ends of branches that are long enough to tell where they lead.
std::vector<OpenEnd> FindOpenEnds(const SkeletonGraph& graph) {
  std::vector<OpenEnd> open = OpenEnds(graph, {kBlurred, kFitLength});
  std::erase_if(open, [&graph](const OpenEnd& end) {
    return Length(graph.edge(end.edge).points) <= kLeastBranch;
  });
  return open;
}

// Looks straight ahead of open ends.
class ContinuationSearch {
 public:
  explicit ContinuationSearch(const SkeletonGraph& graph)
      : graph_(graph),
        open_(FindOpenEnds(graph)),
        curves_(SampleCurvesOf(graph, kStep)),
        grid_(curves_.positions, MissAt(kMaxGap)) {}

  const std::vector<OpenEnd>& open() const { return open_; }

  // The nearer of what faces the end and what crosses its path.
  std::optional<BranchContinuation> Find(const OpenEnd& end) const {
    const int crossing = FirstAhead(end);
    const OpenEnd* facing = NearestFacing(end);
    if (crossing < 0 && facing == nullptr) return std::nullopt;
    const double to_facing =
        facing == nullptr ? 2 * kMaxGap : (facing->position - end.position).norm();
    if (crossing < 0 ||
        to_facing < (curves_.positions[crossing] - end.position).norm() + kSnapDistance) {
      return BranchContinuation{
          end.node, end.edge, Resample(Bridge(end, *facing), kStep), facing->node, {}};
    }
    const CurveLocation& place = curves_.locations[crossing];
    const NodeId node = NodeNear(place);
    const Vec3& target = node >= 0 ? graph_.position(node) : curves_.positions[crossing];
    if ((target - end.position).norm() < kMinGap) return std::nullopt;
    return BranchContinuation{end.node, end.edge, Resample({end.position, target}, kStep), node,
                              place};
  }

 private:
  static double MissAt(double distance) { return kBaseMiss + kMissPerGap * distance; }

  // The end of an edge next to a place on it; -1 where there is none.
  NodeId NodeNear(const CurveLocation& place) const {
    const SkeletonEdge& edge = graph_.edge(place.edge);
    if (place.arc_length <= kSnapDistance) return edge.nodes[0];
    return Length(edge.points) - place.arc_length <= kSnapDistance ? edge.nodes[1] : -1;
  }

  // The point next to the path ahead of those it comes to first; -1 where there are none.
  int FirstAhead(const OpenEnd& end) const {
    for (double at = kMinGap; at <= kMaxGap; at += kStep) {
      const Vec3 p = end.position + at * end.outward;
      int nearest = -1;
      double least = MissAt(at);
      grid_.ForEachWithin(p, MissAt(at), [&](int i, const Vec3& q) {
        if (!IsAhead(end, i, q)) return;
        const Vec3 d = q - end.position;
        const double miss = (d - end.outward.dot(d) * end.outward).norm();
        if (miss > least || (miss == least && i >= nearest)) return;
        least = miss;
        nearest = i;
      });
      if (nearest >= 0) return nearest;
    }
    return -1;
  }

  // What leaves the same node is left out near it.
  bool IsAhead(const OpenEnd& end, int i, const Vec3& q) const {
    const EdgeId edge = curves_.locations[i].edge;
    if (edge == end.edge || std::abs(curves_.tangents[i].dot(end.outward)) > kParallelCosine ||
        (q - end.position).dot(end.outward) < kMinGap) {
      return false;
    }
    const auto& nodes = graph_.edge(edge).nodes;
    const bool is_neighbour = nodes[0] == end.node || nodes[1] == end.node;
    return !is_neighbour || (q - end.position).norm() > 2 * kFitLength;
  }

  // The nearest open end that looks the other way and lies ahead.
  const OpenEnd* NearestFacing(const OpenEnd& end) const {
    const OpenEnd* nearest = nullptr;
    double least = kMaxGap;
    for (const OpenEnd& other : open_) {
      const Vec3 offset = other.position - end.position;
      const double distance = offset.norm();
      if (other.node == end.node || distance < kMinGap || distance >= least) continue;
      const double cosine =
          std::min({-other.outward.dot(end.outward), end.outward.dot(offset) / distance,
                    -other.outward.dot(offset) / distance});
      if (cosine < kFacingCosine) continue;
      nearest = &other;
      least = distance;
    }
    return nearest;
  }

  static Polyline Bridge(const OpenEnd& end, const OpenEnd& facing) {
    return HermiteBridge(end.position, end.outward, facing.position, -facing.outward);
  }

  const SkeletonGraph& graph_;
  std::vector<OpenEnd> open_;
  SampledCurves curves_;
  PointGrid grid_;
};

}  // namespace

std::vector<BranchContinuation> FindContinuations(const SkeletonGraph& graph) {
  if (graph.empty()) return {};
  const ContinuationSearch search(graph);
  std::vector<BranchContinuation> found;
  std::set<std::pair<NodeId, NodeId>> linked;
  for (const OpenEnd& end : search.open()) {
    auto continuation = search.Find(end);
    if (!continuation) continue;
    const auto pair = std::minmax(continuation->from, continuation->to);
    if (continuation->to < 0 || linked.insert(pair).second) found.push_back(*continuation);
  }
  return found;
}

std::vector<BranchContinuation> WithShifts(const SkeletonGraph& graph,
                                           const BranchContinuation& continuation) {
  std::vector<BranchContinuation> paths{continuation};
  if (continuation.to >= 0) return paths;
  const Polyline& points = graph.edge(continuation.target.edge).points;
  const std::vector<double> arc_lengths = CumulativeLength(points);
  for (const double shift : kShifts) {
    BranchContinuation shifted = continuation;
    shifted.target.arc_length += shift;
    if (shifted.target.arc_length < 0 || shifted.target.arc_length > arc_lengths.back()) continue;
    const Vec3 end = PointAt(points, arc_lengths, shifted.target.arc_length);
    shifted.curve = Resample({continuation.curve.front(), end}, kStep);
    paths.push_back(std::move(shifted));
  }
  return paths;
}

void AddContinuations(SkeletonGraph& graph, const std::vector<BranchContinuation>& continuations) {
  std::vector<LocationPair> places;
  for (const BranchContinuation& continuation : continuations) {
    const std::vector<double>& branch_radii = graph.edge(continuation.branch).radii;
    const bool is_inside = continuation.to < 0;
    const NodeId to = is_inside ? graph.AddNode(continuation.curve.back()) : continuation.to;
    SkeletonEdge edge{{continuation.from, to}, continuation.curve, {}, {}};
    if (!branch_radii.empty()) edge.radii.assign(edge.points.size(), Median(branch_radii));
    const EdgeId added = graph.AddEdge(std::move(edge));
    if (is_inside) places.push_back({{added, Length(continuation.curve)}, continuation.target});
  }
  JoinLocations(graph, places, kSnapDistance);
  graph.DissolveDegree2Nodes();
}

}  // namespace curvefusion
