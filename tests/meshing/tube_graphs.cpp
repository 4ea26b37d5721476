#include "tests/meshing/tube_graphs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace curvefusion {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMm = kMillimetre;

// Positions along a curve at which it meets others, by arc length.
struct Meeting {
  double arc_length;
  NodeId node;
};

}  // namespace

void SetRadius(SkeletonGraph& graph, EdgeId id, double first, double last) {
  Polyline points = graph.edge(id).points;
  std::vector<double> radii(points.size());
  for (size_t i = 0; i < radii.size(); ++i) {
    radii[i] =
        first + (last - first) * static_cast<double>(i) / static_cast<double>(radii.size() - 1);
  }
  graph.SetCurve(id, std::move(points), std::move(radii));
}

EdgeId AddTube(SkeletonGraph& graph, NodeId a, NodeId b, Polyline points, double radius) {
  const std::vector<double> radii(points.size(), radius);
  return graph.AddEdge({{a, b}, std::move(points), radii, {}});
}

EdgeId AddStraight(SkeletonGraph& graph, NodeId a, NodeId b, double radius) {
  return AddTube(graph, a, b, {graph.position(a), graph.position(b)}, radius);
}

EdgeId AddCurve(SkeletonGraph& graph, const Polyline& points, double radius) {
  const EdgeId id = graph.AddPolyline(points);
  SetRadius(graph, id, radius, radius);
  return id;
}

Polyline Arc(const Vec3& centre, const Vec3& u, const Vec3& v, double radius, double from,
             double to, int n) {
  Polyline arc;
  for (int i = 0; i <= n; ++i) {
    const double a = from + (to - from) * i / n;
    arc.push_back(centre + radius * (std::cos(a) * u + std::sin(a) * v));
  }
  return arc;
}

SkeletonGraph JoinCurves(const std::vector<WireCurve>& curves, double tolerance) {
  SkeletonGraph graph;
  std::vector<std::vector<Meeting>> meetings(curves.size());
  const auto node_at = [&](const Vec3& p) {
    for (const NodeId node : graph.Nodes()) {
      if ((graph.position(node) - p).norm() < 3 * tolerance) return node;
    }
    return graph.AddNode(p);
  };
  for (size_t i = 0; i < curves.size(); ++i) {
    for (size_t j = i + 1; j < curves.size(); ++j) {
      for (const Vec3& p : curves[i].points) {
        const PolylineProjection q = Project(curves[j].points, p);
        if (q.distance > tolerance) continue;
        const NodeId node = node_at(p);
        meetings[i].push_back({Project(curves[i].points, p).arc_length, node});
        meetings[j].push_back({q.arc_length, node});
      }
    }
  }
  for (size_t i = 0; i < curves.size(); ++i) {
    const Polyline& points = curves[i].points;
    const std::vector<double> cumulative = CumulativeLength(points);
    std::vector<Meeting>& along = meetings[i];
    const auto end_node = [&](double s) {
      for (const Meeting& m : along) {
        if (std::abs(m.arc_length - s) < 3 * tolerance) return m.node;
      }
      return node_at(PointAt(points, cumulative, s));
    };
    const bool closed = points.front() == points.back();
    const NodeId first = end_node(0);
    along.push_back({0, first});
    along.push_back({cumulative.back(), closed ? first : end_node(cumulative.back())});
    std::sort(along.begin(), along.end(),
              [](const Meeting& a, const Meeting& b) { return a.arc_length < b.arc_length; });
    for (size_t k = 1; k < along.size(); ++k) {
      if (along[k].arc_length - along[k - 1].arc_length < 4 * tolerance) {
        along[k] = {along[k - 1].arc_length, along[k - 1].node};
        continue;
      }
      Polyline piece = {graph.position(along[k - 1].node)};
      for (size_t v = 0; v < points.size(); ++v) {
        if (cumulative[v] > along[k - 1].arc_length + tolerance &&
            cumulative[v] < along[k].arc_length - tolerance) {
          piece.push_back(points[v]);
        }
      }
      piece.push_back(graph.position(along[k].node));
      AddTube(graph, along[k - 1].node, along[k].node, piece, curves[i].radius);
    }
  }
  graph.RemoveIsolatedNodes();
  return graph;
}

SkeletonGraph CageGraph() {
  const std::vector<double> heights = {0, 80, 160, 235, 300};
  const std::vector<double> radii = {110, 110, 110, 95, 38};
  std::vector<WireCurve> curves;
  for (size_t k = 0; k < heights.size(); ++k) {
    Polyline ring = Arc(Vec3(0, 0, heights[k] * kMm), Vec3::UnitX(), Vec3::UnitY(), radii[k] * kMm,
                        0, 2 * kPi, 180);
    ring.back() = ring.front();
    curves.push_back({ring, 2.25 * kMm});
  }
  for (int i = 0; i < 10; ++i) {
    const double a = 2 * kPi * i / 10;
    Polyline wire;
    for (size_t k = 0; k < heights.size(); ++k) {
      wire.push_back(kMm * Vec3(radii[k] * std::cos(a), radii[k] * std::sin(a), heights[k]));
    }
    curves.push_back({wire, 2.25 * kMm});
  }
  return JoinCurves(curves, 0.1 * kMm);
}

SkeletonGraph ChairGraph() {
  const auto sheet = [](double u, double v) {
    const double t = std::clamp((v - 370) / 70, 0.0, 110 / 70.0);
    const double w = std::max(0.0, v - 480);
    const double flat = std::min(v, 370.0);
    const double y = -flat - 70 * std::sin(t) + w * std::cos(t);
    const double z = (v < 370 ? -0.04 * flat : -15) + 70 * (1 - std::cos(t)) + w * std::sin(t);
    return Vec3(kMm * Vec3(200 * u, y, z + 25 * u * u));
  };
  SkeletonGraph graph;
  std::map<std::pair<int, int>, NodeId> nodes;
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 21; ++j) nodes[{i, j}] = graph.AddNode(sheet(-1 + 2 * i / 15.0, 40.0 * j));
  }
  const auto add = [&](NodeId a, NodeId b, double u0, double v0, double u1, double v1) {
    Polyline points = {graph.position(a)};
    for (int k = 1; k < 8; ++k)
      points.push_back(sheet(u0 + (u1 - u0) * k / 8, v0 + (v1 - v0) * k / 8));
    points.push_back(graph.position(b));
    AddTube(graph, a, b, points, 2.25 * kMm);
  };
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 21; ++j) {
      const double u = -1 + 2 * i / 15.0;
      const double v = 40.0 * j;
      if (i > 0) add(nodes[{i - 1, j}], nodes[{i, j}], u - 2 / 15.0, v, u, v);
      if (j > 0) add(nodes[{i, j - 1}], nodes[{i, j}], u, v - 40, u, v);
    }
  }
  for (const int i : {0, 15}) {
    for (const int j : {0, 20}) {
      const Vec3 top = graph.position(nodes[{i, j}]);
      const NodeId foot = graph.AddNode({top.x() * 1.1, top.y() + (j == 0 ? 0.04 : -0.14), -0.32});
      AddStraight(graph, nodes[{i, j}], foot, 6 * kMm);
    }
  }
  return graph;
}

SkeletonGraph LatticeGraph(int n, double spacing, double radius) {
  SkeletonGraph graph;
  const auto id = [n](int i, int j, int k) { return (i * n + j) * n + k; };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        graph.AddNode(spacing * Vec3(i, j, k));
        if (i > 0) AddStraight(graph, id(i - 1, j, k), id(i, j, k), radius);
        if (j > 0) AddStraight(graph, id(i, j - 1, k), id(i, j, k), radius);
        if (k > 0) AddStraight(graph, id(i, j, k - 1), id(i, j, k), radius);
      }
    }
  }
  return graph;
}

SkeletonGraph StarGraph(const std::vector<Vec3>& directions, double length, double radius) {
  SkeletonGraph graph;
  const NodeId centre = graph.AddNode(Vec3::Zero());
  for (const Vec3& d : directions) {
    AddStraight(graph, centre, graph.AddNode(length * d.normalized()), radius);
  }
  return graph;
}

SkeletonGraph HelixGraph(double helix_radius, double pitch, int turns, double radius) {
  Polyline points;
  for (int i = 0; i <= 48 * turns; ++i) {
    const double a = 2 * kPi * i / 48;
    points.emplace_back(helix_radius * std::cos(a), helix_radius * std::sin(a), pitch * i / 48);
  }
  SkeletonGraph graph;
  AddCurve(graph, points, radius);
  return graph;
}

SkeletonGraph RingGraph(double ring_radius, double radius) {
  Polyline points = Arc(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), ring_radius, 0, 2 * kPi, 360);
  points.back() = points.front();
  SkeletonGraph graph;
  AddCurve(graph, points, radius);
  return graph;
}

}  // namespace curvefusion
