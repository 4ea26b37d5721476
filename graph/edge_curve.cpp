#include "graph/edge_curve.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace curvefusion {

namespace {

// A vertex nearer to a cut than this part of its segment is replaced by the cut, so that no
// splinter of a segment is left.
constexpr double kSplinter = 1e-3;

// A place on a polyline: between the points `index` and `index + 1`, at `fraction` of the segment.
struct Place {
  size_t index;
  double fraction;
};

Place PlaceAt(const std::vector<double>& arc_lengths, double s) {
  const size_t last_segment = arc_lengths.size() - 2;
  if (s <= 0) return {0, 0.0};
  if (s >= arc_lengths.back()) return {last_segment, 1.0};
  const auto next = std::upper_bound(arc_lengths.begin(), arc_lengths.end(), s);
  const size_t i = static_cast<size_t>(next - arc_lengths.begin()) - 1;
  return {i, (s - arc_lengths[i]) / (arc_lengths[i + 1] - arc_lengths[i])};
}

template <class T>
T Interpolated(const std::vector<T>& values, const Place& place) {
  if (place.fraction == 0) return values[place.index];
  if (place.fraction == 1) return values[place.index + 1];
  return values[place.index] + place.fraction * (values[place.index + 1] - values[place.index]);
}

// The places of a part: its two cuts and the vertices between them.
std::vector<Place> PlacesBetween(const std::vector<double>& arc_lengths, double from, double to) {
  const Place first = PlaceAt(arc_lengths, from);
  const Place last = PlaceAt(arc_lengths, to);
  std::vector<Place> places;
  places.reserve(last.index - first.index + 2);
  places.push_back(first);
  const size_t begin = first.index + (first.fraction > 1 - kSplinter ? 2 : 1);
  const size_t end = last.index + (last.fraction < kSplinter ? 0 : 1);
  for (size_t i = begin; i < end; ++i) places.push_back({i, 0.0});
  places.push_back(last);
  return places;
}

template <class T>
std::vector<T> ValuesAt(const std::vector<T>& values, const std::vector<Place>& places) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(places.size());
  for (const Place& place : places) result.push_back(Interpolated(values, place));
  return result;
}

SkeletonEdge EdgeAt(const SkeletonEdge& edge, const std::vector<Place>& places) {
  return {edge.nodes, ValuesAt(edge.points, places), ValuesAt(edge.radii, places),
          ValuesAt(edge.observations, places)};
}

void Fade(Polyline& points, const Vec3& displacement, double reach) {
  const std::vector<double> arc_lengths = CumulativeLength(points);
  reach = std::min(reach, arc_lengths.back());
  for (size_t i = 1; i + 1 < points.size() && arc_lengths[i] < reach; ++i)
    points[i] += displacement * (1 - arc_lengths[i] / reach);
}

// The edges at a node, each once.
std::vector<EdgeId> EdgesAt(const SkeletonGraph& graph, NodeId node) {
  const std::span<const EdgeId> incident = graph.IncidentEdges(node);
  std::vector<EdgeId> edges(incident.begin(), incident.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void SetEdgeCurve(SkeletonGraph& graph, EdgeId id, SkeletonEdge edge) {
  graph.SetCurve(id, std::move(edge.points), std::move(edge.radii), std::move(edge.observations));
}

}  // namespace

SkeletonEdge PartOfEdge(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                        double from, double to) {
  assert(from <= to && arc_lengths.size() == edge.points.size());
  return EdgeAt(edge, PlacesBetween(arc_lengths, from, to));
}

SkeletonEdge WithPointAt(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                         double arc_length) {
  const Place place = PlaceAt(arc_lengths, arc_length);
  std::vector<Place> places;
  places.reserve(edge.points.size() + 1);
  for (size_t i = 0; i < edge.points.size(); ++i) {
    places.push_back({i, 0.0});
    if (i == place.index) places.push_back(place);
  }
  return EdgeAt(edge, places);
}

SkeletonEdge SampledAt(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                       const std::vector<double>& at) {
  std::vector<Place> places;
  places.reserve(at.size());
  const size_t last = arc_lengths.size() - 2;
  size_t i = 0;
  for (const double s : at) {
    while (i < last && arc_lengths[i + 1] <= s) ++i;
    const double length = arc_lengths[i + 1] - arc_lengths[i];
    const double fraction = length > 0 ? (s - arc_lengths[i]) / length : 0;
    places.push_back({i, std::clamp(fraction, 0.0, 1.0)});
  }
  return EdgeAt(edge, places);
}

SkeletonEdge Resampled(const SkeletonEdge& edge, double step) {
  const std::vector<double> arc_lengths = CumulativeLength(edge.points);
  const double length = arc_lengths.back();
  if (length <= 0) return edge;
  const int segments = std::max(1, static_cast<int>(std::lround(length / step)));
  std::vector<Place> places;
  places.reserve(segments + 1);
  for (int i = 0; i < segments; ++i) places.push_back(PlaceAt(arc_lengths, length * i / segments));
  places.push_back(PlaceAt(arc_lengths, length));
  return EdgeAt(edge, places);
}

void ResampleGraph(SkeletonGraph& graph, double step) {
  for (const EdgeId id : graph.Edges()) {
    SkeletonEdge edge = Resampled(graph.edge(id), step);
    RemoveRepeatedPoints(edge);  // where the curve runs back over itself
    // A closed curve shorter than two steps would become a point and back.
    if (edge.points.front() == edge.points.back() && edge.points.size() < 4) continue;
    SetEdgeCurve(graph, id, std::move(edge));
  }
}

void RemoveRepeatedPoints(SkeletonEdge& edge) {
  size_t kept = 1;
  const size_t last = edge.points.size() - 1;
  for (size_t i = 1; i < edge.points.size(); ++i) {
    if (edge.points[i] == edge.points[kept - 1] && i < last) continue;
    if (i == last && kept > 1 && edge.points[i] == edge.points[kept - 1]) --kept;
    edge.points[kept] = edge.points[i];
    if (!edge.radii.empty()) edge.radii[kept] = edge.radii[i];
    if (!edge.observations.empty()) edge.observations[kept] = edge.observations[i];
    ++kept;
  }
  edge.points.resize(kept);
  if (!edge.radii.empty()) edge.radii.resize(kept);
  if (!edge.observations.empty()) edge.observations.resize(kept);
}

void RemoveZeroLengthSegments(SkeletonGraph& graph, int since) {
  for (const EdgeId id : graph.Edges(since)) {
    if (!graph.HasEdge(id)) continue;  // merging nodes removes edges
    const Polyline& points = graph.edge(id).points;
    if (std::adjacent_find(points.begin(), points.end()) == points.end()) continue;
    SkeletonEdge edge = graph.edge(id);
    RemoveRepeatedPoints(edge);
    if (edge.points.size() == 2 && edge.points[0] == edge.points[1]) {
      graph.RemoveEdge(id);
      graph.MergeNodes(edge.nodes[0], edge.nodes[1]);
    } else {
      SetEdgeCurve(graph, id, std::move(edge));
    }
  }
  graph.RemoveIsolatedNodes(since);
}

void AddBendPoints(SkeletonGraph& graph, NodeId node, double reach) {
  for (const EdgeId id : EdgesAt(graph, node)) {
    SkeletonEdge edge = graph.edge(id);
    bool added = false;
    for (int end = 0; end < 2; ++end) {
      if (edge.nodes[0] == node) {
        const std::vector<double> arcs = CumulativeLength(edge.points);
        const auto next = std::upper_bound(arcs.begin(), arcs.end(), reach);
        if (next != arcs.end() && *next > 2 * reach) {
          edge = WithPointAt(edge, arcs, reach);
          added = true;
        }
      }
      Reverse(edge);
    }
    if (!added) continue;
    RemoveRepeatedPoints(edge);
    SetEdgeCurve(graph, id, std::move(edge));
  }
}

void MoveNodeSmoothly(SkeletonGraph& graph, NodeId node, const Vec3& position, double reach) {
  const Vec3 displacement = position - graph.position(node);
  if (displacement.isZero(0)) return;
  for (const EdgeId id : EdgesAt(graph, node)) {
    SkeletonEdge edge = graph.edge(id);
    for (int end = 0; end < 2; ++end) {
      if (edge.nodes[0] == node) Fade(edge.points, displacement, reach);
      Reverse(edge);
    }
    SetEdgeCurve(graph, id, std::move(edge));
  }
  graph.MoveNode(node, position);
}

}  // namespace curvefusion
