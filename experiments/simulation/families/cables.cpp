// Loose cables: each is laid over those before it, touches where it crosses them, and is joined to
// none but where it is spliced.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/families/family_makers.h"
#include "experiments/simulation/families/wire_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStep = 3;      // mm between vertices
constexpr double kReach = 60;    // mm along a cable by which a crossing lifts it
constexpr double kSlack = 1.12;  // slopes bring axes nearer to each other than heights tell

struct LaidCable {
  Polyline points;  // y is the height above the ground
  double diameter = 0;
};

// A smooth path across a rectangle of the xz plane.
Polyline CablePath(Random& random, double width, double height) {
  const int knots = random.Integer(4, 7);
  const bool upright = random.Chance(0.4);
  Polyline path;
  for (int i = 0; i < knots; ++i) {
    const double along = (static_cast<double>(i) / (knots - 1) - 0.5) * random.Uniform(0.9, 1);
    const double across = random.Uniform(-0.5, 0.5);
    path.emplace_back((upright ? across : along) * width, 0, (upright ? along : across) * height);
  }
  return Resample(SmoothThrough(path, kStep), kStep);
}

// How high a cable's axis must lie at a point to clear one piece below.
double RestOn(const Vec3& p, const Vec3& below, double contact) {
  const double dx = p.x() - below.x(), dz = p.z() - below.z();
  const double squared = contact * contact - dx * dx - dz * dz;
  return squared > 0 ? below.y() + std::sqrt(squared) : 0;
}

// Heights at which the cable lies on what is below it, itself included.
void Lay(LaidCable& cable, const std::vector<LaidCable>& below) {
  const size_t count = cable.points.size();
  std::vector<double> needed(count, 0);
  for (size_t i = 0; i < count; ++i) {
    for (const LaidCable& other : below) {
      const double contact = kSlack * (cable.diameter + other.diameter) / 2;
      for (const Vec3& p : other.points) {
        needed[i] = std::max(needed[i], RestOn(cable.points[i], p, contact));
      }
    }
  }
  const auto spread = [&] {
    for (size_t i = 0; i < count; ++i) {
      double y = cable.diameter / 2;
      const int reach = static_cast<int>(kReach / kStep);
      const int last = std::min(static_cast<int>(count) - 1, static_cast<int>(i) + reach);
      for (int k = std::max(0, static_cast<int>(i) - reach); k <= last; ++k) {
        // Full height where it rests and a little beyond, then down in half a cosine.
        const double away = std::abs(k - static_cast<int>(i)) * kStep;
        const double t = std::clamp((away - kStep) / (kReach - kStep), 0.0, 1.0);
        y = std::max(y, needed[k] * (1 + std::cos(kPi * t)) / 2);
      }
      cable.points[i].y() = y;
    }
  };
  spread();
  const size_t apart = static_cast<size_t>(40 / kStep);  // where it crosses itself, not follows
  for (size_t i = apart; i < count; ++i) {
    for (size_t k = 0; k + apart < i; ++k) {
      needed[i] =
          std::max(needed[i], RestOn(cable.points[i], cable.points[k], kSlack * cable.diameter));
    }
  }
  spread();
}

// How little of a path runs nearly on top of a cable: crossings are short.
bool Crosses(const Polyline& path, const LaidCable& other, double diameter) {
  constexpr double kLongest = 60;  // mm
  const double near = (diameter + other.diameter) / 2;
  int covered = 0;
  for (const Vec3& p : path) {
    covered += std::any_of(other.points.begin(), other.points.end(), [&](const Vec3& q) {
      return std::hypot(p.x() - q.x(), p.z() - q.z()) < near;
    });
  }
  return covered * kStep < kLongest;
}

}  // namespace

void MakeCables(Random& random, WireAssembly& wires) {
  const double width = random.LogUniform(180, 600), height = width * random.Uniform(0.5, 0.9);
  const int count = random.Integer(2, 6);
  std::vector<LaidCable> laid;
  for (int attempt = 0; static_cast<int>(laid.size()) < count && attempt < 60; ++attempt) {
    LaidCable cable{CablePath(random, width, height), random.LogUniform(2.5, 9)};
    const bool free = std::all_of(laid.begin(), laid.end(), [&](const LaidCable& other) {
      return Crosses(cable.points, other, cable.diameter);
    });
    if (!free || SelfDistance(cable.points, 80, false) < 3 * kStep) continue;
    Lay(cable, laid);
    laid.push_back(std::move(cable));
  }
  const int splices = random.Integer(0, 2);
  for (const LaidCable& cable : laid) wires.Add(cable.points, cable.diameter);
  for (int k = 0; k < splices; ++k) {
    const int trunk = random.Integer(0, static_cast<int>(laid.size()) - 1);
    const double share = random.Uniform(0.2, 0.8), length = random.Uniform(50, 140);
    const Vec3 start = wires.VertexAt(trunk, share), along = wires.DirectionAt(trunk, share);
    const Vec3 side = along.cross(Vec3::UnitY()).normalized() * (random.Chance(0.5) ? 1 : -1);
    const double diameter = std::max(2.5, laid[trunk].diameter * random.Uniform(0.6, 1));
    const Polyline branch =
        SmoothThrough({start, start + 0.3 * length * (0.5 * along + side) + Vec3(0, 8, 0),
                       start + length * (0.7 * along + 0.7 * side) + Vec3(0, 20, 0)},
                      kStep);
    if (wires.Clearance(branch, diameter, 25) > 3) wires.Add(branch, diameter);
  }
  const double bulge = random.Uniform(-0.5, 0.5) / width;  // what they lie on
  wires.Warp([&](const Vec3& p) { return Vec3(p.x(), -p.y() + bulge * p.x() * p.x(), p.z()); });
}

}  // namespace curvefusion
