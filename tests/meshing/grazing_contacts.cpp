#include "tests/meshing/grazing_contacts.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "kernel/disjoint_sets.h"
#include "meshing/junction_union.h"
#include "meshing/stubs.h"
#include "meshing/sweep.h"

namespace curvefusion {

namespace {

// In radii of the tubes.
constexpr double kFillingRadius = 0.4;
// Fillings along a line overlap well at this distance.
constexpr double kFillingSpacing = 0.25;
// A filling may graze something else in turn, which is filled as well.
constexpr int kMaxRounds = 10;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
// Every ball carries the radius of the tube it belongs to.
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<double, Kernel,
                                                CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase,
                                                 CGAL::Regular_triangulation_cell_base_3<Kernel>>>;
using Vertex = Triangulation::Vertex_handle;

Vec3 PositionOf(Vertex v) { return {v->point().x(), v->point().y(), v->point().z()}; }

// The point that the balls of a simplex reach last, all at once, as they grow by the same amount in
// squared radius.
struct MeetingPoint {
  Vec3 place;
  double tube_radius = 0;  // the least of the balls
  double scale = 0;        // of that radius, when the balls meet
  bool is_inside = false;  // the simplex
};

template <size_t count>
MeetingPoint MeetingPointOf(const std::array<Vertex, count>& vertices) {
  constexpr int kDimension = static_cast<int>(count) - 1;
  const Vec3 origin = PositionOf(vertices[0]);
  MeetingPoint meeting{origin, vertices[0]->info()};
  Eigen::Matrix<double, 3, kDimension> sides;
  Eigen::Matrix<double, kDimension, 1> right;
  for (int k = 0; k < kDimension; ++k) {
    const Vertex v = vertices[k + 1];
    sides.col(k) = PositionOf(v) - origin;
    right[k] =
        (sides.col(k).squaredNorm() + vertices[0]->point().weight() - v->point().weight()) / 2;
    meeting.tube_radius = std::min(meeting.tube_radius, v->info());
  }
  const Eigen::Matrix<double, kDimension, 1> shares =
      (sides.transpose() * sides).ldlt().solve(right);
  const Vec3 offset = sides * shares;
  const double growth = offset.squaredNorm() - vertices[0]->point().weight();
  meeting.place += offset;
  meeting.scale =
      std::sqrt(std::max(0.0, 1 + growth / (meeting.tube_radius * meeting.tube_radius)));
  meeting.is_inside = shares.minCoeff() > 0 && shares.sum() < 1;
  return meeting;
}

// The places of all critical simplices within the tolerance: those whose balls meet inside them and
// reach that point before all others.
std::vector<MeetingPoint> CriticalPlaces(const Triangulation& balls, double tolerance) {
  std::vector<MeetingPoint> places;
  const auto add = [&](const MeetingPoint& meeting, const auto& is_gabriel) {
    if (meeting.is_inside && std::abs(meeting.scale - 1) <= tolerance && is_gabriel()) {
      places.push_back(meeting);
    }
  };
  for (const auto& edge : balls.finite_edges()) {
    const auto& [cell, i, j] = edge;
    add(MeetingPointOf<2>({cell->vertex(i), cell->vertex(j)}),
        [&] { return balls.is_Gabriel(edge); });
  }
  for (const auto& facet : balls.finite_facets()) {
    const auto corner = [&](int k) { return facet.first->vertex((facet.second + k) % 4); };
    add(MeetingPointOf<3>({corner(1), corner(2), corner(3)}),
        [&] { return balls.is_Gabriel(facet); });
  }
  for (const auto cell : balls.finite_cell_handles()) {
    add(MeetingPointOf<4>({cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3)}),
        [] { return true; });
  }
  return places;
}

// A filling for every place that has none near.
std::vector<Ball> FillingsAt(const std::vector<MeetingPoint>& places) {
  std::vector<Ball> fillings;
  for (const MeetingPoint& at : places) {
    if (std::none_of(fillings.begin(), fillings.end(), [&](const Ball& other) {
          return (other.centre - at.place).norm() < kFillingSpacing * at.tube_radius;
        })) {
      fillings.push_back({at.place, kFillingRadius * at.tube_radius});
    }
  }
  return fillings;
}

// A ball as a polyhedron: a very short tube, turned as no other is.
TriangleMesh PolyhedronOf(const Ball& ball) {
  const Vec3 step = ball.radius * Vec3(0.031, 0.017, 0.043);
  TubePath path{{{ball.centre - step, ball.centre + step}, {ball.radius, ball.radius}}, false, {}};
  return CloseStub(SweepRings(path, 16, 0.1), 0, 1);
}

Topology TopologyOfSurface(const UnionMesh& mesh) {
  const auto vertices = static_cast<int64_t>(mesh.vertices.size());
  const auto triangles = static_cast<int64_t>(mesh.triangles.size());
  DisjointSets sets(mesh.vertices.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sets.Unite(a, b);
    sets.Unite(b, c);
  }
  std::map<int, double> volumes;
  for (const auto& [a, b, c] : mesh.triangles) {
    volumes[sets.Root(a)] += mesh.vertices[a].dot(mesh.vertices[b].cross(mesh.vertices[c]));
  }
  // A closed surface has 3/2 edges per triangle and twice the characteristic of its inside; that of
  // a cavity encloses a negative volume.
  return {
      (vertices - triangles / 2) / 2,
      std::count_if(volumes.begin(), volumes.end(), [](const auto& v) { return v.second > 0; })};
}

}  // namespace

std::optional<FilledTubes> FillGrazingContacts(const SkeletonGraph& graph, double tolerance) {
  std::vector<Ball> balls = BallsAlong(graph);
  std::vector<std::pair<Kernel::Weighted_point_3, double>> points;
  const auto add = [&points](const Ball& ball, double tube_radius) {
    const Kernel::Point_3 centre(ball.centre.x(), ball.centre.y(), ball.centre.z());
    points.push_back({{centre, ball.radius * ball.radius}, tube_radius});
  };
  for (const Ball& ball : balls) add(ball, ball.radius);
  FilledTubes filled;
  for (int round = 0; round < kMaxRounds; ++round) {
    Triangulation triangulation;
    triangulation.insert(points.begin(), points.end());
    const std::vector<Ball> more = FillingsAt(CriticalPlaces(triangulation, tolerance));
    if (more.empty()) {
      balls.insert(balls.end(), filled.fillings.begin(), filled.fillings.end());
      filled.topology = TopologyOfBalls(balls);
      return filled;
    }
    for (const Ball& ball : more) add(ball, ball.radius / kFillingRadius);
    filled.fillings.insert(filled.fillings.end(), more.begin(), more.end());
  }
  return std::nullopt;
}

std::optional<Topology> TopologyOfFilled(const TriangleMesh& mesh, const std::vector<Ball>& balls) {
  std::vector<TriangleMesh> solids = {mesh};
  for (const Ball& ball : balls) solids.push_back(PolyhedronOf(ball));
  const std::optional<UnionMesh> united = UniteSolids(solids);
  if (!united) return std::nullopt;
  return TopologyOfSurface(*united);
}

}  // namespace curvefusion
