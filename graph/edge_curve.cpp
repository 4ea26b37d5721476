#include "graph/edge_curve.h"

#include <algorithm>
#include <boost/container/small_vector.hpp>
#include <cassert>
#include <utility>

namespace curvefusion {

namespace {

// A vertex no farther from a cut than this part of its segment is replaced by the cut, so that no
// splinter of a segment is left. Chosen.
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

// Most parts of curves are short.
using Places = boost::container::small_vector<Place, 8>;

template <class T>
T Interpolated(const std::vector<T>& values, const Place& place) {
  if (place.fraction == 0) return values[place.index];
  if (place.fraction == 1) return values[place.index + 1];
  return values[place.index] + place.fraction * (values[place.index + 1] - values[place.index]);
}

// The places of a part: its two cuts and the vertices between them, but for those that give way to
// a cut.
Places PlacesBetween(const std::vector<double>& arc_lengths, double from, double to,
                     double max_splinter) {
  const Place first = PlaceAt(arc_lengths, from);
  const Place last = PlaceAt(arc_lengths, to);
  const auto splinter = [&](size_t i) {
    return std::min(kSplinter, max_splinter / (arc_lengths[i + 1] - arc_lengths[i]));
  };
  Places places;
  places.reserve(last.index - first.index + 2);
  places.push_back(first);
  const size_t begin = first.index + (1 - first.fraction <= splinter(first.index) ? 2 : 1);
  const size_t end = last.index + (last.fraction <= splinter(last.index) ? 0 : 1);
  for (size_t i = begin; i < end; ++i) places.push_back({i, 0.0});
  places.push_back(last);
  return places;
}

template <class T>
std::vector<T> ValuesAt(const std::vector<T>& values, const Places& places) {
  std::vector<T> result;
  if (values.empty()) return result;
  result.reserve(places.size());
  for (const Place& place : places) result.push_back(Interpolated(values, place));
  return result;
}

SkeletonEdge EdgeAt(const SkeletonEdge& edge, const Places& places) {
  return {edge.nodes, ValuesAt(edge.points, places), ValuesAt(edge.radii, places),
          ValuesAt(edge.observations, places)};
}

// The index of a value counted from one end (0: the front, 1: the back) of n.
size_t FromEnd(int end, size_t i, size_t n) { return end == 0 ? i : n - 1 - i; }

// Moves the points near an end of a curve, but for that end.
void Fade(Polyline& points, int end, const Vec3& displacement, double reach) {
  const size_t n = points.size();
  const auto point = [&](size_t i) -> Vec3& { return points[FromEnd(end, i, n)]; };
  double length = 0;
  for (size_t i = 1; i < n; ++i) length += (point(i) - point(i - 1)).norm();
  reach = std::min(reach, length);
  Vec3 last = point(0);
  double arc = 0;
  for (size_t i = 1; i + 1 < n; ++i) {
    const Vec3 here = point(i);
    arc += (here - last).norm();
    if (arc >= reach) return;
    point(i) = here + displacement * (1 - arc / reach);
    last = here;
  }
}

// Adds a value between two that follow one another.
template <class T>
void InsertBetween(std::vector<T>& values, size_t from, size_t to, double fraction) {
  if (values.empty()) return;
  const T between =
      fraction == 0 ? values[from] : T(values[from] + fraction * (values[to] - values[from]));
  values.insert(values.begin() + static_cast<std::ptrdiff_t>(std::max(from, to)), between);
}

// Adds a point at `reach` metres from an end of an edge where its segment there goes on for as long
// again; whether it does.
bool AddBendPoint(SkeletonEdge& edge, int end, double reach) {
  const size_t n = edge.points.size();
  double arc = 0;
  double next = 0;
  size_t i = 0;
  for (; i + 1 < n; ++i) {
    next = arc + (edge.points[FromEnd(end, i + 1, n)] - edge.points[FromEnd(end, i, n)]).norm();
    if (next > reach) break;
    arc = next;
  }
  if (next <= 2 * reach) return false;
  const size_t from = FromEnd(end, i, n);
  const size_t to = FromEnd(end, i + 1, n);
  const double fraction = (reach - arc) / (next - arc);
  InsertBetween(edge.points, from, to, fraction);
  InsertBetween(edge.radii, from, to, fraction);
  InsertBetween(edge.observations, from, to, fraction);
  return true;
}

// A copy of an edge with room for a point at each end that is a node.
SkeletonEdge WithRoom(const SkeletonEdge& edge, NodeId node) {
  const auto room = static_cast<size_t>(std::count(edge.nodes.begin(), edge.nodes.end(), node));
  const auto copy = [room](const auto& values, auto& to) {
    if (values.empty()) return;
    to.reserve(values.size() + room);
    to.assign(values.begin(), values.end());
  };
  SkeletonEdge result;
  result.nodes = edge.nodes;
  copy(edge.points, result.points);
  copy(edge.radii, result.radii);
  copy(edge.observations, result.observations);
  return result;
}

// The edges at a node, each once.
boost::container::small_vector<EdgeId, 8> EdgesAt(const SkeletonGraph& graph, NodeId node) {
  const std::span<const EdgeId> incident = graph.IncidentEdges(node);
  boost::container::small_vector<EdgeId, 8> edges(incident.begin(), incident.end());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void SetEdgeCurve(SkeletonGraph& graph, EdgeId id, SkeletonEdge edge) {
  graph.SetCurve(id, std::move(edge.points), std::move(edge.radii), std::move(edge.observations));
}

void MoveNodeAndFade(SkeletonGraph& graph, NodeId node, const Vec3& position, double reach,
                     bool adds_bend_points) {
  const Vec3 displacement = position - graph.position(node);
  if (displacement.isZero(0)) return;
  for (const EdgeId id : EdgesAt(graph, node)) {
    SkeletonEdge edge = adds_bend_points ? WithRoom(graph.edge(id), node) : graph.edge(id);
    bool has_bend_point = false;
    for (int end = 0; end < 2; ++end)
      if (adds_bend_points && edge.nodes[end] == node && AddBendPoint(edge, end, reach))
        has_bend_point = true;
    if (has_bend_point) RemoveRepeatedPoints(edge);
    for (int end = 0; end < 2; ++end)
      if (edge.nodes[end] == node) Fade(edge.points, end, displacement, reach);
    SetEdgeCurve(graph, id, std::move(edge));
  }
  graph.MoveNode(node, position);
}

}  // namespace

SkeletonEdge PartOfEdge(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                        double from, double to, double max_splinter) {
  assert(from <= to && arc_lengths.size() == edge.points.size());
  return EdgeAt(edge, PlacesBetween(arc_lengths, from, to, max_splinter));
}

Vec3 CutPoint(const SkeletonEdge& edge, const std::vector<double>& arc_lengths, double at) {
  return Interpolated(edge.points, PlaceAt(arc_lengths, at));
}

SkeletonEdge SampledAt(const SkeletonEdge& edge, const std::vector<double>& arc_lengths,
                       const std::vector<double>& at) {
  Places places;
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
  Places places;
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

void MoveNodeSmoothly(SkeletonGraph& graph, NodeId node, const Vec3& position, double reach) {
  MoveNodeAndFade(graph, node, position, reach, false);
}

void MoveNodeWithBends(SkeletonGraph& graph, NodeId node, const Vec3& position, double reach) {
  MoveNodeAndFade(graph, node, position, reach, true);
}

}  // namespace curvefusion
