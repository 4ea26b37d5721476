#include "tests/graph/contact_oracle.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace curvefusion {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Kernel::FT;
using Point = Kernel::Point_3;

// A segment as the definition sees it.
struct Piece {
  int number;  // of its first point, as in SegmentTable
  int curve;
  std::array<NodeId, 2> curve_nodes;
  // Names of the ends: nodes by their handle, points inside curves by a negative number.
  std::array<int, 2> names;
  Point a, b;
  double arc_a, arc_b, curve_length;
  Eigen::AlignedBox3d box;
};

Eigen::AlignedBox3d BoxOf(const Vec3& a, const Vec3& b) { return {a.cwiseMin(b), a.cwiseMax(b)}; }

// Whether a coordinate alone keeps two pieces apart. The factor of two outweighs the rounding of
// the difference; whether that is above zero is exact.
bool AreFarApart(const Piece& s, const Piece& t, double threshold) {
  const Vec3 gap = (s.box.min() - t.box.max()).cwiseMax(t.box.min() - s.box.max());
  return gap.maxCoeff() > 2 * threshold;
}

std::vector<Piece> Pieces(const SkeletonGraph& graph) {
  std::vector<Piece> pieces;
  int number = 0;
  int curve = 0;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    const std::vector<double> arcs = CumulativeLength(edge.points);
    const auto point = [&edge](size_t i) {
      return Point(edge.points[i].x(), edge.points[i].y(), edge.points[i].z());
    };
    const auto name = [&](size_t i) {
      if (i == 0) return edge.nodes[0];
      if (i + 1 == edge.points.size()) return edge.nodes[1];
      return -1 - number - static_cast<int>(i);
    };
    for (size_t i = 0; i + 1 < edge.points.size(); ++i)
      pieces.push_back({number + static_cast<int>(i),
                        curve,
                        edge.nodes,
                        {name(i), name(i + 1)},
                        point(i),
                        point(i + 1),
                        arcs[i],
                        arcs[i + 1],
                        arcs.back(),
                        BoxOf(edge.points[i], edge.points[i + 1])});
    number += static_cast<int>(edge.points.size());
    ++curve;
  }
  return pieces;
}

// A point of two segments by its parameters on both, and a path between them as a function of it.
using Place = std::array<Number, 2>;
struct Path {
  Number constant, per_x, per_y;
  Number At(const Place& p) const { return constant + per_x * p[0] + per_y * p[1]; }
};

Path PathFrom(double s_a, double s_b, double t_a, double t_b) {
  return {Number(s_a) + Number(t_a), Number(s_b) - Number(s_a), Number(t_b) - Number(t_a)};
}

std::vector<Path> AllPaths(const Piece& s, const Piece& t) {
  std::vector<Path> paths;
  if (s.curve == t.curve) paths.push_back(PathFrom(-s.arc_a, -s.arc_b, t.arc_a, t.arc_b));
  const auto from = [](const Piece& p, int end, double arc) {
    return end == 0 ? arc : p.curve_length - arc;
  };
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (s.curve_nodes[i] == t.curve_nodes[j] && !(s.curve == t.curve && i == j))
        paths.push_back(PathFrom(from(s, i, s.arc_a), from(s, i, s.arc_b), from(t, j, t.arc_a),
                                 from(t, j, t.arc_b)));
  return paths;
}

Point Difference(const Piece& s, const Piece& t, const Place& p) {
  const Point on_s = s.a + p[0] * (s.b - s.a);
  const Point on_t = t.a + p[1] * (t.b - t.a);
  return CGAL::ORIGIN + (on_s - on_t);
}

// The square [0, 1]^2 cut to where all paths are at least `least` long.
std::vector<Place> FarPlaces(const std::vector<Path>& paths, const Number& least) {
  std::vector<Place> polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const Path& path : paths) {
    std::vector<Place> kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Place& p = polygon[i];
      const Place& q = polygon[(i + 1) % polygon.size()];
      const Number at_p = path.At(p) - least;
      const Number at_q = path.At(q) - least;
      if (at_p >= 0) kept.push_back(p);
      if (CGAL::sign(at_p) * CGAL::sign(at_q) < 0) {
        const Number x = at_p / (at_p - at_q);
        kept.push_back({p[0] + x * (q[0] - p[0]), p[1] + x * (q[1] - p[1])});
      }
    }
    polygon = kept;
  }
  return polygon;
}

// Squared distance of the origin from the convex flat polygon of differences.
Number SquaredDistance(const Piece& s, const Piece& t, const std::vector<Place>& places) {
  std::vector<Point> polygon;
  for (const Place& place : places) polygon.push_back(Difference(s, t, place));
  const Point origin(0, 0, 0);
  Number least = CGAL::squared_distance(origin, polygon[0]);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Point& p = polygon[i];
    const Point& q = polygon[(i + 1) % polygon.size()];
    if (p != q) least = (CGAL::min)(least, CGAL::squared_distance(origin, Kernel::Segment_3(p, q)));
  }
  for (size_t i = 1; i + 1 < polygon.size(); ++i) {
    if (CGAL::collinear(polygon[0], polygon[i], polygon[i + 1])) continue;
    const Kernel::Triangle_3 triangle(polygon[0], polygon[i], polygon[i + 1]);
    const Point foot = triangle.supporting_plane().projection(origin);
    if (triangle.has_on(foot)) least = (CGAL::min)(least, CGAL::squared_distance(origin, foot));
  }
  return least;
}

bool HaveOtherCommonPoint(const Piece& s, const Piece& t) {
  int shared = 0;
  Point common, p, q;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      if (s.names[i] == t.names[j]) {
        ++shared;
        common = i == 0 ? s.a : s.b;
        p = i == 0 ? s.b : s.a;
        q = j == 0 ? t.b : t.a;
      }
  const Kernel::Segment_3 on_s(s.a, s.b), on_t(t.a, t.b);
  if (shared == 0) return CGAL::squared_distance(on_s, on_t) == 0;
  if (shared == 2) return true;
  return on_s.has_on(q) || on_t.has_on(p);
}

bool AreInContactByDefinition(const Piece& s, const Piece& t, double threshold) {
  if (HaveOtherCommonPoint(s, t)) return true;
  if (threshold == 0) return false;
  const Number limit(threshold);
  const std::vector<Path> paths = AllPaths(s, t);
  if (paths.empty())
    return CGAL::squared_distance(Kernel::Segment_3(s.a, s.b), Kernel::Segment_3(t.a, t.b)) <=
           limit * limit;
  const std::vector<Place> places = FarPlaces(paths, Number(kConnectedReach * threshold));
  return !places.empty() && SquaredDistance(s, t, places) <= limit * limit;
}

}  // namespace

std::vector<SegmentPair> AllPairsInContact(const SkeletonGraph& graph, double threshold) {
  const std::vector<Piece> pieces = Pieces(graph);
  std::vector<SegmentPair> pairs;
  for (size_t i = 0; i < pieces.size(); ++i)
    for (size_t j = i + 1; j < pieces.size(); ++j)
      if (!AreFarApart(pieces[i], pieces[j], threshold) &&
          AreInContactByDefinition(pieces[i], pieces[j], threshold))
        pairs.push_back({pieces[i].number, pieces[j].number});
  return pairs;
}

std::vector<std::array<int, 4>> Named(const SegmentTable& table,
                                      const std::vector<SegmentPair>& pairs) {
  std::vector<std::array<int, 4>> named;
  for (const auto& [s, t] : pairs)
    named.push_back(
        {table.curves[table.curve_of[s]].edge, s - table.first_points[table.curve_of[s]],
         table.curves[table.curve_of[t]].edge, t - table.first_points[table.curve_of[t]]});
  return named;
}

}  // namespace curvefusion
