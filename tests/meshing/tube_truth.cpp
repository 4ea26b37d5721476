#include "tests/meshing/tube_truth.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

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

}  // namespace

std::vector<Ball> BallsAlong(const SkeletonGraph& graph) {
  std::vector<Ball> balls;
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
        const Vec3 p = edge.points[i] + t * (edge.points[i + 1] - edge.points[i]) +
                       1e-5 * radius * Vec3(noise(), noise(), noise());
        balls.push_back({p, edge.radii[i] + t * (edge.radii[i + 1] - edge.radii[i])});
      }
    }
  }
  return balls;
}

Topology TopologyOfBalls(const std::vector<Ball>& balls) {
  std::vector<Kernel::Weighted_point_3> points;
  for (const auto& [p, radius] : balls) {
    points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), radius * radius);
  }
  AlphaShape shape(points.begin(), points.end(), 0);
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

Topology TopologyOfTubes(const SkeletonGraph& graph) { return TopologyOfBalls(BallsAlong(graph)); }

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
