// Objects of the paper's studies, and of those it does not have.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "experiments/simulation/curve_shapes.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
using Curves = std::vector<WireCurve>;

// Four equilateral triangles of 1, 2, 3 and 4 mm wire side by side (the paper's Figure on thickness
// and colour).
Curves Triangles() {
  constexpr double kSide = 110, kPitch = 140;
  Curves curves;
  for (int i = 0; i < 4; ++i) {
    const double x = (i - 1.5) * kPitch;
    curves.push_back(Loop(
        {{x - kSide / 2, 0, 0}, {x + kSide / 2, 0, 0}, {x, 0, kSide * std::sqrt(3.0) / 2}}, i + 1));
  }
  return curves;
}

// Six parallel upright 5 mm wires: how near may neighbours be?
Curves ParallelWires(const ObjectOptions& options) {
  constexpr int kWires = 6;
  constexpr double kLength = 240, kDiameter = 5;
  const double spacing_mm = options.spacing / kMillimetre;
  const double diameter_mm =
      options.wire_diameter > 0 ? options.wire_diameter / kMillimetre : kDiameter;
  if (spacing_mm <= diameter_mm) {
    throw Error(ErrorKind::kUsage,
                fmt::format("parallel_wires of {} mm cannot stand {} mm apart from axis to axis: "
                            "raise the spacing or lower the diameter",
                            diameter_mm, spacing_mm));
  }
  Curves curves;
  for (int i = 0; i < kWires; ++i) {
    const double x = (i - (kWires - 1) / 2.0) * spacing_mm;
    curves.push_back(Wire({{x, 0, 0}, {x, 0, kLength}}, kDiameter));
  }
  return curves;
}

// A toast rack: five arches on a base.
Curves Breadholder() {
  Curves curves = {Loop(RoundedRectangle(210, 110, 20), 5)};
  constexpr double kRadius = 55, kStraight = 50;
  for (int i = 0; i < 5; ++i) {
    const double x = -80 + 40 * i;
    Polyline arch = {{x, -kRadius, 0}};
    for (const double t : Linspace(0, kPi, 24)) {
      arch.emplace_back(x, -kRadius * std::cos(t), kStraight + kRadius * std::sin(t));
    }
    arch.emplace_back(x, kRadius, 0);
    curves.push_back(Wire(arch, 5));
  }
  return curves;
}

// Three wires through one point, none upright, none in the image plane: a junction of valence 6.
Curves Valence6() {
  constexpr double kHalfLength = 130;
  Curves curves;
  for (int i = 0; i < 3; ++i) {
    const double angle = 2 * kPi * i / 3 + 0.3;
    const Vec3 direction(std::cos(angle) * std::sqrt(2.0 / 3), std::sin(angle) * std::sqrt(2.0 / 3),
                         std::sqrt(1.0 / 3));
    curves.push_back(Wire({-kHalfLength * direction, Vec3::Zero(), kHalfLength * direction}, 5));
  }
  return curves;
}

// A framed welded mesh: 4 mm wires every 40 mm.
Curves MeshPanel() {
  constexpr double kHalf = 140, kPitch = 40;
  Curves curves = {
      Loop({{-kHalf, 0, -kHalf}, {kHalf, 0, -kHalf}, {kHalf, 0, kHalf}, {-kHalf, 0, kHalf}}, 6)};
  for (int i = 0; i < 6; ++i) {
    const double at = (i - 2.5) * kPitch;
    curves.push_back(Wire({{at, 0, -kHalf}, {at, 0, kHalf}}, 4));
    curves.push_back(Wire({{-kHalf, 0, at}, {kHalf, 0, at}}, 4));
  }
  return curves;
}

// A cube of wires, turned by 25 degrees, with a cross in one face, a ring in the lid and a free
// hook.
Curves CubeFrame() {
  constexpr double kHalf = 80, kRing = 56.5;
  const auto corner = [](double x, double y, double z) {
    const Mat3 turn = Eigen::AngleAxisd(25 * kPi / 180, Vec3::UnitZ()).toRotationMatrix();
    return Vec3(turn * Vec3(x * kHalf, y * kHalf, z * kHalf));
  };
  const double sides[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  Curves curves;
  for (int i = 0; i < 4; ++i) {
    const auto [x, y] = sides[i];
    const auto [next_x, next_y] = sides[(i + 1) % 4];
    for (const double z : {-1.0, 1.0}) {
      curves.push_back(Wire({corner(x, y, z), corner(next_x, next_y, z)}, 4.5));
    }
    curves.push_back(Wire({corner(x, y, -1), corner(x, y, 1)}, 4.5));
    const Vec3 lid = corner(x, y, 1);
    const Vec3 on_ring(kRing * lid.x() / lid.head<2>().norm(),
                       kRing * lid.y() / lid.head<2>().norm(), kHalf);
    curves.push_back(Wire({lid, on_ring}, 4.5));
  }
  curves.push_back(Wire({corner(-1, -1, -1), corner(1, -1, 1)}, 4.5));
  curves.push_back(Wire({corner(1, -1, -1), corner(-1, -1, 1)}, 4.5));
  curves.push_back(Loop(CirclePoints(kRing, kHalf, 240), 7));
  Polyline hook;
  for (const double t : Linspace(0, 1, 61)) {
    hook.push_back(corner(1, 1, 1) +
                   Vec3(35 * std::sin(kPi * t) * (1 - 0.5 * t) + 26 * t * t, 10 * t, 110 * t));
  }
  curves.push_back(Wire(hook, 4.5));
  return curves;
}

}  // namespace

bool MakeStudyObject(const std::string& name, const ObjectOptions& options,
                     std::vector<WireCurve>& curves) {
  const std::map<std::string, std::function<Curves()>> makers = {
      {"triangles", Triangles},          {"parallel_wires", [&] { return ParallelWires(options); }},
      {"breadholder", Breadholder},      {"valence6", Valence6},
      {"mesh_panel", MeshPanel},         {"cubeframe", CubeFrame},
      {"empty", [] { return Curves(); }}};
  const auto maker = makers.find(name);
  if (maker == makers.end()) return false;
  curves = maker->second();
  return true;
}

}  // namespace curvefusion
