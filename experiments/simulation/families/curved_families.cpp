// Families of bent wires: scrolls, springs, knots and chains.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/families/family_makers.h"
#include "experiments/simulation/families/wire_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

// A spiral, a bow and a spiral: C-shaped or, where the bow changes its side, S-shaped. Spirals keep
// `gap` between their windings; lengths in units of the outer radius.
Polyline Scroll(Random& random, double inner, double gap) {
  const double turns[2] = {random.Uniform(0.6, 1.4), random.Uniform(0.6, 1.4)};
  const double outer[2] = {inner + gap * turns[0] + 12, inner + gap * turns[1] + 12};
  const double sense = random.Chance(0.5) ? 1 : -1;
  const auto spiral_length = [&](int end) { return kPi * turns[end] * (inner + outer[end]); };
  const double first = spiral_length(0), last = spiral_length(1);
  const double bow = (outer[0] + outer[1]) * random.Uniform(1.6, 2.6);
  const auto radius = [&](int end, double s) {  // at a length from its inner end
    const double growth = (outer[end] * outer[end] - inner * inner) / spiral_length(end);
    return std::sqrt(inner * inner + growth * s);
  };
  return PlaneCurve(first + bow + last, [&](double s) {
    if (s < first) return 1 / radius(0, s);
    if (s > first + bow) return sense / radius(1, first + bow + last - s);
    const double t = (s - first) / bow;
    const double flat = sense > 0 ? 1 - 0.8 * std::sin(kPi * t) : 1;
    return flat * ((1 - t) / outer[0] + sense * t / outer[1]);
  });
}

// Turned, mirrored and scaled into a rectangle of the xz plane.
Polyline FittedTo(Polyline points, const Eigen::AlignedBox2d& cell, double turn, bool mirrored) {
  Eigen::AlignedBox2d bounds;
  for (Vec3& p : points) {
    const double x = mirrored ? -p.x() : p.x();
    p = Vec3(x * std::cos(turn) - p.y() * std::sin(turn), 0,
             x * std::sin(turn) + p.y() * std::cos(turn));
    bounds.extend(Vec2(p.x(), p.z()));
  }
  const double scale = (cell.sizes().array() / bounds.sizes().array()).minCoeff();
  for (Vec3& p : points) {
    const Vec2 q = cell.center() + scale * (Vec2(p.x(), p.z()) - bounds.center());
    p = Vec3(q.x(), 0, q.y());
  }
  return points;
}

// The point of a curve that lies farthest in a direction.
Vec3 Extreme(const Polyline& points, const Vec3& direction) {
  return *std::max_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) {
    return a.dot(direction) < b.dot(direction);
  });
}

// A scroll whose windings keep apart, and whose collars keep apart from those that hold bars. Where
// the cell is too small for its wire they come nearer, step by step.
Polyline FittedScroll(Random& random, const Eigen::AlignedBox2d& cell, double diameter,
                      const std::vector<Vec3>& held) {
  constexpr int kAttempts = 1000;  // chosen: more than any cell needs that has room
  double gap = std::max(8.0, 2.2 * diameter);
  for (int attempt = 1;; ++attempt) {
    if (attempt % kAttempts == 0) gap *= 0.9;
    const double turn = kPi / 2 * random.Integer(0, 3) + random.Uniform(-0.4, 0.4);
    const Polyline scroll =
        FittedTo(Scroll(random, 9, random.Uniform(14, 24)), cell, turn, random.Chance(0.5));
    const bool crowded = std::any_of(held.begin(), held.end(), [&](const Vec3& other) {
      const auto near = [&](double side) {
        return std::abs(Extreme(scroll, Vec3(side, 0, 0)).z() - other.z()) < 2 * gap;
      };
      return near(-1) || near(1);
    });
    if (!crowded && SelfDistance(scroll, 40, false) >= gap) return scroll;
  }
}

Polyline TorusKnot(int around, int through, double thick) {
  const int count = 120 * std::max(around, through);
  Polyline points;
  for (int i = 0; i < count; ++i) {
    const double t = 2 * kPi * i / count;
    const double r = 1 + thick * std::cos(through * t);
    points.emplace_back(r * std::cos(around * t), r * std::sin(around * t),
                        thick * std::sin(through * t));
  }
  return points;
}

Polyline FigureEight() {
  constexpr int kCount = 360;
  Polyline points;
  for (int i = 0; i < kCount; ++i) {
    const double t = 2 * kPi * i / kCount, r = 2 + std::cos(2 * t);
    points.emplace_back(r * std::cos(3 * t) / 3, r * std::sin(3 * t) / 3, 0.5 * std::sin(4 * t));
  }
  return points;
}

Polyline Closed(Polyline points) {
  const Vec3 first = points.front();
  points.push_back(first);
  return points;
}

// Two to six rings, each through the next.
void AddChain(Random& random, WireAssembly& wires) {
  const int rings = random.Integer(2, 6);
  const double radius = random.LogUniform(45, 150);
  const double pitch = std::min(random.Uniform(1.1, 1.5) * radius, 700.0 / rings);
  const double diameter = std::min(random.LogUniform(3, 10), radius / 6);
  for (int k = 0; k < rings; ++k) {
    const double tilt = (k % 2) * kPi / 2 + random.Uniform(-0.3, 0.3);
    Polyline ring;
    for (int i = 0; i < 96; ++i) {
      const double t = 2 * kPi * i / 96, x = radius * std::cos(t), y = radius * std::sin(t);
      ring.emplace_back(k * pitch + x, y * std::sin(tilt), y * std::cos(tilt));
    }
    wires.AddLoop(ring, diameter);
  }
}

}  // namespace

// Wrought iron: S- and C-scrolls between the bars of a frame, held by collars.
void MakeScrolls(Random& random, WireAssembly& wires) {
  constexpr double kMargin = 14;
  const double bar = random.LogUniform(5, 12), thin = random.LogUniform(2.8, 6.5);
  const int panels = random.Integer(1, 3), storeys = random.Integer(1, 3);
  const double wide = random.LogUniform(130, 250), high = wide * random.Uniform(0.9, 1.5);
  const double width = panels * wide, height = std::min(storeys * high, 800.0);
  std::vector<int> bars;
  for (int k = 0; k <= panels; ++k) {
    const double x = k * wide - width / 2;
    bars.push_back(wires.Add(Straight({x, 0, 0}, {x, 0, height}), bar));
  }
  int across[2];
  for (const int end : {0, 1}) {
    Polyline line;
    for (int k = 0; k <= panels; ++k) line.emplace_back(k * wide - width / 2, 0, end * height);
    across[end] = wires.Add(line, bar);
  }
  std::vector<Vec3> held;  // where collars hold the bars
  for (int panel = 0; panel < panels; ++panel) {
    for (int storey = 0; storey < storeys; ++storey) {
      const Vec2 low(panel * wide - width / 2, height * storey / storeys);
      const Eigen::AlignedBox2d cell(low + Vec2::Constant(kMargin),
                                     low + Vec2(wide, height / storeys) - Vec2::Constant(kMargin));
      const Polyline scroll = FittedScroll(random, cell, thin, held);
      const Vec3 left = Extreme(scroll, -Vec3::UnitX()), right = Extreme(scroll, Vec3::UnitX());
      const int wire = wires.Add(scroll, thin);
      held.push_back(wires.VertexNear(bars[panel], left));
      wires.Add({held.back(), wires.VertexNear(wire, left)}, thin);
      held.push_back(wires.VertexNear(bars[panel + 1], right));
      wires.Add({wires.VertexNear(wire, right), held.back()}, thin);
      const bool lowest = storey == 0;
      if (!lowest && storey + 1 != storeys) continue;
      const Vec3 end = Extreme(scroll, Vec3(0, 0, lowest ? -1 : 1));
      if (end.x() < low.x() + 2 * kMargin || end.x() > low.x() + wide - 2 * kMargin) continue;
      wires.Add({wires.VertexNear(wire, end), wires.VertexNear(across[lowest ? 0 : 1], end)}, thin);
    }
  }
  const double bow = random.Uniform(-0.4, 0.4) / std::max(width, height);
  wires.Warp([&](const Vec3& p) { return Vec3(p.x(), bow * p.x() * p.x(), p.z()); });
}

// One to three helices, straight or along an arch, of one radius or a cone, free or between bars.
void MakeSpring(Random& random, WireAssembly& wires) {
  const int springs = random.Integer(1, 3);
  const double diameter = random.LogUniform(2.5, 8);
  const double radius = random.LogUniform(20, 75), cone = random.Uniform(-0.4, 0.3);
  const double pitch = std::max(random.LogUniform(8, 45), 2.2 * diameter);
  const double height = random.LogUniform(160, 420);
  const double turns = std::floor(2 * height / pitch) / 2;  // both ends lie under or over a bar
  const double apart = 2 * radius * (1 + std::max(cone, 0.0)) + diameter + random.Uniform(12, 60);
  const double arch = springs == 1 && random.Chance(0.5) ? random.Uniform(0.5, 2.2) / height : 0;
  const bool framed = random.Chance(0.4) && arch == 0;
  const double bar = random.LogUniform(4, 10), length = (springs - 1) * apart + 2 * radius + 60;
  int bars[2] = {0, 0};
  for (const int end : {0, 1}) {
    if (!framed) break;
    const double z = end == 0 ? -15 : height + 15;
    bars[end] = wires.Add(Straight({-length / 2, 0, z}, {length / 2, 0, z}), bar);
  }
  for (int k = 0; k < springs; ++k) {
    const double x = (k - (springs - 1) / 2.0) * apart;
    const auto at = [&](double t) -> Vec3 {
      const double r = radius * (1 + cone * t), angle = 2 * kPi * turns * t;
      return {x + r * std::cos(angle), r * std::sin(angle), height * t};
    };
    Polyline points;
    const int steps = static_cast<int>(std::ceil(turns * 36));
    for (int i = 0; i <= steps; ++i) points.push_back(at(static_cast<double>(i) / steps));
    wires.Add(points, diameter);
    if (!framed) continue;
    wires.Add({points.front(), wires.VertexNear(bars[0], points.front())}, diameter);
    wires.Add({points.back(), wires.VertexNear(bars[1], points.back())}, diameter);
  }
  if (arch == 0) return;
  wires.Warp([&](const Vec3& p) -> Vec3 {
    const double angle = arch * p.z();
    return {(p.x() - 1 / arch) * std::cos(angle) + 1 / arch, p.y(),
            (1 / arch - p.x()) * std::sin(angle)};
  });
}

// Closed wires without a junction: torus knots, a figure of eight, chains.
void MakeKnot(Random& random, WireAssembly& wires) {
  const int kind = random.Integer(0, 6);
  if (kind == 6) return AddChain(random, wires);
  static constexpr int kTurns[5][2] = {{2, 3}, {3, 2}, {2, 5}, {3, 4}, {2, 7}};
  Polyline points = kind == 5
                        ? FigureEight()
                        : TorusKnot(kTurns[kind][0], kTurns[kind][1], random.Uniform(0.35, 0.55));
  const Vec3 stretch(1, random.Uniform(0.8, 1.2), random.Uniform(0.9, 1.5));
  const double turn = random.Uniform(0, kPi), tilt = random.Uniform(0, kPi / 2);
  Eigen::AlignedBox3d bounds;
  for (Vec3& p : points) {
    p = Eigen::AngleAxisd(turn, Vec3::UnitZ()) *
        (Eigen::AngleAxisd(tilt, Vec3::UnitX()) * p.cwiseProduct(stretch));
    bounds.extend(p);
  }
  const double diameter = random.LogUniform(3, 10);
  const double size = bounds.sizes().maxCoeff();
  const double distance = SelfDistance(Closed(points), 0.25 * size, true);
  const double least = std::max(8.0, 1.5 * diameter) / distance;
  const double scale = std::max(random.LogUniform(160, 450) / size, least);
  for (Vec3& p : points) p *= scale;
  wires.AddLoop(points, diameter);
}

}  // namespace curvefusion
