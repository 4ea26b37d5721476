#include "experiments/simulation/lighting.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/simulation/random.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {
namespace {

// A lamp on the camera's side of the object; azimuth 0 is behind the camera, positive to the right.
Lamp LampAt(double azimuth, double elevation, double power) {
  return {Vec3(std::cos(elevation) * std::sin(azimuth), -std::cos(elevation) * std::cos(azimuth),
               std::sin(elevation)),
          power};
}

Lighting SideLight(Random& random) {
  const double side = random.Uniform() < 0.5 ? -1 : 1;
  const double azimuth =
      side * random.Uniform(1.0, 1.7);  // 57 to 97 degrees: a window, a desk lamp
  return {0.2, 0.1, {LampAt(azimuth, random.Uniform(0.1, 0.7), random.Uniform(0.7, 1.0))}};
}

Lighting SeveralLamps(Random& random) {
  Lighting lighting{0.35, 0.2, {}};
  const size_t count = 2 + random.Next() % 3;
  for (size_t i = 0; i < count; ++i) {
    const double azimuth = random.Uniform(-0.6, 0.6) * std::numbers::pi;
    const double power = random.Uniform(0.5, 1.5) * 0.7 / static_cast<double>(count);
    lighting.lamps.push_back(LampAt(azimuth, random.Uniform(0.3, 1.4), power));
  }
  return lighting;
}

}  // namespace

double MirrorLobe(double cosine) {
  constexpr double kExponent = 60;
  return cosine <= 0 ? 0.0 : (kExponent + 8) / 8 * std::pow(cosine, kExponent);
}

double Lighting::Matt(const Vec3& normal) const {
  double light = ambient;
  for (const Lamp& lamp : lamps) light += lamp.power * std::max(0.0, normal.dot(lamp.direction));
  return light;
}

double Lighting::Mirrored(const Vec3& normal, const Vec3& to_eye) const {
  constexpr double kLobe = 0.9;  // chosen: a highlight of the single lamp is just not overexposed
  double light = mirrored;
  for (const Lamp& lamp : lamps) {
    const Vec3 half = (to_eye + lamp.direction).normalized();
    light += kLobe * lamp.power * MirrorLobe(normal.dot(half));
  }
  return light;
}

Lighting MakeLighting(LightKind kind, uint64_t seed) {
  Random random(seed, RandomStream::kLight);
  switch (kind) {
    case LightKind::kSide:
      return SideLight(random);
    case LightKind::kSeveral:
      return SeveralLamps(random);
    case LightKind::kDiffuse:
      return {0.9, 0.5, {}};
    case LightKind::kLamp:
      break;
  }
  return {};
}

std::vector<std::string> LightNames() { return {"lamp", "side", "several", "diffuse"}; }

std::string LightName(LightKind kind) { return LightNames()[static_cast<size_t>(kind)]; }

LightKind LightOf(const std::string& name) {
  const std::vector<std::string> names = LightNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw Error(ErrorKind::kUsage, "no light is called '" + name + "'; did you mean '" +
                                       NearestName(name, names) + "'?");
  }
  return static_cast<LightKind>(found - names.begin());
}

}  // namespace curvefusion
