// Families of straight and bent bars: racks, furniture legs, trusses, umbrellas, wheels.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/families/family_makers.h"
#include "experiments/simulation/families/wire_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

Vec3 OnCircle(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// A circle whose vertices include those at multiples of a turn / count.
Polyline Circle(double radius, double z, int count, double phase = 0) {
  const int vertices = count * std::max(1, static_cast<int>(std::ceil(48.0 / count)));
  Polyline points;
  for (int i = 0; i < vertices; ++i) {
    points.push_back(OnCircle(radius, phase + 2 * kPi * i / vertices, z));
  }
  return points;
}

}  // namespace

// Two rails with a row of hoops across, and feet; the hoops' tops joined or free.
void MakeRack(Random& random, WireAssembly& wires) {
  const double thin = random.LogUniform(2.5, 6), thick = random.LogUniform(std::max(thin, 4.0), 11);
  const double spacing = random.LogUniform(std::max({8.0, 2 * thin, 10.0}), 45);
  const double width = random.LogUniform(90, 300), high = random.LogUniform(40, 200);
  const int hoops = std::clamp(static_cast<int>(random.LogUniform(160, 550) / spacing), 3, 24);
  const double length = (hoops + 1) * spacing, lean = random.Uniform(-0.3, 0.3);
  const double round = random.Uniform(0.15, 0.5);  // from box-like to an arch
  int rails[2];
  for (const int side : {0, 1}) {
    const double y = (side - 0.5) * width;
    rails[side] = wires.Add(Straight({-length / 2, y, 0}, {length / 2, y, 0}), thick);
  }
  for (const double x : {-length / 2, length / 2}) {
    wires.Add(
        SmoothThrough(
            {{x, -width / 2, 0}, {x, -width / 4, -10}, {x, width / 4, -10}, {x, width / 2, 0}}),
        thick);
  }
  const bool ridge = random.Chance(0.4);
  Polyline tops;
  for (int i = 1; i <= hoops; ++i) {
    const double x = -length / 2 + i * spacing;
    const auto at = [&](double across, double up) -> Vec3 {
      return {x + lean * high * up, across * width, high * up};
    };
    const Vec3 left = wires.VertexNear(rails[0], at(-0.5, 0));
    const Vec3 right = wires.VertexNear(rails[1], at(0.5, 0));
    tops.push_back(at(0, 1));
    wires.Add(SmoothThrough({left, at(-0.47, 1 - round), at(-0.5 + round, 0.98), tops.back(),
                             at(0.5 - round, 0.98), at(0.47, 1 - round), right}),
              thin);
  }
  if (ridge) wires.Add(tops, thin);
  const double feet = random.Uniform(20, 60);
  for (const int rail : rails) {
    for (const double share : {0.0, 1.0}) {
      const Vec3 top = wires.VertexAt(rail, share);
      wires.Add(Straight(top, top - Vec3(0, 0, feet)), thick);
    }
  }
}

// A table's ring on legs of bent rods, with a ring or a cross between them.
void MakeLegs(Random& random, WireAssembly& wires) {
  const double rod = random.LogUniform(4, 12), brace = random.LogUniform(2.5, rod);
  const double radius = random.LogUniform(80, 260), high = radius * random.Uniform(1.2, 2.6);
  const double flattening = random.Uniform(0.6, 1), splay = random.Uniform(0, 0.35);
  const int legs = random.Integer(3, 4);
  const bool hairpin = random.Chance(0.6);
  const double gap = random.Uniform(0.12, 0.3);  // radians from a leg's middle to its ends
  const int top = wires.AddLoop(Circle(radius, high, 4 * legs), rod);
  const double knee_at = random.Uniform(0.25, 0.45);
  Polyline knees;
  for (int i = 0; i < legs; ++i) {
    const double angle = 2 * kPi * (i + 0.5) / legs;
    const Vec3 foot = OnCircle(radius * (1 + splay), angle, 0);
    if (hairpin) {
      const Vec3 left = wires.VertexNear(top, OnCircle(radius, angle - gap, high));
      const Vec3 right = wires.VertexNear(top, OnCircle(radius, angle + gap, high));
      const Vec3 side = 6 * (right - left).normalized();
      wires.Add(SmoothThrough({left, left + 0.95 * (foot - side - left), foot,
                               right + 0.95 * (foot + side - right), right}),
                rod);
    } else {
      const Vec3 left = wires.VertexNear(top, OnCircle(radius, angle, high));
      const int leg = wires.Add(
          SmoothThrough(
              {left, left + 0.5 * (foot - left) + OnCircle(0.12 * radius, angle, 0), foot}),
          rod);
      knees.push_back(wires.VertexAt(leg, 1 - knee_at));
    }
  }
  if (!knees.empty() && random.Chance(0.5)) {
    const Vec3 middle(0, 0, knees.front().z());
    for (const Vec3& knee : knees) wires.Add(Straight(knee, middle), brace);
  } else if (knees.size() > 2) {
    for (size_t i = 0; i < knees.size(); ++i) {
      wires.Add(Straight(knees[i], knees[(i + 1) % knees.size()]), brace);
    }
  }
  const int bars = random.Integer(0, 3);  // under the table's top
  for (int i = 0; i < bars; ++i) {
    const double y = radius * (i + 1 - (bars + 1) / 2.0) / (bars + 1);
    const double x = std::sqrt(radius * radius - y * y);
    const Vec3 left = wires.VertexNear(top, {-x, y, high});
    const Vec3 right = wires.VertexNear(top, {x, y, high});
    wires.Add(Straight(left, right), brace);
  }
  wires.Warp([&](const Vec3& p) { return Vec3(p.x(), flattening * p.y(), p.z()); });
}

// A beam of three or four chords with struts and diagonals, straight or bent to an arch.
void MakeTruss(Random& random, WireAssembly& wires) {
  const double chord = random.LogUniform(3.5, 10), strut = random.LogUniform(2.5, chord);
  const int sides = random.Integer(3, 4), bays = random.Integer(3, 8);
  const double bay = random.LogUniform(45, 110), wide = bay * random.Uniform(0.7, 1.2);
  const double slim = random.Uniform(0.6, 1);  // of the far end
  const double length = bays * bay;
  const auto at = [&](int side, int k) -> Vec3 {
    const double angle = 2 * kPi * (side % sides + 0.5) / sides;
    const double r = wide / 2 * (1 + (slim - 1) * k / bays);
    return {k * bay - length / 2, r * std::cos(angle), r * std::sin(angle)};
  };
  for (int side = 0; side < sides; ++side) {
    Polyline line;
    for (int k = 0; k <= bays; ++k) line.push_back(at(side, k));
    wires.Add(line, chord);
    for (int k = 0; k <= bays; ++k) wires.Add({at(side, k), at(side + 1, k)}, strut);
    for (int k = 0; k < bays; ++k) {
      const bool rising = (k + side) % 2 == 0;
      wires.Add({at(side + (rising ? 0 : 1), k), at(side + (rising ? 1 : 0), k + 1)}, strut);
    }
  }
  const double bend = random.Chance(0.5) ? random.Uniform(0, 1.2) / length : 0;
  const double tilt = random.Chance(0.4) ? kPi / 2 : random.Uniform(0, 0.3);
  wires.Warp([&](const Vec3& p) -> Vec3 {
    const double angle = bend * p.x();
    const double x = bend == 0 ? p.x() : (1 / bend - p.z()) * std::sin(angle);
    const double z = bend == 0 ? p.z() : 1 / bend - (1 / bend - p.z()) * std::cos(angle);
    return {x * std::cos(tilt) - z * std::sin(tilt), p.y(),
            x * std::sin(tilt) + z * std::cos(tilt)};
  });
}

// Ribs that taper from a hub, stretchers from a second hub on the shaft, a handle.
void MakeUmbrella(Random& random, WireAssembly& wires) {
  const int ribs = random.Integer(7, 10);  // hubs of valence 8 to 12
  const double radius = random.LogUniform(110, 420), drop = radius * random.Uniform(0.25, 0.6);
  const double shaft = random.LogUniform(5, 11), rib = random.LogUniform(3.2, 6);
  const double tip = random.Uniform(2.5, rib), stretcher = random.LogUniform(2.5, 5);
  const double below = radius * random.Uniform(0.9, 1.6), runner = -drop * random.Uniform(0.9, 1.3);
  const double joint = random.Uniform(0.4, 0.6);
  const double ferrule = random.Uniform(15, 40), hook = random.Uniform(0.06, 0.12) * radius + 8;
  Polyline stick = {{0, 0, ferrule}};
  for (const Vec3& p : Straight({0, 0, 0}, {0, 0, -below})) stick.push_back(p);
  for (int i = 1; i <= 16; ++i) {
    const double angle = kPi * i / 16;
    stick.emplace_back(hook * (1 - std::cos(angle)), 0, -below - hook * std::sin(angle));
  }
  const int pole = wires.Add(stick, shaft);
  const Vec3 hub = wires.VertexNear(pole, {0, 0, runner});
  const double phase = random.Uniform(0, 1);
  for (int i = 0; i < ribs; ++i) {
    const double angle = 2 * kPi * (i + phase) / ribs;
    Polyline points;
    for (int k = 0; k <= 24; ++k) {
      const double t = k / 24.0;
      points.push_back(OnCircle(radius * t, angle, -drop * t * t));
    }
    points.front() = Vec3::Zero();
    const int wire = wires.AddTapered(points, rib, tip);
    wires.Add(Straight(hub, wires.VertexAt(wire, joint)), stretcher);
  }
  if (random.Chance(0.3)) {  // opened to some degree only
    const double closing = random.Uniform(0.1, 0.35);
    wires.Warp([&](const Vec3& p) -> Vec3 {
      const double out = p.head<2>().norm() / radius;
      return {p.x() * (1 - closing * out), p.y() * (1 - closing * out),
              p.z() - closing * radius * out * out};
    });
  }
}

// A rim on two flanges whose spokes lean against each other and cross without touching.
void MakeWheel(Random& random, WireAssembly& wires) {
  const double rim = random.LogUniform(4, 12), spoke = random.LogUniform(2.5, 4.5);
  const double radius = random.LogUniform(90, 320);
  const double flange = std::max(random.Uniform(0.12, 0.22) * radius, 16.0);
  const double wide = std::max(random.Uniform(0.1, 0.3) * radius, 18.0);  // half, at the hub
  const int most = static_cast<int>(2 * kPi * flange / std::max(9.0, 2.2 * spoke));
  const int spokes = std::min(random.Integer(8, 18), most);  // of each side
  const double lean = random.Uniform(0.2, 0.9);              // radians along the flange
  wires.AddLoop(Circle(radius, 0, 2 * spokes), rim);
  const int axle = wires.Add(Straight({0, 0, -wide}, {0, 0, wide}), random.Uniform(5, 12));
  for (const int side : {-1, 1}) {
    wires.AddLoop(Circle(flange, side * wide, spokes), std::min(rim, 6.0));
    for (int i = 0; i < spokes; ++i) {
      const Vec3 inner = OnCircle(flange, 2 * kPi * i / spokes, side * wide);
      const int steps = static_cast<int>(std::lround(lean * spokes / (2 * kPi))) * side;
      // Each side's spokes end between the other's.
      const double at = 2 * (i + steps) + (side > 0 ? 1 : 0);
      wires.Add({inner, OnCircle(radius, 2 * kPi * at / (2 * spokes), 0)}, spoke);
    }
    for (int i = 0; i < 3; ++i) {
      const int at = i * spokes / 3;
      wires.Add({wires.VertexAt(axle, side > 0 ? 1 : 0),
                 OnCircle(flange, 2 * kPi * at / spokes, side * wide)},
                spoke);
    }
  }
  if (random.Chance(0.5)) {  // stands on edge, turned by some angle
    const double turn = random.Uniform(-0.6, 0.6);
    wires.Warp([&](const Vec3& p) -> Vec3 {
      return {p.x() * std::cos(turn) + p.z() * std::sin(turn),
              p.z() * std::cos(turn) - p.x() * std::sin(turn), p.y()};
    });
  }
}

}  // namespace curvefusion
