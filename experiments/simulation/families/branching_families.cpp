// Families that grow: trees, vines, stands. Every wire is curved, most taper, tips are free.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/families/family_makers.h"
#include "experiments/simulation/families/wire_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kThinnest = 2.5;
constexpr double kLeastGap = 5;  // mm of air between branches ...
constexpr double kFork = 35;     // ... but within so many mm of where one begins

Vec3 RandomDirection(Random& random) {
  Vec3 v;
  do {
    v = Vec3(random.Normal(), random.Normal(), random.Normal());
  } while (v.norm() < 1e-3);
  return v.normalized();
}

// A curve that wanders: its direction turns about an axis that changes on the way, and towards
// `pull`. `bend` in radians over the whole length.
Polyline Wandering(Random& random, const Vec3& start, Vec3 direction, double length, double bend,
                   const Vec3& pull) {
  constexpr double kStep = 6;
  const int steps = std::max(4, static_cast<int>(std::ceil(length / kStep)));
  Vec3 axis = RandomDirection(random);
  Polyline points = {start};
  for (int k = 0; k < steps; ++k) {
    axis = (axis + 0.15 * RandomDirection(random)).normalized();
    direction = (direction + bend / steps * axis.cross(direction) + pull / steps).normalized();
    points.push_back(points.back() + length / steps * direction);
  }
  return points;
}

// A direction that leaves `along` at an angle, towards an azimuth about it.
Vec3 Leaving(const Vec3& along, double angle, double azimuth) {
  const Vec3 side = along.unitOrthogonal();
  const Vec3 across = along.cross(side);
  return std::cos(angle) * along +
         std::sin(angle) * (std::cos(azimuth) * side + std::sin(azimuth) * across);
}

struct Growth {
  int levels = 2;         // of branches
  double shrink = 0.5;    // length of a branch in that of its parent
  double angle = 0.9;     // at which it leaves
  double bend = 1;        // radians along it
  double density = 0.02;  // branches a mm
  Vec3 pull = Vec3(0, 0, 0.4);
  int budget = 40;  // wires at most
};

// Branches of a branch, each only where it keeps clear of all that has grown.
void Branch(Random& random, WireAssembly& wires, int parent, int level, Growth& growth) {
  constexpr int kTries = 8;
  const double length = wires.LengthOf(parent);
  const int count = std::clamp(static_cast<int>(growth.density * length), 3, 9);
  double azimuth = random.Uniform(0, 2 * kPi);
  for (int i = 0; i < count && growth.budget > 0; ++i) {
    const double share = 0.25 + 0.68 * (i + random.Uniform(0.2, 0.8)) / count;
    const double base = wires.DiameterAt(parent, share) * random.Uniform(0.6, 0.9);
    if (base < kThinnest) continue;
    const double long_as = length * growth.shrink * random.Uniform(0.6, 1.1) * (1.2 - 0.5 * share);
    for (int attempt = 0; attempt < kTries; ++attempt) {
      azimuth += 2.4;  // the golden angle
      const Vec3 start = wires.VertexAt(parent, share);
      const Vec3 out = Leaving(wires.DirectionAt(parent, share),
                               growth.angle * random.Uniform(0.7, 1.2), azimuth);
      const Polyline points = Wandering(random, start, out, long_as, growth.bend, growth.pull);
      if (long_as < 30 || wires.Clearance(points, base, kFork) < kLeastGap ||
          wires.Clearance(points, base, 0, parent) < 0) {
        continue;
      }
      const double tip = std::max(kThinnest, base * random.Uniform(0.4, 0.7));
      const int branch = wires.AddTapered(points, base, tip);
      --growth.budget;
      if (level < growth.levels) Branch(random, wires, branch, level + 1, growth);
      break;
    }
  }
}

}  // namespace

// A trunk, branches and twigs.
void MakeTree(Random& random, WireAssembly& wires) {
  const double high = random.LogUniform(170, 560);
  const double base = random.Uniform(6, 12), tip = random.Uniform(2.8, 4);
  Growth growth;
  growth.levels = random.Integer(1, 2);
  growth.shrink = random.Uniform(0.35, 0.6);
  growth.angle = random.Uniform(0.6, 1.1);
  growth.bend = random.Uniform(0.4, 1.4);
  growth.density = random.Uniform(5, 9) / high;
  growth.pull = Vec3(0, 0, random.Uniform(-0.3, 0.8));
  growth.budget = random.Integer(10, 36);
  const Vec3 up = Vec3(random.Uniform(-0.2, 0.2), random.Uniform(-0.2, 0.2), 1).normalized();
  const Polyline trunk =
      Wandering(random, Vec3::Zero(), up, high, random.Uniform(0.2, 0.9), Vec3(0, 0, 0.5));
  Branch(random, wires, wires.AddTapered(trunk, base, tip), 1, growth);
}

// A shoot that winds around a stake, which it touches but is not joined to, with tendrils.
void MakeVine(Random& random, WireAssembly& wires) {
  const int stakes = random.Integer(1, 2);
  const double high = random.LogUniform(220, 650), apart = random.Uniform(160, 280);
  for (int k = 0; k < stakes; ++k) {
    const double stake = random.LogUniform(4, 12), base = random.LogUniform(3.5, 7);
    const double tall = high * random.Uniform(0.8, 1), lean = random.Uniform(-0.06, 0.06);
    const double x = apart * (k - (stakes - 1) / 2.0);
    wires.Add(Straight({x, 0, 0}, {x + lean * tall, 0, tall}), stake);
    const double turns = std::min(random.Uniform(1.5, 6), tall / 45);
    const double wide = (stake + base) / 2 + random.Uniform(0.3, 6);  // from touching to loose
    const double top = tall * random.Uniform(0.7, 0.92), phase = random.Uniform(0, 2 * kPi);
    const int steps = static_cast<int>(turns * 24);
    Polyline shoot;
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps, angle = phase + 2 * kPi * turns * t;
      // It comes from the ground beside the stake, and leaves it at its tip.
      const double start = std::max(0.0, 1 - 8 * t), end = std::max(0.0, 6 * t - 5);
      const double r = wide + 25 * start * start + 30 * end * end;
      shoot.emplace_back(x + lean * top * t + r * std::cos(angle), r * std::sin(angle), top * t);
    }
    const int vine = wires.AddTapered(shoot, base, std::max(kThinnest, 0.6 * base));
    Growth growth;
    growth.levels = random.Integer(1, 2);
    growth.shrink = random.Uniform(0.1, 0.25);
    growth.bend = random.Uniform(1.5, 3.5);  // tendrils curl
    growth.density = random.Uniform(0.006, 0.02);
    growth.budget = random.Integer(5, 14);
    Branch(random, wires, vine, 1, growth);
  }
}

// A post on feet with arms that bend and end freely.
void MakeStand(Random& random, WireAssembly& wires) {
  const double high = random.LogUniform(180, 800), post = random.LogUniform(6, 12);
  const double foot = random.LogUniform(4, post), arm = random.LogUniform(3, 8);
  const int feet = random.Integer(3, 5);
  const double reach = high * random.Uniform(0.15, 0.35), arch = random.Uniform(10, 60);
  const int pole = wires.Add(Straight({0, 0, arch}, {0, 0, high}), post);
  for (int i = 0; i < feet; ++i) {
    const double angle = 2 * kPi * i / feet + 0.3;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const Vec3 start = wires.VertexNear(pole, {0, 0, arch});
    wires.Add(SmoothThrough({start, 0.35 * reach * out + Vec3(0, 0, arch * 1.1),
                             0.8 * reach * out + Vec3(0, 0, 0.3 * arch), reach * out}),
              foot);
  }
  const int arms = random.Integer(3, 10);
  const bool curled = random.Chance(0.5), tapers = random.Chance(0.5);
  double angle = random.Uniform(0, 2 * kPi);
  for (int i = 0; i < arms; ++i) {
    angle += 2.4;
    const double z = high * (0.45 + 0.52 * (i + 0.5) / arms);
    const double wide = high * random.Uniform(0.12, 0.28), up = wide * random.Uniform(-0.1, 0.6);
    const Vec3 out(std::cos(angle), std::sin(angle), 0), start = wires.VertexNear(pole, {0, 0, z});
    Polyline knots = {start, start + 0.4 * wide * out - Vec3(0, 0, 0.15 * wide),
                      start + wide * out + Vec3(0, 0, up)};
    if (curled) {
      knots.push_back(start + 0.75 * wide * out + Vec3(0, 0, up + 0.3 * wide));
      knots.push_back(start + 0.6 * wide * out + Vec3(0, 0, up + 0.1 * wide));
    }
    const Polyline points = SmoothThrough(knots, 4);
    if (wires.Clearance(points, arm, kFork) < kLeastGap) continue;
    wires.AddTapered(points, arm, tapers ? std::max(kThinnest, 0.5 * arm) : arm);
  }
}

}  // namespace curvefusion
