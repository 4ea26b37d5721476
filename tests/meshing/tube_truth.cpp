#include "tests/meshing/tube_truth.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace curvefusion {

namespace {

// A piece of a tube short enough to have one radius.
struct Capsule {
  Vec3 a, b;
  double radius;
  double Volume() const {
    return std::numbers::pi * radius * radius * ((b - a).norm() + 4.0 / 3 * radius);
  }
  double Distance(const Vec3& p) const {
    return (a + ClosestParameter(a, b, p) * (b - a) - p).norm() - radius;
  }
};

std::vector<Capsule> CapsulesOf(const SkeletonGraph& graph) {
  std::vector<Capsule> capsules;
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    for (size_t i = 0; i + 1 < edge.points.size(); ++i) {
      const double change = std::abs(edge.radii[i + 1] - edge.radii[i]);
      const int parts = 1 + static_cast<int>(50 * change / edge.radii[i]);
      for (int k = 0; k < parts; ++k) {
        const auto at = [&](double t) {
          return edge.points[i] + t * (edge.points[i + 1] - edge.points[i]);
        };
        const double middle = (k + 0.5) / parts;
        capsules.push_back({at(static_cast<double>(k) / parts), at((k + 1.0) / parts),
                            edge.radii[i] + middle * (edge.radii[i + 1] - edge.radii[i])});
      }
    }
  }
  return capsules;
}

// Capsules by the cells of a grid they may reach, so that a point looks at few of them.
class CapsuleGrid {
 public:
  explicit CapsuleGrid(const std::vector<Capsule>& capsules) : capsules_(capsules) {
    for (const Capsule& c : capsules) cell_ = std::max(cell_, 2 * c.radius);
    for (size_t i = 0; i < capsules.size(); ++i) {
      const Capsule& c = capsules[i];
      const Vec3 reach = Vec3::Constant(1.5 * c.radius);
      const Key low = KeyOf(c.a.cwiseMin(c.b) - reach);
      const Key high = KeyOf(c.a.cwiseMax(c.b) + reach);
      for (int x = low[0]; x <= high[0]; ++x) {
        for (int y = low[1]; y <= high[1]; ++y) {
          for (int z = low[2]; z <= high[2]; ++z) cells_[{x, y, z}].push_back(static_cast<int>(i));
        }
      }
    }
  }
  const std::vector<int>& Near(const Vec3& p) const {
    static const std::vector<int> none;
    const auto found = cells_.find(KeyOf(p));
    return found == cells_.end() ? none : found->second;
  }

 private:
  using Key = std::array<int, 3>;
  Key KeyOf(const Vec3& p) const {
    return {static_cast<int>(std::floor(p.x() / cell_)),
            static_cast<int>(std::floor(p.y() / cell_)),
            static_cast<int>(std::floor(p.z() / cell_))};
  }
  const std::vector<Capsule>& capsules_;
  double cell_ = 0;
  std::map<Key, std::vector<int>> cells_;
};

Vec3 RandomPointIn(const Capsule& c, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
  };
  const double length = (c.b - c.a).norm();
  const Vec3 w = length > 0 ? Vec3((c.b - c.a) / length) : Vec3::UnitX();
  const Vec3 u = w.unitOrthogonal();
  while (true) {
    const Vec3 p = c.a + uniform(-c.radius, length + c.radius) * w +
                   uniform(-c.radius, c.radius) * u + uniform(-c.radius, c.radius) * w.cross(u);
    if (c.Distance(p) <= 0) return p;
  }
}

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
      const int parts =
          1 + static_cast<int>(10 * (edge.points[i + 1] - edge.points[i]).norm() / radius);
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

Topology AlphaTopology(const SkeletonGraph& graph, double scale) {
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

}  // namespace

SampledVolume VolumeOfTubes(const SkeletonGraph& graph, int samples) {
  const std::vector<Capsule> capsules = CapsulesOf(graph);
  const CapsuleGrid grid(capsules);
  std::vector<double> cumulative;
  double total = 0;
  for (const Capsule& c : capsules) cumulative.push_back(total += c.Volume());
  std::mt19937_64 random(1);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < samples; ++i) {
    // Stratified over the sum of the volumes.
    const double at = total * (i + static_cast<double>(random() >> 11) * 0x1.0p-53) / samples;
    const size_t chosen = static_cast<size_t>(
        std::upper_bound(cumulative.begin(), cumulative.end() - 1, at) - cumulative.begin());
    const Vec3 p = RandomPointIn(capsules[chosen], random);
    const std::vector<int>& near = grid.Near(p);
    const auto covering = std::count_if(near.begin(), near.end(),
                                        [&](int k) { return capsules[k].Distance(p) <= 0; });
    const double share = 1.0 / static_cast<double>(std::max<std::ptrdiff_t>(1, covering));
    sum += share;
    squares += share * share;
  }
  const double mean = sum / samples;
  const double variance = squares / samples - mean * mean;
  return {total * mean, std::sqrt(std::max(0.0, variance) / samples) / mean};
}

std::optional<Topology> TopologyOfTubes(const SkeletonGraph& graph) {
  const Topology topology = AlphaTopology(graph, 1);
  if (AlphaTopology(graph, 0.97) == topology && AlphaTopology(graph, 1.03) == topology) {
    return topology;
  }
  return std::nullopt;
}

SurfaceDeviation DeviationFromTubes(const TriangleMesh& mesh, const SkeletonGraph& graph) {
  const std::vector<Capsule> capsules = CapsulesOf(graph);
  const CapsuleGrid grid(capsules);
  SurfaceDeviation deviation;
  for (const Vec3f& v : mesh.vertices) {
    double nearest = 1;
    for (const int k : grid.Near(v.cast<double>())) {
      nearest = std::min(nearest, capsules[k].Distance(v.cast<double>()) / capsules[k].radius);
    }
    deviation.outwards = std::max(deviation.outwards, nearest);
    deviation.inwards = std::max(deviation.inwards, -nearest);
  }
  return deviation;
}

}  // namespace curvefusion
