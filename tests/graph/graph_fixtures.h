#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Points on the straight line from a to b about `step` apart, ends included bit for bit.
inline Polyline StraightLine(const Vec3& a, const Vec3& b, double step = 1e-3) {
  return Resample({a, b}, step);
}

/// A helix around z with constant speed: `turns` turns of `radius`, rising `pitch` a turn, between
/// the fractions `from` and `to` of its length.
inline Polyline Helix(double radius, double pitch, double turns, double from = 0, double to = 1,
                      int points = 400) {
  Polyline helix;
  for (int i = 0; i <= points; ++i) {
    const double t = (from + (to - from) * i / points) * turns;
    helix.emplace_back(radius * std::cos(2 * M_PI * t), radius * std::sin(2 * M_PI * t), pitch * t);
  }
  return helix;
}

/// A closed regular polygon with `points` corners on a circle in the xy plane.
inline Polyline Ring(double radius, int points, const Vec3& center = Vec3::Zero()) {
  Polyline ring;
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * M_PI * i / points;
    ring.push_back(center + radius * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  ring.push_back(ring.front());
  return ring;
}

/// 40 mm along x and then along y, rounded with a radius; a vertex every millimetre.
inline Polyline RightAngle(double radius) {
  Polyline angle;
  for (double x = -0.04; x < -radius - 1e-9; x += 0.001) angle.emplace_back(x, 0, 0);
  const int steps = std::max(1, static_cast<int>(radius * M_PI / 2 / 0.001));
  for (int i = 0; i <= steps; ++i) {
    const double turned = i * M_PI / 2 / steps;
    angle.emplace_back(radius * (std::sin(turned) - 1), radius * (1 - std::cos(turned)), 0);
  }
  for (double y = radius + 0.001; y < 0.04; y += 0.001) angle.emplace_back(0, y, 0);
  return angle;
}

/// Adds an edge along `points` between two existing nodes.
inline EdgeId Connect(SkeletonGraph& graph, NodeId a, NodeId b, Polyline points) {
  return graph.AddEdge({{a, b}, std::move(points), {}, {}});
}

/// A graph of one curve.
inline SkeletonGraph OfCurve(const Polyline& points) {
  SkeletonGraph graph;
  graph.AddPolyline(points);
  return graph;
}

/// Three straight arms of `length` in the xy plane that meet at `center`.
inline SkeletonGraph YShape(double length, const Vec3& center = Vec3::Zero(), double step = 1e-3) {
  SkeletonGraph graph;
  const NodeId middle = graph.AddNode(center);
  for (int arm = 0; arm < 3; ++arm) {
    const double angle = 2 * M_PI * arm / 3;
    const Vec3 tip = center + length * Vec3(std::cos(angle), std::sin(angle), 0);
    Connect(graph, middle, graph.AddNode(tip), StraightLine(center, tip, step));
  }
  return graph;
}

/// A flat lattice of rows x columns junctions `spacing` apart in the xy plane: (rows - 1) x
/// (columns - 1) cells, that many independent cycles.
inline SkeletonGraph Lattice(int rows, int columns, double spacing, double step = 1e-3) {
  SkeletonGraph graph;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) graph.AddNode({c * spacing, r * spacing, 0});
  const auto connect = [&graph, step](NodeId a, NodeId b) {
    Connect(graph, a, b, StraightLine(graph.position(a), graph.position(b), step));
  };
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const NodeId node = r * columns + c;
      if (c + 1 < columns) connect(node, node + 1);
      if (r + 1 < rows) connect(node, node + columns);
    }
  }
  return graph;
}

/// The nodes at which three or more edges meet.
inline std::vector<NodeId> Junctions(const SkeletonGraph& graph) {
  std::vector<NodeId> junctions;
  for (const NodeId node : graph.Nodes())
    if (graph.Degree(node) >= 3) junctions.push_back(node);
  return junctions;
}

/// Number of nodes of a degree.
inline int CountDegree(const SkeletonGraph& graph, int degree) {
  int count = 0;
  for (const NodeId node : graph.Nodes()) count += graph.Degree(node) == degree;
  return count;
}

/// The same graph after a rigid motion and with independent normal noise on every point but none
/// that would tear edges from their nodes.
inline SkeletonGraph Perturbed(const SkeletonGraph& graph, const RigidTransform& T, double sigma,
                               unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, sigma);
  const auto moved = [&](const Vec3& p) -> Vec3 {
    const Vec3 q = T * p;
    return sigma > 0 ? Vec3(q + Vec3(noise(random), noise(random), noise(random))) : q;
  };
  SkeletonGraph result;
  std::vector<NodeId> node_of(graph.Nodes().empty() ? 0 : graph.Nodes().back() + 1, -1);
  for (const NodeId node : graph.Nodes())
    node_of[node] = result.AddNode(moved(graph.position(node)));
  for (const EdgeId id : graph.Edges()) {
    SkeletonEdge edge = graph.edge(id);
    for (NodeId& node : edge.nodes) node = node_of[node];
    for (Vec3& p : edge.points) p = moved(p);
    edge.points.front() = result.position(edge.nodes[0]);
    edge.points.back() = result.position(edge.nodes[1]);
    result.AddEdge(std::move(edge));
  }
  return result;
}

/// Largest distance by which two motions move the nodes of a graph apart.
inline double Difference(const RigidTransform& a, const RigidTransform& b,
                         const SkeletonGraph& graph) {
  double worst = 0;
  for (const NodeId node : graph.Nodes())
    worst = std::max(worst, (a * graph.position(node) - b * graph.position(node)).norm());
  return worst;
}

/// Largest distance from the points of `graph` to the curves of `truth`. Brute force.
inline double MaxDistance(const SkeletonGraph& graph, const SkeletonGraph& truth) {
  double worst = 0;
  for (const EdgeId id : graph.Edges()) {
    for (const Vec3& p : graph.edge(id).points) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const EdgeId other : truth.Edges())
        nearest = std::min(nearest, Project(truth.edge(other).points, p).distance);
      worst = std::max(worst, nearest);
    }
  }
  return worst;
}

}  // namespace curvefusion
