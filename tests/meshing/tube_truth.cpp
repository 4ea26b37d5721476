#include "tests/meshing/tube_truth.h"

#include <CGAL/Alpha_shape_3.h>
#include <CGAL/Alpha_shape_cell_base_3.h>
#include <CGAL/Alpha_shape_vertex_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
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
using GrowingVertexBase =
    CGAL::Alpha_shape_vertex_base_3<Kernel, CGAL::Regular_triangulation_vertex_base_3<Kernel>,
                                    CGAL::Tag_true, CGAL::Tag_true>;
using GrowingCellBase =
    CGAL::Alpha_shape_cell_base_3<Kernel, CGAL::Regular_triangulation_cell_base_3<Kernel>,
                                  CGAL::Tag_true, CGAL::Tag_true>;
// Compares alphas exactly.
using AlphaFiltration = CGAL::Alpha_shape_3<
    CGAL::Regular_triangulation_3<
        Kernel, CGAL::Triangulation_data_structure_3<GrowingVertexBase, GrowingCellBase>>,
    CGAL::Tag_true>;
using Alpha = AlphaFiltration::NT;
using AlphaShape = CGAL::Fixed_alpha_shape_3<Triangulation>;

// Where tubes of balls touch, pairs of balls up to a spacing (.1 r) from the place do so while the
// scale grows by up to (.1 / 2)^2; a little more than that.
constexpr double kBallWave = 0.003;
// In radii: changes nearer to each other than this are at one place.
constexpr double kSiteRadius = 0.5;

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

// The alpha from which on a simplex belongs to the complex.
Alpha EntryOf(const AlphaFiltration::Alpha_status& status) {
  return status.is_Gabriel() ? status.alpha_min() : status.alpha_mid();
}

Vec3 PlaceOf(AlphaFiltration::Vertex_handle v) {
  return {v->point().x(), v->point().y(), v->point().z()};
}

// Calls visit(alpha, sign, place) for every simplex: when it enters, by what it changes the Euler
// characteristic, and its middle.
template <class Visit>
void VisitSimplices(const AlphaFiltration& shape, const Visit& visit) {
  for (AlphaFiltration::Vertex_handle v : shape.finite_vertex_handles()) {
    visit(EntryOf(*v->get_alpha_status()), 1, PlaceOf(v));
  }
  for (auto e = shape.finite_edges_begin(); e != shape.finite_edges_end(); ++e) {
    const Vec3 sum = PlaceOf(e->first->vertex(e->second)) + PlaceOf(e->first->vertex(e->third));
    visit(EntryOf(shape.get_alpha_status(*e)), -1, sum / 2);
  }
  for (auto f = shape.finite_facets_begin(); f != shape.finite_facets_end(); ++f) {
    Vec3 sum = Vec3::Zero();
    for (int k = 1; k < 4; ++k) sum += PlaceOf(f->first->vertex((f->second + k) % 4));
    visit(EntryOf(shape.get_alpha_status(*f)), 1, sum / 3);
  }
  for (auto c = shape.finite_cells_begin(); c != shape.finite_cells_end(); ++c) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 4; ++k) sum += PlaceOf(c->vertex(k));
    visit(c->get_alpha(), -1, sum / 4);
  }
}

// A change of the Euler characteristic while radii grow.
struct EulerChange {
  double scale;  // of the radii
  int64_t change;
  Vec3 place;
};

// What happens at one place, in order: changes that follow each other within what balls wave are
// one, as balls of two tubes that touch at a point touch in several pairs and close the holes
// between them at once.
void AddChangesOfPlace(const std::vector<EulerChange>& changes, EulerRange& range) {
  int64_t sum = 0;
  for (size_t i = 0; i < changes.size(); ++i) {
    sum += changes[i].change;
    if (i + 1 < changes.size() && changes[i + 1].scale - changes[i].scale < kBallWave) continue;
    // A hole that closes may do so at both of its mouths and leave a pocket.
    (sum > 0 ? range.high : range.low) += sum > 0 ? 2 * sum : sum;
    sum = 0;
  }
}

void AddChanges(std::vector<EulerChange> changes, double site_radius, EulerRange& range) {
  std::sort(changes.begin(), changes.end(),
            [](const auto& a, const auto& b) { return a.scale < b.scale; });
  DisjointSets sites(changes.size());
  for (size_t i = 0; i < changes.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      if ((changes[i].place - changes[j].place).norm() < site_radius) {
        sites.Unite(static_cast<int>(i), static_cast<int>(j));
      }
    }
  }
  std::map<int, std::vector<EulerChange>> of_site;
  for (size_t i = 0; i < changes.size(); ++i) {
    of_site[sites.Root(static_cast<int>(i))].push_back(changes[i]);
  }
  for (const auto& [root, at_site] : of_site) AddChangesOfPlace(at_site, range);
}

double LeastRadius(const SkeletonGraph& graph) {
  double least = std::numeric_limits<double>::infinity();
  for (const EdgeId id : graph.Edges()) {
    for (const double r : graph.edge(id).radii) least = std::min(least, r);
  }
  return least;
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

EulerRange EulerOfTubesWithin(const SkeletonGraph& graph, double tolerance) {
  const double radius = LeastRadius(graph);
  const auto alpha_at = [radius](double scale) {
    return Alpha((scale * scale - 1) * radius * radius);
  };
  const auto balls = BallsAlong(graph, 1);
  const AlphaFiltration shape(balls.begin(), balls.end(), 0, AlphaFiltration::GENERAL);
  // Simplices that enter together change nothing, unless one of them is critical.
  std::map<Alpha, EulerChange> entries;
  EulerRange range;
  VisitSimplices(shape, [&, first = alpha_at(1 - tolerance), last = alpha_at(1 + tolerance)](
                            const Alpha& alpha, int sign, const Vec3& place) {
    if (alpha <= first) {
      range.low = range.high += sign;
    } else if (alpha <= last) {
      entries.try_emplace(alpha, EulerChange{0, 0, place}).first->second.change += sign;
    }
  });
  std::vector<EulerChange> changes;
  for (auto& [alpha, entry] : entries) {
    entry.scale = std::sqrt(1 + CGAL::to_double(alpha) / (radius * radius));
    if (entry.change != 0) changes.push_back(entry);
  }
  AddChanges(std::move(changes), kSiteRadius * radius, range);
  constexpr int kSteps = 5;  // to either side
  for (int k = -kSteps; k <= kSteps; ++k) {
    const int64_t euler = TopologyOfTubes(graph, 1 + tolerance * k / kSteps).euler;
    range = {std::min(range.low, euler), std::max(range.high, euler)};
  }
  return range;
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
