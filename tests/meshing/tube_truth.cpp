#include "tests/meshing/tube_truth.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <vector>

#include "kernel/disjoint_sets.h"
#include "kernel/exact.h"
#include "kernel/polyline.h"
#include "meshing/tube_capsules.h"

namespace curvefusion {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase =
    CGAL::Fixed_alpha_shape_vertex_base_3<Kernel,
                                          CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using CellBase =
    CGAL::Fixed_alpha_shape_cell_base_3<Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation =
    CGAL::Regular_triangulation_3<Kernel,
                                  CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using AlphaShape = CGAL::Fixed_alpha_shape_3<Triangulation>;

std::vector<Kernel::Weighted_point_3> BallsAlong(const SkeletonGraph& graph, double scale) {
  std::vector<Kernel::Weighted_point_3> balls;
  std::mt19937_64 random(1);
  const auto noise = [&random] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    for (size_t i = 0; i + 1 < edge.points.size(); ++i) {
      const double radius = std::min(edge.radii[i], edge.radii[i + 1]);
      // Five balls at least: the triangulation of fewer may have no volume, and then no alpha
      // complex (the whole of a short straight edge was lost for that).
      const int parts =
          4 + static_cast<int>(10 * (edge.points[i + 1] - edge.points[i]).norm() / radius);
      for (int k = 0; k <= parts; ++k) {
        const double t = static_cast<double>(k) / parts;
        // The triangulation needs points that do not all lie in one plane.
        const Vec3 p = edge.points[i] + t * (edge.points[i + 1] - edge.points[i]) +
                       1e-5 * radius * Vec3(noise(), noise(), noise());
        const double r = scale * (edge.radii[i] + t * (edge.radii[i + 1] - edge.radii[i]));
        balls.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), r * r);
      }
    }
  }
  return balls;
}

}  // namespace

Topology TopologyOfTubes(const SkeletonGraph& graph, double scale) {
  const auto balls = BallsAlong(graph, scale);
  AlphaShape shape(balls.begin(), balls.end(), 0);
  Topology topology;
  std::map<AlphaShape::Vertex_handle, AlphaShape::Vertex_handle> parent;
  const auto root = [&](AlphaShape::Vertex_handle v) {
    while (parent.at(v) != v) v = parent.at(v) = parent.at(parent.at(v));
    return v;
  };
  for (auto v = shape.finite_vertices_begin(); v != shape.finite_vertices_end(); ++v) {
    if (shape.classify(v) == AlphaShape::EXTERIOR) continue;
    parent[v] = v;
    ++topology.euler;
    ++topology.components;
  }
  for (auto e = shape.finite_edges_begin(); e != shape.finite_edges_end(); ++e) {
    if (shape.classify(*e) == AlphaShape::EXTERIOR) continue;
    --topology.euler;
    const auto a = root(e->first->vertex(e->second));
    const auto b = root(e->first->vertex(e->third));
    if (a == b) continue;
    parent[a] = b;
    --topology.components;
  }
  for (auto f = shape.finite_facets_begin(); f != shape.finite_facets_end(); ++f) {
    topology.euler += shape.classify(*f) != AlphaShape::EXTERIOR;
  }
  for (auto c = shape.finite_cells_begin(); c != shape.finite_cells_end(); ++c) {
    topology.euler -= shape.classify(c) != AlphaShape::EXTERIOR;
  }
  return topology;
}

namespace {

// How often the distance from one edge to another, followed along it, turns while it differs from
// the sum of the radii by less than the tolerance.
int64_t TurnsOfGap(const SkeletonEdge& along, const SkeletonEdge& other, double tolerance) {
  constexpr int kParts = 8;  // of a segment
  std::vector<double> distances;
  for (size_t i = 0; i + 1 < along.points.size(); ++i) {
    for (int k = 0; k < kParts; ++k) {
      const double t = static_cast<double>(k) / kParts;
      const Vec3 p = along.points[i] + t * (along.points[i + 1] - along.points[i]);
      distances.push_back(Project(other.points, p).distance / (along.radii[i] + other.radii[0]));
    }
  }
  int64_t turns = 0;
  for (size_t i = 1; i + 1 < distances.size(); ++i) {
    const bool turns_here =
        (distances[i] - distances[i - 1]) * (distances[i + 1] - distances[i]) < 0;
    turns += turns_here && std::abs(distances[i] - 1) < tolerance;
  }
  return turns;
}

}  // namespace

Topology TopologyOfStraightTubes(const SkeletonGraph& graph, double scale) {
  const std::vector<EdgeId> edges = graph.Edges();
  Topology topology{static_cast<int64_t>(edges.size()), static_cast<int64_t>(edges.size())};
  DisjointSets joined(edges.size());
  for (size_t i = 0; i < edges.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const SkeletonEdge& a = graph.edge(edges[i]);
      const SkeletonEdge& b = graph.edge(edges[j]);
      const double reach = scale * (a.radii[0] + b.radii[0]);
      if (!AreWithin({a.points.front(), a.points.back()}, {b.points.front(), b.points.back()},
                     reach)) {
        continue;
      }
      --topology.euler;
      topology.components -= joined.Root(static_cast<int>(i)) != joined.Root(static_cast<int>(j));
      joined.Unite(static_cast<int>(i), static_cast<int>(j));
    }
  }
  return topology;
}

int64_t CountGrazingContacts(const SkeletonGraph& graph, double scale_tolerance) {
  constexpr int kSteps = 5;  // to either side
  int64_t contacts = 0;
  Topology before = TopologyOfTubes(graph, 1 - scale_tolerance);
  for (int k = 1 - kSteps; k <= kSteps; ++k) {
    const Topology now = TopologyOfTubes(graph, 1 + scale_tolerance * k / kSteps);
    contacts += std::abs(now.euler - before.euler);
    before = now;
  }
  return contacts;
}

int64_t CountGrazingTurns(const SkeletonGraph& graph, double tolerance) {
  int64_t turns = 0;
  for (const EdgeId a : graph.Edges()) {
    for (const EdgeId b : graph.Edges()) {
      if (a != b) turns += TurnsOfGap(graph.edge(a), graph.edge(b), tolerance);
    }
  }
  return turns;
}

SurfaceDeviation DeviationFromTubes(const TriangleMesh& mesh, const SkeletonGraph& graph) {
  const CapsuleGrid capsules(CapsulesOf(graph));
  SurfaceDeviation deviation;
  for (const Vec3f& v : mesh.vertices) {
    double nearest = 1;
    for (const int k : capsules.Near(v.cast<double>())) {
      const TubeCapsule& capsule = capsules[k];
      nearest = std::min(nearest, capsule.Distance(v.cast<double>()) / capsule.radius);
    }
    deviation.outwards = std::max(deviation.outwards, nearest);
    deviation.inwards = std::max(deviation.inwards, -nearest);
  }
  return deviation;
}

}  // namespace curvefusion
