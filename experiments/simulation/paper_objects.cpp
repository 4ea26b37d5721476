// Analogues of the paper's eight objects. Junctions, cycles and lengths are checked in
// tests/experiments/objects_test.cpp.
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "experiments/simulation/curve_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
using Curves = std::vector<WireCurve>;

// (x, y, z) -> (x, z, y) and (y', x, y): a flat drawing stood up in the xz or yz plane.
Polyline InXzPlane(Polyline points) {
  for (Vec3& p : points) p = Vec3(p.x(), 0, p.y());
  return points;
}
Polyline InYzPlane(Polyline points, double x_mm) {
  for (Vec3& p : points) p = Vec3(x_mm, p.x(), p.y());
  return points;
}
Polyline Shifted(Polyline points, const Vec3& shift) {
  for (Vec3& p : points) p += shift;
  return points;
}

Curves DishRack() {
  Curves curves = {Loop(RoundedRectangle(400, 280, 25), 9)};
  constexpr double kHeight = 110, kHalfWidth = 140, kBend = 40;
  for (int i = 0; i < 7; ++i) {
    const double x = -165 + 55 * i;
    Polyline arch = {{x, -kHalfWidth, 0}, {x, -kHalfWidth, kHeight - kBend}};
    for (const double t : Linspace(0, kPi / 2, 8)) {
      arch.emplace_back(x, -kHalfWidth + kBend - kBend * std::cos(t),
                        kHeight - kBend + kBend * std::sin(t));
    }
    for (const double t : Linspace(0, kPi / 2, 8)) {
      arch.emplace_back(x, kHalfWidth - kBend + kBend * std::sin(t),
                        kHeight - kBend + kBend * std::cos(t));
    }
    arch.emplace_back(x, kHalfWidth, 0);
    curves.push_back(Wire(arch, 5));
  }
  return curves;
}

Curves BirdCage() {
  const std::vector<double> heights = {0, 80, 160, 235, 300};
  const std::vector<double> radii = {110, 110, 110, 95, 38};
  Curves curves;
  for (size_t k = 0; k < heights.size(); ++k) {
    curves.push_back(Loop(CirclePoints(radii[k], heights[k]), 4.5));
  }
  for (int i = 0; i < 10; ++i) {
    const double angle = 2 * kPi * i / 10;
    Polyline bar;
    for (size_t k = 0; k < heights.size(); ++k) {
      bar.emplace_back(radii[k] * std::cos(angle), radii[k] * std::sin(angle), heights[k]);
    }
    curves.push_back(Wire(bar, 4.5));
  }
  return curves;
}

Curves Cat() {
  const std::vector<Vec2> knots = {
      {-110, 0}, {-115, 60}, {-95, 110}, {-60, 125}, {0, 118},   {45, 125},  {60, 165},
      {72, 200}, {88, 172},  {112, 172}, {128, 200}, {138, 160}, {130, 125}, {105, 105},
      {100, 60}, {105, 0},   {80, 0},    {72, 50},   {0, 62},    {-70, 50},  {-82, 0}};
  constexpr int kPoints = 400, kRungs = 11;
  const Polyline outline = InXzPlane(PeriodicSpline(knots, kPoints));
  const Polyline left = Shifted(outline, {0, -30, 0});
  const Polyline right = Shifted(outline, {0, 30, 0});
  Curves curves = {Loop(left, 6), Loop(right, 6)};
  for (int i = 0; i < kRungs; ++i) {
    const int k = static_cast<int>((i + 0.5) / kRungs * kPoints);
    curves.push_back(Wire({left[k], right[k]}, 4.5));
  }
  return curves;
}

Curves Decoration() {
  Curves curves = {Loop(CirclePoints(150, 0), 5.5), Loop(CirclePoints(50, 30), 5.5)};
  for (int i = 0; i < 7; ++i) {
    Polyline arm;
    for (const double s : Linspace(0, 1, 40)) {
      const double radius = 50 + 100 * s;
      const double angle = 2 * kPi * i / 7 + 0.7 * std::sin(kPi * s);
      arm.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                       30 * (1 - s) + 25 * std::sin(kPi * s));
    }
    curves.push_back(Wire(arm, 5.5));
  }
  return curves;
}

Curves LargeHanger() {
  Curves curves = {Loop(InXzPlane(RoundedRectangle(520, 400, 30)), 12)};
  for (int i = 0; i < 15; ++i) {
    Polyline bar;
    const double side = i % 2 == 1 ? 45 : -45;
    for (const double z : Linspace(-200, 200, 41)) {
      bar.emplace_back(-210 + 30 * i, side * std::sin(kPi * (z + 200) / 400), z);
    }
    curves.push_back(Wire(bar, 4));
  }
  return curves;
}

Curves Rack() {
  Curves curves;
  for (const double x : {-175.0, 175.0}) {
    curves.push_back(Loop(InYzPlane(RoundedRectangle(220, 320, 25), x), 11));
  }
  for (const double z : {-160.0, 160.0}) {
    for (int i = 0; i < 8; ++i) {
      const double y = -77 + 22 * i;
      curves.push_back(Wire({{-175, y, z}, {0, y, z - 8}, {175, y, z}}, 5.5));
    }
  }
  return curves;
}

// The seat and back of the chair as one bent sheet: u in [-1, 1] across, v in [0, 800] mm along.
Vec3 ChairSheet(double u, double v) {
  constexpr double kSeat = 370, kBend = 110, kBendRadius = 70;
  double y = -v;
  double z = -0.04 * v;
  if (v >= kSeat) {
    const double angle = std::min(v - kSeat, kBend) / kBendRadius;
    const double beyond = std::max(v - kSeat - kBend, 0.0);
    y = -kSeat - kBendRadius * std::sin(angle) + beyond * std::cos(angle);
    z = -15 + kBendRadius * (1 - std::cos(angle)) + beyond * std::sin(angle);
  }
  return {200 * u, y, z + 25 * u * u};
}

Curves Chair() {
  Curves curves;
  for (int i = 0; i < 16; ++i) {
    Polyline along;
    for (const double v : Linspace(0, 800, 161)) along.push_back(ChairSheet(-1 + 2 * i / 15.0, v));
    curves.push_back(Wire(along, 4.5));
  }
  for (int j = 0; j < 21; ++j) {
    Polyline across;
    for (const double u : Linspace(-1, 1, 91)) across.push_back(ChairSheet(u, 40 * j));
    curves.push_back(Wire(across, 4.5));
  }
  for (const double u : {-1.0, 1.0}) {
    const Vec3 front = ChairSheet(u, 0);
    const Vec3 back = ChairSheet(u, 800);
    curves.push_back(Wire({front, {front.x() * 1.1, front.y() + 40, -320}}, 12));
    curves.push_back(Wire({back, {back.x() * 1.25, back.y() - 140, -320}}, 12));
  }
  // The drawing has the back in front: turn the seat to the viewer.
  for (WireCurve& curve : curves) {
    for (Vec3& p : curve.points) p = Vec3(-p.x(), -p.y(), p.z());
  }
  return curves;
}

Curves WineRack() {
  Curves curves;
  std::vector<Polyline> sides;
  for (const double y : {-75.0, 75.0}) {
    Polyline side;
    for (int k = 0; k < 720; ++k) {
      const double angle = 2 * kPi * k / 720;
      const double radius = 150 + 22 * std::cos(6 * angle);
      side.emplace_back(radius * std::cos(angle) * 0.9, y, radius * std::sin(angle) * 1.1);
    }
    curves.push_back(Loop(side, 6));
    sides.push_back(side);
  }
  for (int i = 0; i < 6; ++i) {
    const int k = static_cast<int>((i + 0.5) * 120);
    const Vec3 middle = (sides[0][k] + sides[1][k]).cwiseProduct(Vec3(0.93, 1, 0.93)) / 2;
    curves.push_back(Wire({sides[0][k], middle, sides[1][k]}, 6));
  }
  return curves;
}

}  // namespace

bool MakePaperObject(const std::string& name, std::vector<WireCurve>& curves) {
  const std::map<std::string, std::function<Curves()>> makers = {
      {"dish", DishRack}, {"cage", BirdCage},      {"cat", Cat},     {"deco", Decoration},
      {"rack", Rack},     {"hanger", LargeHanger}, {"chair", Chair}, {"wine", WineRack}};
  const auto maker = makers.find(name);
  if (maker == makers.end()) return false;
  curves = maker->second();
  return true;
}

}  // namespace curvefusion
