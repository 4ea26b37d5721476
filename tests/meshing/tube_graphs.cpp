#include "tests/meshing/tube_graphs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

namespace curvefusion {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMm = 1e-3;
using Random = std::mt19937_64;

// Independent of the standard library's distributions, so that seeds mean the same everywhere.
double Uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
}
int Integer(Random& random, int low, int high) {
  return low + static_cast<int>(random() % static_cast<uint64_t>(high - low + 1));
}
Vec3 Direction(Random& random) {
  while (true) {
    const Vec3 d(Uniform(random, -1, 1), Uniform(random, -1, 1), Uniform(random, -1, 1));
    if (d.norm() > 0.1 && d.norm() <= 1) return d.normalized();
  }
}

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

// What a scan gives: steps of 1 to 2 mm with jitter of a tenth of a millimetre.
Polyline Noisy(const Polyline& points, Random& random, double jitter) {
  Polyline noisy = Resample(points, Uniform(random, 1, 2) * kMm);
  for (size_t i = 1; i + 1 < noisy.size(); ++i) {
    for (double& x : noisy[i]) x += Uniform(random, -jitter, jitter);
  }
  return noisy;
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

SkeletonGraph Star(Random& random) {
  SkeletonGraph graph;
  const NodeId centre = graph.AddNode({Uniform(random, -1, 1), Uniform(random, -1, 1), 0.5});
  const int arms = Integer(random, 3, 8);
  std::vector<Vec3> directions;
  while (static_cast<int>(directions.size()) < arms) {
    const Vec3 d = Direction(random);
    const double closest = std::cos(10 * kPi / 180);
    if (std::all_of(directions.begin(), directions.end(),
                    [&](const Vec3& e) { return d.dot(e) < closest; })) {
      directions.push_back(d);
    }
  }
  const double radius = Uniform(random, 1, 6) * kMm;
  for (const Vec3& d : directions) {
    const NodeId end = graph.AddNode(graph.position(centre) + Uniform(random, 4, 25) * radius * d);
    AddStraight(graph, centre, end, radius);
  }
  return graph;
}

// Arms in a narrow cone: neighbours at 10 degrees.
SkeletonGraph Broom(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 1, 4) * kMm;
  const NodeId centre = graph.AddNode(Vec3::Zero());
  const int arms = Integer(random, 3, 8);
  const Vec3 w = Direction(random);
  const Vec3 u = w.unitOrthogonal();
  const Vec3 v = w.cross(u);
  for (int i = 0; i < arms; ++i) {
    const double a = 10 * kPi / 180 * (i - arms / 2.0);
    const double tilt = Uniform(random, -0.02, 0.02);
    const NodeId end =
        graph.AddNode(20 * radius * (std::cos(a) * u + std::sin(a) * v + tilt * w).normalized());
    AddStraight(graph, centre, end, radius);
  }
  return graph;
}

SkeletonGraph MixedRadii(Random& random) {
  SkeletonGraph graph = Star(random);
  for (const EdgeId id : graph.Edges()) {
    const double thin = Uniform(random, 1, 2) * kMm;
    // Along a tube the radius changes gently: on a steep cone cross-sections and balls of the same
    // radius are different tubes.
    const bool jump = Integer(random, 0, 1) == 0;
    const double steepest = thin + 0.15 * Length(graph.edge(id).points);
    const double thick = std::min(thin * Uniform(random, 1, 4), jump ? 1.0 : steepest);
    if (jump) {
      SetRadius(graph, id, thick, thick);
    } else {
      SetRadius(graph, id, thin, thick);
    }
  }
  return graph;
}

// Straight tubes thrown into a box, joined nowhere.
SkeletonGraph Unjoined(Random& random) {
  SkeletonGraph graph;
  const int count = Integer(random, 4, 12);
  for (int i = 0; i < count; ++i) {
    const Vec3 a = 30 * kMm * Direction(random);
    const Vec3 b = 30 * kMm * Direction(random);
    if ((b - a).norm() < 5 * kMm) continue;
    AddCurve(graph, {a, b}, Uniform(random, 1.5, 5) * kMm);
  }
  return graph;
}

// Parallel wires with gaps from overlapping to a tenth of the radius.
SkeletonGraph CloseParallel(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 2, 4) * kMm;
  const int count = Integer(random, 2, 6);
  double x = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 skew = 0.3 * kMm * Direction(random);
    AddCurve(graph, {Vec3(x, 0, 0), Vec3(x, 80 * kMm, 0) + skew}, radius);
    x += radius * Uniform(random, 1.7, 2.1);
  }
  return graph;
}

// A wire bent more tightly than it is thick, with hairpins.
SkeletonGraph TightBends(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 2, 5) * kMm;
  Polyline points = {Vec3::Zero()};
  Vec3 direction = Direction(random);
  for (int bend = 0; bend < Integer(random, 2, 5); ++bend) {
    const Vec3 side = direction.cross(Direction(random)).normalized();
    points.push_back(points.back() + Uniform(random, 2, 12) * radius * direction);
    const double bend_radius = Uniform(random, 0.2, 1.5) * radius;
    const double angle = Uniform(random, 0.5, kPi);
    const Polyline arc =
        Arc(points.back() + bend_radius * side, -side, direction, bend_radius, 0, angle, 12);
    points.insert(points.end(), arc.begin() + 1, arc.end());
    direction = (std::cos(angle) * direction + std::sin(angle) * side).normalized();
  }
  points.push_back(points.back() + 5 * radius * direction);
  AddCurve(graph, Integer(random, 0, 1) ? Noisy(points, random, 0.1 * kMm) : points, radius);
  return graph;
}

// A random tree and some loops among near nodes, with edges far shorter than the tubes are thick.
SkeletonGraph ShortEdges(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 2, 5) * kMm;
  std::vector<NodeId> nodes = {graph.AddNode(Vec3::Zero())};
  for (int i = 0; i < Integer(random, 5, 15); ++i) {
    const NodeId from = nodes[random() % nodes.size()];
    const double length = Integer(random, 0, 1) ? Uniform(random, 0.01, 1) : Uniform(random, 1, 10);
    const NodeId to = graph.AddNode(graph.position(from) + length * radius * Direction(random));
    AddStraight(graph, from, to, radius);
    nodes.push_back(to);
  }
  return graph;
}

SkeletonGraph Duplicates(Random& random) {
  SkeletonGraph graph = Star(random);
  const std::vector<EdgeId> originals = graph.Edges();
  for (const EdgeId id : originals) {
    const SkeletonEdge edge = graph.edge(id);
    switch (Integer(random, 0, 3)) {
      case 0:  // the same curve between the same nodes
        graph.AddEdge(edge);
        break;
      case 1:  // the same curve on nodes of its own
        SetRadius(graph, graph.AddPolyline(edge.points), edge.radii[0], edge.radii[0]);
        break;
      case 2: {  // nearly the same curve between the same nodes
        const Vec3 off = Uniform(random, 0, 0.3) * edge.radii[0] * Direction(random);
        AddTube(graph, edge.nodes[0], edge.nodes[1],
                {edge.points[0], (edge.points[0] + edge.points[1]) / 2 + off, edge.points[1]},
                edge.radii[0]);
        break;
      }
      default:  // a part of the curve once more
        AddCurve(graph,
                 {edge.points[0] + 0.3 * (edge.points[1] - edge.points[0]),
                  edge.points[0] + 0.8 * (edge.points[1] - edge.points[0])},
                 edge.radii[0]);
    }
  }
  return graph;
}

SkeletonGraph Loops(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 1.5, 4) * kMm;
  for (int i = 0; i < Integer(random, 1, 4); ++i) {
    const Vec3 w = Direction(random);
    const Vec3 u = w.unitOrthogonal();
    const Vec3 centre = Uniform(random, 0, 8) * radius * Direction(random);
    Polyline circle = Arc(centre, u, w.cross(u), Uniform(random, 0.5, 8) * radius, 0, 2 * kPi, 48);
    circle.back() = circle.front();
    AddCurve(graph, circle, radius);
  }
  return graph;
}

SkeletonGraph CoplanarGrid(Random& random) {
  SkeletonGraph graph;
  const int n = Integer(random, 2, 4);
  const double radius = Uniform(random, 1.5, 4) * kMm;
  const double spacing = Uniform(random, 1.5, 8) * radius;
  std::map<std::pair<int, int>, NodeId> nodes;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      nodes[{i, j}] = graph.AddNode({i * spacing, j * spacing, 0});
      if (i > 0) AddStraight(graph, nodes[{i - 1, j}], nodes[{i, j}], radius);
      if (j > 0) AddStraight(graph, nodes[{i, j - 1}], nodes[{i, j}], radius);
    }
  }
  return graph;
}

SkeletonGraph Coil(Random& random) {
  const double radius = Uniform(random, 1.5, 4) * kMm;
  return HelixGraph(Uniform(random, 1.5, 6) * radius, Uniform(random, 1.5, 4) * radius,
                    Integer(random, 1, 4), radius);
}

// A scanned network: noisy curves between random nodes.
SkeletonGraph NoisyNetwork(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 2, 6) * kMm;
  const double jitter = Uniform(random, 0.05, 0.4) * kMm;
  std::vector<NodeId> nodes;
  for (int i = 0; i < Integer(random, 4, 8); ++i) {
    nodes.push_back(graph.AddNode(60 * kMm * Direction(random)));
  }
  for (int i = 0; i < 2 * static_cast<int>(nodes.size()); ++i) {
    const NodeId a = nodes[random() % nodes.size()];
    const NodeId b = nodes[random() % nodes.size()];
    if (a == b) continue;
    const Vec3 middle = (graph.position(a) + graph.position(b)) / 2 + 15 * kMm * Direction(random);
    AddTube(graph, a, b, Noisy({graph.position(a), middle, graph.position(b)}, random, jitter),
            radius);
  }
  return graph;
}

using Generator = SkeletonGraph (*)(Random&);
const std::map<std::string, Generator>& Generators() {
  static const std::map<std::string, Generator> generators = {{"star", Star},
                                                              {"broom", Broom},
                                                              {"mixed_radii", MixedRadii},
                                                              {"unjoined", Unjoined},
                                                              {"close_parallel", CloseParallel},
                                                              {"tight_bends", TightBends},
                                                              {"short_edges", ShortEdges},
                                                              {"duplicates", Duplicates},
                                                              {"loops", Loops},
                                                              {"coplanar_grid", CoplanarGrid},
                                                              {"coil", Coil},
                                                              {"noisy", NoisyNetwork}};
  return generators;
}

// Positions along a curve at which it meets others, by arc length.
struct Meeting {
  double arc_length;
  NodeId node;
};

}  // namespace

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

const std::vector<std::string>& HardKinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const auto& [name, generator] : Generators()) names.push_back(name);
    return names;
  }();
  return kinds;
}

SkeletonGraph RandomHardGraph(const std::string& kind, uint64_t seed) {
  Random random(seed * 1000003 + std::hash<std::string>()(kind) % 1000);
  return Generators().at(kind)(random);
}

}  // namespace curvefusion
