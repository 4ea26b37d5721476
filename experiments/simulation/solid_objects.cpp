#include "experiments/simulation/solid_objects.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "experiments/simulation/curve_shapes.h"

namespace curvefusion {
namespace {

// Wires and solid parts that hold them; lengths in millimetres.
struct SolidObject {
  std::vector<WireCurve> curves;
  std::vector<SceneBox> solids;
};

SceneBox Solid(BoxShape shape, const Vec3& center_mm, const Vec3& half_size_mm,
               double wall_mm = 0) {
  SceneBox box;
  box.shape = shape;
  box.center = kMillimetre * center_mm;
  box.half_size = kMillimetre * half_size_mm;
  box.wall = kMillimetre * wall_mm;
  return box;
}

// A board of 20 mm on four legs with stretchers, a back of three wires.
SolidObject Seat() {
  SolidObject seat;
  constexpr double kX = 120, kY = 110, kBoard = 240, kBack = 460;
  for (const double x : {-kX, kX}) {
    seat.curves.push_back(Wire({{x, -kY, 0}, {x, -kY, kBoard}}, 10));
    seat.curves.push_back(Wire({{x, kY, 0}, {x, kY, kBack}}, 10));
    seat.curves.push_back(Wire({{x, -kY, 90}, {x, kY, 90}}, 6));
  }
  for (const double z : {330.0, 395.0, kBack})
    seat.curves.push_back(Wire({{-kX, kY, z}, {kX, kY, z}}, 7));
  seat.solids = {Solid(BoxShape::kBox, {0, 0, kBoard}, {140, 130, 10})};
  return seat;
}

// A stem with six twigs in a pot that is full of earth.
SolidObject PotPlant() {
  SolidObject plant;
  constexpr double kRim = 110, kTop = 420;
  plant.curves = {Wire({{0, 0, kRim - 5}, {0, 0, kTop}}, 8)};
  for (int i = 0; i < 6; ++i) {
    const double z = 190 + 35.0 * i, angle = 2.4 * i;
    Polyline twig;
    for (const double t : Linspace(0, 1, 20)) {
      twig.emplace_back(110 * t * std::cos(angle), 110 * t * std::sin(angle), z + 60 * t * t);
    }
    plant.curves.push_back(Wire(twig, 4.5));
  }
  plant.solids = {Solid(BoxShape::kCylinder, {0, 0, kRim / 2}, {70, 70, kRim / 2})};
  return plant;
}

// A handle of wire on a cup with a wall of 5 mm.
SolidObject Mug() {
  SolidObject mug;
  constexpr double kRadius = 42, kHeight = 100;
  Polyline handle;
  for (const double t : Linspace(-1, 1, 60)) {
    const double angle = t * std::numbers::pi / 2;
    handle.emplace_back(kRadius - 2 + 42 * std::cos(angle), 0, 52 + 32 * std::sin(angle));
  }
  mug.curves = {Wire(handle, 9)};
  mug.solids = {
      Solid(BoxShape::kCylinder, {0, 0, kHeight / 2}, {kRadius, kRadius, kHeight / 2}, 5)};
  return mug;
}

SolidObject SolidObjectCalled(const std::string& name) {
  const std::map<std::string, std::function<SolidObject()>> makers = {
      {"seat", Seat}, {"pot_plant", PotPlant}, {"mug", Mug}};
  const auto maker = makers.find(name);
  return maker == makers.end() ? SolidObject() : maker->second();
}

// A profile (radius, z) that is turned about the z axis, from the axis to the axis.
TriangleMesh Turned(const std::vector<Vec2>& profile) {
  constexpr int kAround = 96;
  TriangleMesh mesh;
  const int rings = static_cast<int>(profile.size());
  for (const Vec2& p : profile) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * std::numbers::pi * k / kAround;
      mesh.vertices.push_back(
          Vec3(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()).cast<float>());
    }
  }
  for (int ring = 0; ring + 1 < rings; ++ring) {
    for (int k = 0; k < kAround; ++k) {
      const int a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
      mesh.triangles.push_back({a, b, b + kAround});
      mesh.triangles.push_back({a, b + kAround, a + kAround});
    }
  }
  const int bottom = rings * kAround;
  mesh.vertices.push_back(Vec3(0, 0, profile.front().y()).cast<float>());
  mesh.vertices.push_back(Vec3(0, 0, profile.back().y()).cast<float>());
  for (int k = 0; k < kAround; ++k) {
    const int next = (k + 1) % kAround, top = (rings - 1) * kAround;
    mesh.triangles.push_back({bottom, next, k});
    mesh.triangles.push_back({bottom + 1, top + k, top + next});
  }
  return mesh;
}

TriangleMesh Cuboid(const Vec3& half) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(
        Vec3((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(), (i & 4 ? 1 : -1) * half.z())
            .cast<float>());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

}  // namespace

bool MakeSolidObject(const std::string& name, std::vector<WireCurve>& curves) {
  curves = SolidObjectCalled(name).curves;
  return !curves.empty();
}

std::vector<SceneBox> SolidsOf(const WireObject& object) {
  const SolidObject made = SolidObjectCalled(object.name);
  const bool same =
      std::equal(made.curves.begin(), made.curves.end(), object.curves.begin(), object.curves.end(),
                 [](const WireCurve& a, const WireCurve& b) { return a.points == b.points; });
  return same ? made.solids : std::vector<SceneBox>();
}

TriangleMesh SurfaceOf(const SceneBox& box) {
  const double radius = box.half_size.x(), half = box.half_size.z();
  std::vector<Vec2> profile = {{radius, -half}, {radius, half}};
  if (box.wall > 0) {
    profile.emplace_back(radius - box.wall, half);
    profile.emplace_back(radius - box.wall, box.wall - half);
  }
  TriangleMesh mesh = box.shape == BoxShape::kBox ? Cuboid(box.half_size) : Turned(profile);
  for (Vec3f& v : mesh.vertices) {
    v = (box.center + box.rotation * v.cast<double>()).cast<float>();
  }
  return mesh;
}

}  // namespace curvefusion
