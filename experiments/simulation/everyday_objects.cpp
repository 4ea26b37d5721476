// Objects of other shapes than the paper's: how far does what was chosen on those carry?
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "experiments/simulation/curve_shapes.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
using Curves = std::vector<WireCurve>;

// Four legs that lean, a round seat with twelve spokes, a ring between the legs.
Curves Stool() {
  constexpr double kHeight = 360, kSeat = 110, kFoot = 160, kRing = 150;
  Curves curves = {Loop(CirclePoints(kSeat, kHeight), 6),
                   Loop(CirclePoints(kFoot - (kFoot - kSeat) * kRing / kHeight, kRing), 5)};
  for (int i = 0; i < 4; ++i) {
    const double angle = kPi / 4 + kPi / 2 * i;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    curves.push_back(Wire({kFoot * out, kSeat * out + Vec3(0, 0, kHeight)}, 8));
  }
  for (const Vec3& rim : CirclePoints(kSeat, kHeight, 12))
    curves.push_back(Wire({{0, 0, kHeight}, rim}, 4.5));
  return curves;
}

Polyline Ellipse(double half_width_mm, double z_mm, int count) {
  Polyline points = CirclePoints(half_width_mm, z_mm, count);
  for (Vec3& p : points) p.y() *= 0.7;
  return points;
}

// An oval basket of 24 uprights and three rims, with a handle.
Curves Basket() {
  constexpr int kUprights = 24, kPoints = 8 * kUprights;
  constexpr double kTop = 170, kMiddle = 145, kBottom = 120, kHeight = 200, kHandle = 140;
  Curves curves = {Loop(Ellipse(kTop, kHeight, kPoints), 6), Loop(Ellipse(kBottom, 0, kPoints), 5),
                   Loop(Ellipse(kMiddle, kHeight / 2, kPoints), 4.5)};
  const Polyline top = Ellipse(kTop, kHeight, kUprights);
  const Polyline middle = Ellipse(kMiddle, kHeight / 2, kUprights);
  const Polyline bottom = Ellipse(kBottom, 0, kUprights);
  for (int i = 0; i < kUprights; ++i) curves.push_back(Wire({top[i], middle[i], bottom[i]}, 4.5));
  Polyline handle;
  for (const double t : Linspace(0, kPi, 60))
    handle.emplace_back(kTop * std::cos(t), 0, kHeight + kHandle * std::sin(t));
  curves.push_back(Wire(handle, 7));
  return curves;
}

// Four posts and three boards of eight wires each.
Curves Shelf() {
  constexpr double kX = 170, kY = 100, kHeight = 400;
  constexpr int kWires = 8;
  Curves curves;
  for (const double x : {-kX, kX})
    for (const double y : {-kY, kY}) curves.push_back(Wire({{x, y, 0}, {x, y, kHeight}}, 8));
  for (const double z : {80, 220, 360}) {
    curves.push_back(Loop({{-kX, -kY, z}, {kX, -kY, z}, {kX, kY, z}, {-kX, kY, z}}, 6));
    for (int i = 1; i <= kWires; ++i) {
      const double x = -kX + 2 * kX * i / (kWires + 1);
      curves.push_back(Wire({{x, -kY, z}, {x, kY, z}}, 5));
    }
  }
  return curves;
}

// Two bent rails and nine rungs.
Curves Ladder() {
  constexpr int kRungs = 9, kPerRung = 6;
  const auto rail = [](int side, double t) {
    return Vec3(80 * side + 20 * std::sin(6 * t), 50 * std::sin(4 * t), 420 * t);
  };
  Curves curves;
  for (const int side : {-1, 1}) {
    Polyline points;
    for (const double t : Linspace(0, 1, kPerRung * (kRungs + 1) + 1))
      points.push_back(rail(side, t));
    curves.push_back(Wire(points, 8));
  }
  for (int k = 1; k <= kRungs; ++k) {
    const double t = static_cast<double>(k) / (kRungs + 1);
    curves.push_back(Wire({rail(-1, t), rail(1, t)}, 5));
  }
  return curves;
}

// The edges of an icosahedron: twelve junctions of five wires.
Curves Dome() {
  constexpr double kRadius = 150, kMiddle = 180;
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> corners;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden})
      for (const Vec3& corner : {Vec3(0, a, b), Vec3(a, b, 0), Vec3(b, 0, a)})
        corners.push_back(corner);
  Curves curves;
  const auto place = [&](const Vec3& corner) -> Vec3 {
    return kRadius * corner.normalized() + Vec3(0, 0, kMiddle);
  };
  for (size_t i = 0; i < corners.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if ((corners[i] - corners[j]).norm() < 2.1)  // edges are 2 long
        curves.push_back(Wire({place(corners[i]), place(corners[j])}, 5));
  return curves;
}

// Eight turns, 40 mm apart.
Curves Spring() {
  constexpr double kRadius = 60, kPitch = 40, kTurns = 8;
  Polyline points;
  for (const double t : Linspace(0, kTurns, 801))
    points.emplace_back(kRadius * std::cos(2 * kPi * t), kRadius * std::sin(2 * kPi * t),
                        50 + kPitch * t);
  return {Wire(points, 5)};
}

// A trefoil: a closed wire without a junction, which crosses itself in every image.
Curves Knot() {
  constexpr double kSize = 55;
  constexpr int kPoints = 400;
  Polyline points;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2 * kPi * i / kPoints;
    points.push_back(kSize * Vec3(std::sin(t) + 2 * std::sin(2 * t), -std::sin(3 * t),
                                  std::cos(t) - 2 * std::cos(2 * t)) +
                     Vec3(0, 0, 200));
  }
  return {Loop(points, 6)};
}

// A post on three feet with six hooks, all of which end freely.
Curves CoatStand() {
  Curves curves = {Wire({{0, 0, 0}, {0, 0, 420}}, 12)};
  const auto arm = [](double angle, double reach, double height) {
    return Vec3(reach * std::cos(angle), reach * std::sin(angle), height);
  };
  for (int i = 0; i < 3; ++i) {
    Polyline foot;
    for (const double t : Linspace(0, 1, 20))
      foot.push_back(arm(2 * kPi * i / 3 + 0.3, 160 * t, 60 * (1 - t) * (1 - t)));
    curves.push_back(Wire(foot, 8));
  }
  const std::vector<double> heights = {240, 330, 400};
  for (size_t k = 0; k < heights.size(); ++k) {
    for (const double side : {0.0, kPi}) {
      Polyline hook;
      for (const double t : Linspace(0, 1, 24))
        hook.push_back(arm(side + static_cast<double>(k), 100 * t,
                           heights[k] - 20 * std::sin(kPi * t) + 30 * t * t * t));
      curves.push_back(Wire(hook, 5));
    }
  }
  return curves;
}

}  // namespace

bool MakeEverydayObject(const std::string& name, std::vector<WireCurve>& curves) {
  const std::map<std::string, std::function<Curves()>> makers = {
      {"stool", Stool}, {"basket", Basket}, {"shelf", Shelf}, {"ladder", Ladder},
      {"dome", Dome},   {"spring", Spring}, {"knot", Knot},   {"coat_stand", CoatStand}};
  const auto maker = makers.find(name);
  if (maker == makers.end()) return false;
  curves = maker->second();
  return true;
}

}  // namespace curvefusion
