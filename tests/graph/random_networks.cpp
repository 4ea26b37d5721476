#include "tests/graph/random_networks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace curvefusion {
namespace {

constexpr double kThreshold = 3 * kMillimetre;

class NetworkMaker {
 public:
  NetworkMaker(uint64_t seed, int size) : random_(seed), size_(std::max(1, size)) {}

  RandomNetwork Make() {
    constexpr int kKinds = 10;
    const int kinds = Chance(0.2) ? 2 : 1;
    for (int i = 0; i < kinds; ++i) AddKind(Integer(0, kKinds - 1));
    Place();
    return {Connected(), threshold_};
  }

 private:
  double Real(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int Integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool Chance(double share) { return Real(0, 1) < share; }
  Vec3 Vector(double size) { return {Real(-size, size), Real(-size, size), Real(-size, size)}; }
  int Count() { return Integer(1, size_); }

  // A distance at the threshold, one ulp to either side, or anything near.
  double CriticalDistance() {
    const double far = std::numeric_limits<double>::infinity();
    switch (Integer(0, 4)) {
      case 0:
        return kThreshold;
      case 1:
        return std::nextafter(kThreshold, far);
      case 2:
        return std::nextafter(kThreshold, 0);
      case 3:
        return 0;
      default:
        return Real(0, 2 * kThreshold);
    }
  }

  void AddKind(int kind) {
    using Maker = void (NetworkMaker::*)();
    constexpr Maker kMakers[] = {&NetworkMaker::AddLattice,    &NetworkMaker::AddParallels,
                                 &NetworkMaker::AddDuplicates, &NetworkMaker::AddTouches,
                                 &NetworkMaker::AddSpiral,     &NetworkMaker::AddStar,
                                 &NetworkMaker::AddSoup,       &NetworkMaker::AddFolds,
                                 &NetworkMaker::AddSegments,   &NetworkMaker::AddFineSpirals};
    (this->*kMakers[kind])();
  }

  // A straight curve in one or more segments.
  void AddLine(const Vec3& a, const Vec3& b) {
    Polyline line = {a};
    const int parts = Chance(0.5) ? 1 : Integer(1, 6);
    for (int i = 1; i < parts; ++i) line.push_back(a + (b - a) * i / parts);
    line.push_back(b);
    curves_.push_back(line);
  }

  void AddLattice() {
    const int rows = std::max(1, Count() / 2);
    const double spacing = Chance(0.3) ? Real(0.5, 2) * kThreshold : Real(4, 20) * kThreshold;
    const double rise = CriticalDistance();
    for (int i = 0; i < rows; ++i) {
      AddLine({-spacing, i * spacing, 0}, {rows * spacing, i * spacing, 0});
      AddLine({i * spacing, -spacing, rise}, {i * spacing, rows * spacing, rise});
    }
  }

  void AddParallels() {
    const int count = Count();
    double y = 0;
    for (int i = 0; i < count; ++i) {
      const double x = Chance(0.5) ? 0 : Real(-0.05, 0.05);
      AddLine({x, y, 0}, {x + (Chance(0.5) ? 0.0625 : Real(0.001, 0.1)), y, 0});
      if (Chance(0.7)) y += CriticalDistance();
    }
  }

  void AddDuplicates() {
    AddSoup();
    const size_t count = curves_.size();
    for (size_t i = 0; i < count; ++i) {
      Polyline copy = curves_[i];
      if (Chance(0.5)) std::reverse(copy.begin(), copy.end());
      if (Chance(0.3)) copy.resize(copy.size() / 2 + 1);
      for (int k = Integer(0, 3); k > 0; --k)
        copy.insert(copy.begin() + Integer(0, static_cast<int>(copy.size()) - 1), copy[0]);
      if (copy.size() < 2) copy.push_back(copy[0]);
      curves_.push_back(copy);
    }
  }

  void AddTouches() {
    AddLine({-0.1, 0, 0}, {0.1, 0, 0});
    const int count = Count();
    for (int i = 0; i < count; ++i) {
      const double x = Chance(0.3) ? 0.03125 : Real(-0.1, 0.1);
      AddLine({x, CriticalDistance(), 0},
              {x + Real(-0.03, 0.03), Real(0.005, 0.05), Real(0, 0.01)});
    }
  }

  // An Archimedean spiral or a coil whose turns lie near the threshold.
  void AddSpiral() { AddSpiralOf(Integer(6, 24)); }
  void AddFineSpirals() { AddSpiralOf(Integer(24, 60)); }
  void AddSpiralOf(int corners) {
    const double pitch = Chance(0.3) ? CriticalDistance() : Real(0.2, 3) * kThreshold;
    const double radius = Real(0.5, 8) * kThreshold;
    const bool is_flat = Chance(0.5);
    const double turns = Real(1, 4);
    Polyline points;
    for (int i = 0; i <= static_cast<int>(turns * corners); ++i) {
      const double turn = static_cast<double>(i) / corners;
      const double r = radius + (is_flat ? pitch * turn : 0);
      points.emplace_back(r * std::cos(2 * M_PI * turn), r * std::sin(2 * M_PI * turn),
                          is_flat ? 0 : pitch * turn);
    }
    if (points.size() > 1) curves_.push_back(points);
  }

  void AddStar() {
    const int count = Count();
    const bool is_flat = Chance(0.3);
    for (int i = 0; i < count; ++i) {
      Vec3 tip = Vector(0.05);
      if (is_flat) tip.z() = 0;
      if (Chance(0.5)) {
        AddLine(-tip, tip);
      } else {
        curves_.push_back({-tip, Vec3::Zero(), Chance(0.5) ? Vec3(tip) : Vector(0.05)});
      }
    }
  }

  void AddSoup() {
    const int count = Count();
    const double size = Chance(0.5) ? 0.01 : 0.05;
    const double step = Chance(0.3) ? 0.0005 : Real(0.001, 0.02);
    for (int curve = 0; curve < count; ++curve) {
      Polyline points = {Vector(size)};
      Vec3 direction = Vector(1);
      const int steps = Integer(1, 15);
      for (int i = 0; i < steps; ++i) {
        direction = (direction.normalized() + Vector(0.7));
        points.push_back(points.back() + step * direction);
      }
      if (Chance(0.15)) points.push_back(points.front());
      curves_.push_back(points);
    }
  }

  // Curves that run back over themselves, and figures of eight.
  void AddFolds() {
    const int count = Count();
    for (int i = 0; i < count; ++i) {
      const Vec3 a = Vector(0.03), b = Vector(0.03), c = Vector(0.03);
      switch (Integer(0, 4)) {
        case 0:
          curves_.push_back({a, b, a});
          break;
        case 1:
          curves_.push_back({a, b, a + 0.5 * (b - a), c});
          break;
        case 2:
          curves_.push_back({a, b, c, a, c});
          break;
        case 3:
          curves_.push_back({a, b, a + Vec3(0, 0, CriticalDistance())});
          break;
        default:
          curves_.push_back({a, a + Vec3(0.02, 0.02, 0), a + Vec3(0.02, 0, 0),
                             a + Vec3(0, 0.02, CriticalDistance()), a});
      }
    }
  }

  void AddSegments() {
    const int count = Count();
    const double size = Real(0.01, 0.3);
    for (int i = 0; i < count; ++i) curves_.push_back({Vector(size), Vector(size)});
  }

  // Moves everything to another scale and place. Powers of two keep critical distances exact.
  void Place() {
    double scale = 1;
    Vec3 offset = Vec3::Zero();
    if (Chance(0.2)) scale = Chance(0.5) ? std::ldexp(1, -20) : std::ldexp(1, 10);
    if (Chance(0.2)) offset = scale * Vec3(1e6, -1e6, Chance(0.5) ? 0 : 1e6);
    threshold_ = Chance(0.25) ? 0 : scale * kThreshold;
    for (Polyline& points : curves_)
      for (Vec3& p : points) p = scale * p + offset;
  }

  // The curves as a graph in which some nodes are one, some edges are split, and some have values.
  SkeletonGraph Connected() {
    SkeletonGraph graph;
    for (const Polyline& points : curves_) AddCurve(points, graph);
    if (Chance(0.5)) {
      const std::vector<NodeId> nodes = graph.Nodes();
      for (int i = Integer(0, 3); i > 0; --i) {
        const NodeId a = nodes[Integer(0, static_cast<int>(nodes.size()) - 1)];
        const NodeId b = nodes[Integer(0, static_cast<int>(nodes.size()) - 1)];
        if (graph.HasNode(a) && graph.HasNode(b)) graph.MergeNodes(a, b);
      }
    }
    for (const EdgeId id : graph.Edges())
      if (graph.edge(id).points.size() > 2 && Chance(0.1))
        graph.SplitEdge(id, Integer(1, static_cast<int>(graph.edge(id).points.size()) - 2));
    return graph;
  }

  void AddCurve(const Polyline& points, SkeletonGraph& graph) {
    const EdgeId id = graph.AddPolyline(points);
    if (Chance(0.7)) return;
    std::vector<double> radii, observations;
    for (size_t i = 0; i < points.size(); ++i) {
      radii.push_back(Real(0.001, 0.003));
      observations.push_back(Integer(0, 9));
    }
    graph.SetCurve(id, points, radii, observations);
  }

  std::mt19937_64 random_;
  int size_;
  double threshold_ = kThreshold;
  std::vector<Polyline> curves_;
};

}  // namespace

RandomNetwork MakeRandomNetwork(uint64_t seed, int size) { return NetworkMaker(seed, size).Make(); }

SkeletonGraph Shuffled(const SkeletonGraph& graph, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<NodeId> nodes = graph.Nodes();
  std::vector<EdgeId> edges = graph.Edges();
  std::shuffle(nodes.begin(), nodes.end(), random);
  std::shuffle(edges.begin(), edges.end(), random);
  SkeletonGraph shuffled;
  std::vector<NodeId> new_nodes(nodes.empty() ? 0
                                              : 1 + *std::max_element(nodes.begin(), nodes.end()));
  for (const NodeId node : nodes) new_nodes[node] = shuffled.AddNode(graph.position(node));
  for (const EdgeId id : edges) {
    SkeletonEdge edge = graph.edge(id);
    for (NodeId& node : edge.nodes) node = new_nodes[node];
    if (random() % 2 == 0) Reverse(edge);
    shuffled.AddEdge(std::move(edge));
  }
  return shuffled;
}

}  // namespace curvefusion
