#include "tests/meshing/hard_networks.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>

#include "tests/meshing/tube_graphs.h"

namespace curvefusion {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMm = kMillimetre;
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

// What a scan gives: steps of 1 to 2 mm with jitter of a tenth of a millimetre.
Polyline Noisy(const Polyline& points, Random& random, double jitter) {
  Polyline noisy = Resample(points, Uniform(random, 1, 2) * kMm);
  for (size_t i = 1; i + 1 < noisy.size(); ++i) {
    for (double& x : noisy[i]) x += Uniform(random, -jitter, jitter);
  }
  return noisy;
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

// A stem with loops that begin and end in one of its nodes.
SkeletonGraph SelfLoops(Random& random) {
  SkeletonGraph graph;
  const double radius = Uniform(random, 1.5, 4) * kMm;
  const NodeId foot = graph.AddNode(Vec3::Zero());
  const NodeId top = graph.AddNode(Uniform(random, 2, 12) * radius * Direction(random));
  AddStraight(graph, foot, top, radius);
  for (int i = 0; i < Integer(random, 1, 4); ++i) {
    const NodeId node = Integer(random, 0, 1) ? foot : top;
    const Vec3 u = Direction(random);
    const double size = Uniform(random, 0.5, 8) * radius;
    Polyline circle = Arc(graph.position(node) - size * u, u, u.unitOrthogonal(), size, 0, 2 * kPi,
                          Integer(random, 3, 48));
    circle.front() = circle.back() = graph.position(node);
    AddTube(graph, node, node, circle, radius);
  }
  return graph;
}

// One edge, from next to nothing to longer than the tube is thick.
SkeletonGraph PointLike(Random& random) {
  SkeletonGraph graph;
  const Vec3 place(Uniform(random, -1, 1), Uniform(random, -1, 1), Uniform(random, -1, 1));
  const double radius = Uniform(random, 1, 6) * kMm;
  const double length = std::pow(10, Uniform(random, -9, 0.5)) * radius;
  AddCurve(graph, {place, place + length * Direction(random)}, radius);
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
                                                              {"self_loops", SelfLoops},
                                                              {"point", PointLike},
                                                              {"noisy", NoisyNetwork}};
  return generators;
}

}  // namespace

const std::vector<std::string>& HardKinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const auto& [name, generator] : Generators()) names.push_back(name);
    return names;
  }();
  return kinds;
}

SkeletonGraph RandomHardGraph(const std::string& kind, uint64_t seed) {
  uint64_t hash = 0xcbf29ce484222325ULL;  // FNV-1a: the same everywhere
  for (const char c : kind) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  Random random(hash + seed);
  return Generators().at(kind)(random);
}

}  // namespace curvefusion
