#include "fusion/paper/new_parts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "graph/edge_curve.h"
#include "graph/edge_parts.h"
#include "graph/junctions.h"
#include "kernel/spatial_search.h"

namespace curvefusion {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
// The bent end of an attached part fades over this many times the distance it is bent. Chosen: it
// turns by at most 14 degrees.
constexpr double kFade = 4;

// A place on the partial skeleton, or one of its nodes (then edge < 0).
struct Place {
  EdgeId edge = -1;
  double arc_length = 0;
  NodeId node = -1;
  Vec3 position = Vec3::Zero();
};

// A stretch of a bundle edge that matches nothing, by its first and last point.
struct Stretch {
  EdgeId edge;
  size_t first;
  size_t last;
};

std::vector<Stretch> UnmatchedStretches(const SkeletonGraph& bundle,
                                        const std::vector<std::vector<Match>>& matches) {
  std::vector<Stretch> stretches;
  for (const EdgeId id : bundle.Edges()) {
    const auto is_unmatched = [&](size_t i) { return matches[id][i].edge < 0; };
    for (const EdgePart& part : PartsWhere(matches[id].size(), is_unmatched))
      stretches.push_back({id, part.first, part.last});
  }
  return stretches;
}

class PartAttacher {
 public:
  PartAttacher(SkeletonGraph& partial, const SkeletonGraph& bundle,
               const std::vector<std::vector<Match>>& matches, const AttachmentDistances& distances)
      : partial_(partial), bundle_(bundle), matches_(matches), distances_(distances) {
    for (const NodeId node : partial.Nodes()) {
      if (partial.Degree(node) < 3) continue;
      junctions_.push_back(node);
      junction_positions_.push_back(partial.position(node));
    }
    junction_index_.emplace(junction_positions_);
    for (const EdgeId id : partial.Edges())
      arc_lengths_.emplace(id, CumulativeLength(partial.edge(id).points));
  }

  void AddAll() {
    for (const NodeId node : bundle_.Nodes()) PlaceNode(node);
    for (const Stretch& stretch : UnmatchedStretches(bundle_, matches_)) Add(stretch);
    JoinLocations(partial_, joins_, distances_.end);
  }

 private:
  // Where a matched point lies on the partial skeleton as it is now.
  Place PlaceOf(const Match& match) const {
    const SkeletonEdge& edge = partial_.edge(match.edge);
    const std::vector<double>& arcs = arc_lengths_.at(match.edge);
    const size_t i = std::min(static_cast<size_t>(match.parameter), arcs.size() - 2);
    const double fraction = match.parameter - static_cast<double>(i);
    Place place;
    place.edge = match.edge;
    place.arc_length = arcs[i] + fraction * (arcs[i + 1] - arcs[i]);
    place.position = edge.points[i] + fraction * (edge.points[i + 1] - edge.points[i]);
    for (int end = 0; end < 2; ++end) {
      const NodeId node = edge.nodes[end];
      const double snap = partial_.Degree(node) >= 3 ? distances_.junction : distances_.end;
      const double to_end = end == 0 ? place.arc_length : arcs.back() - place.arc_length;
      const double to_other = arcs.back() - to_end;
      if (to_end <= snap && to_end <= to_other) return PlaceAtNode(node);
    }
    return place;
  }

  Place PlaceAtNode(NodeId node) const { return {-1, 0, node, partial_.position(node)}; }

  // Arc length between two places along an edge or over one node; kFar if they are farther apart.
  double Gap(const Place& a, const Place& b) const {
    if (a.edge < 0 && b.edge < 0) return a.node == b.node ? 0 : GapOfNodes(a.node, b.node);
    if (a.edge < 0) return Gap(b, a);
    double gap = kFar;
    if (a.edge == b.edge) gap = std::abs(a.arc_length - b.arc_length);
    for (const auto& [node_a, distance_a] : EndsOf(a))
      for (const auto& [node_b, distance_b] : EndsOf(b))
        if (node_a == node_b) gap = std::min(gap, distance_a + distance_b);
    return gap;
  }

  double GapOfNodes(NodeId a, NodeId b) const {
    double gap = kFar;
    for (const EdgeId id : partial_.IncidentEdges(a)) {
      const std::array<NodeId, 2>& nodes = partial_.edge(id).nodes;
      if (arc_lengths_.count(id) > 0 && (nodes[0] == b || nodes[1] == b))
        gap = std::min(gap, arc_lengths_.at(id).back());
    }
    return gap;
  }

  // The nodes around a place and how far they are.
  std::vector<std::pair<NodeId, double>> EndsOf(const Place& place) const {
    if (place.edge < 0) return {{place.node, 0.0}};
    const std::array<NodeId, 2>& nodes = partial_.edge(place.edge).nodes;
    const double length = arc_lengths_.at(place.edge).back();
    return {{nodes[0], place.arc_length}, {nodes[1], length - place.arc_length}};
  }

  // Where the matched ends of edges at a bundle node lie, nearest match first.
  std::vector<Place> MatchedPlaces(NodeId node) const {
    std::vector<Match> found;
    for (const EdgeId id : bundle_.IncidentEdges(node)) {
      const std::array<NodeId, 2>& nodes = bundle_.edge(id).nodes;
      if (nodes[0] == node && matches_[id].front().edge >= 0) found.push_back(matches_[id].front());
      if (nodes[1] == node && matches_[id].back().edge >= 0) found.push_back(matches_[id].back());
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Match& a, const Match& b) { return a.distance < b.distance; });
    std::vector<Place> places;
    for (const Match& match : found) places.push_back(PlaceOf(match));
    return places;
  }

  // Decides where a bundle node goes: to a junction near by, onto the curve it matches, or nowhere
  // yet. Curves that meet in a junction of the bundle but not near it in the partial skeleton are
  // to meet.
  void PlaceNode(NodeId node) {
    const std::vector<Place> places = MatchedPlaces(node);
    if (bundle_.Degree(node) >= 3) {
      const Vec3& p = bundle_.position(node);
      const int nearest = junction_index_->Nearest(p);
      if (nearest >= 0 && (junction_positions_[nearest] - p).norm() <= distances_.junction) {
        place_of_node_[node] = PlaceAtNode(junctions_[nearest]);
      } else if (!places.empty()) {
        place_of_node_[node] = places[0];
      }
      for (size_t i = 1; i < places.size(); ++i) JoinIfSeparate(places[0], places[i]);
    } else if (!places.empty()) {
      place_of_node_[node] = places[0];
    }
  }

  void JoinIfSeparate(const Place& a, const Place& b) {
    if ((a.position - b.position).norm() > distances_.junction) return;
    if (Gap(a, b) > 3 * distances_.junction) joins_.emplace_back(LocationOf(a), LocationOf(b));
  }

  CurveLocation LocationOf(const Place& place) const {
    if (place.edge >= 0) return {place.edge, place.arc_length};
    const EdgeId id = partial_.IncidentEdges(place.node).front();
    const SkeletonEdge& edge = partial_.edge(id);
    return {id, edge.nodes[0] == place.node ? 0.0 : Length(edge.points)};
  }

  // Where an end of a stretch is to be attached: beside it along the edge, or at its node.
  std::optional<Place> PlaceOfEnd(const Stretch& stretch, bool last) const {
    const std::vector<Match>& matches = matches_[stretch.edge];
    if (!last && stretch.first > 0) return PlaceOf(matches[stretch.first - 1]);
    if (last && stretch.last + 1 < matches.size()) return PlaceOf(matches[stretch.last + 1]);
    const auto found = place_of_node_.find(bundle_.edge(stretch.edge).nodes[last ? 1 : 0]);
    if (found == place_of_node_.end()) return std::nullopt;
    return found->second;
  }

  // The curve of a stretch with the matched points beside it.
  SkeletonEdge CurveOf(const Stretch& stretch) const {
    const SkeletonEdge& edge = bundle_.edge(stretch.edge);
    const size_t first = stretch.first > 0 ? stretch.first - 1 : 0;
    const size_t last = std::min(stretch.last + 1, edge.points.size() - 1);
    const std::vector<double> arcs = CumulativeLength(edge.points);
    return PartOfEdge(edge, arcs, arcs[first], arcs[last]);
  }

  // Whether a stretch says nothing new: it stays within the overlap distance and leads nowhere, or
  // only around.
  bool IsNoise(const Stretch& stretch, const SkeletonEdge& curve, const std::optional<Place>& from,
               const std::optional<Place>& to) const {
    const double length = Length(curve.points);
    const std::vector<Match>& matches = matches_[stretch.edge];
    const bool stays_near =
        std::all_of(matches.begin() + static_cast<std::ptrdiff_t>(stretch.first),
                    matches.begin() + static_cast<std::ptrdiff_t>(stretch.last) + 1,
                    [](const Match& match) { return match.is_near; });
    if (from && to && Gap(*from, *to) <= 2 * distances_.overlap)
      return length <= (stays_near ? 3 : 1) * distances_.overlap;
    if (!stays_near) return false;
    const std::array<NodeId, 2>& nodes = bundle_.edge(stretch.edge).nodes;
    const bool dangles =
        (!from && bundle_.Degree(nodes[0]) == 1) || (!to && bundle_.Degree(nodes[1]) == 1);
    return dangles && length <= 2 * distances_.overlap;
  }

  void Add(const Stretch& stretch) {
    SkeletonEdge curve = CurveOf(stretch);
    const std::array<std::optional<Place>, 2> places = {PlaceOfEnd(stretch, false),
                                                        PlaceOfEnd(stretch, true)};
    if (IsNoise(stretch, curve, places[0], places[1])) return;
    const std::array<NodeId, 2> bundle_nodes = bundle_.edge(stretch.edge).nodes;
    SkeletonGraph bent;  // the part by itself, to bend its ends to where they are attached
    const NodeId first = bent.AddNode(curve.points.front());
    const NodeId last = bent.AddNode(curve.points.back());
    curve.nodes = {first, last};
    bent.AddEdge(curve);
    for (int end = 0; end < 2; ++end) {
      const Vec3 target = places[end] ? places[end]->position : bundle_.position(bundle_nodes[end]);
      const double moved = (target - bent.position(curve.nodes[end])).norm();
      MoveNodeSmoothly(bent, curve.nodes[end], target, kFade * moved);
    }
    RemoveZeroLengthSegments(bent);
    if (bent.empty()) return;
    SkeletonEdge part = bent.edge(bent.Edges().front());
    for (int end = 0; end < 2; ++end)
      part.nodes[end] = places[end] ? NodeAt(*places[end]) : NewNode(bundle_nodes[end]);
    Attach(std::move(part), places);
  }

  void Attach(SkeletonEdge part, const std::array<std::optional<Place>, 2>& places) {
    const double length = Length(part.points);
    const EdgeId id = partial_.AddEdge(std::move(part));
    for (int end = 0; end < 2; ++end)
      if (places[end] && places[end]->edge >= 0)
        joins_.emplace_back(CurveLocation{id, end == 0 ? 0.0 : length}, LocationOf(*places[end]));
  }

  // The node of the partial skeleton at a place; on an edge, a new one to be joined with it.
  NodeId NodeAt(const Place& place) {
    return place.edge < 0 ? place.node : partial_.AddNode(place.position);
  }

  // The node of the partial skeleton that stands for a bundle node that matches nothing.
  NodeId NewNode(NodeId bundle_node) {
    const auto [found, is_new] = new_nodes_.emplace(bundle_node, -1);
    if (is_new) found->second = partial_.AddNode(bundle_.position(bundle_node));
    return found->second;
  }

  SkeletonGraph& partial_;
  const SkeletonGraph& bundle_;
  const std::vector<std::vector<Match>>& matches_;
  AttachmentDistances distances_;
  std::vector<NodeId> junctions_;
  std::vector<Vec3> junction_positions_;
  std::optional<PointIndex> junction_index_;
  std::map<EdgeId, std::vector<double>> arc_lengths_;  // of the edges there were at first
  std::map<NodeId, Place> place_of_node_;              // of bundle nodes that match something
  std::map<NodeId, NodeId> new_nodes_;                 // of those that match nothing
  std::vector<LocationPair> joins_;
};

}  // namespace

void AddNewParts(SkeletonGraph& partial, const SkeletonGraph& bundle,
                 const std::vector<std::vector<Match>>& matches,
                 const AttachmentDistances& distances) {
  PartAttacher(partial, bundle, matches, distances).AddAll();
}

}  // namespace curvefusion
