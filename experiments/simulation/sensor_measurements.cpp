#include "experiments/simulation/sensor_measurements.h"

#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr double kBehindWires = 0.52;  // the wall
constexpr double kWireStep = 0.0001;   // metres between samples of a wire's centre line

// Pixels of an image, without a border in which nothing can be measured.
struct InnerPixels {
  int border;
  int width;
  int height;

  bool Contains(int u, int v) const {
    return u >= border && v >= border && u < width - border && v < height - border;
  }
};

// Samples of the wires' centre lines that the image shows, and how many are measured.
struct CenterLine {
  double seen = 0;
  double total = 0;
};

CenterLine CountCenterLine(const WireTarget& target, const PinholeCamera& camera,
                           const DepthImage& depth, const InnerPixels& inner, double reach) {
  CenterLine line;
  for (const Vec3& center : target.WireCenters()) {
    for (int k = -4000; k <= 4000; ++k) {
      const Vec2 pixel = camera.Project(center + kWireStep * k * target.Direction());
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (!inner.Contains(u, v)) continue;
      ++line.total;
      line.seen += std::abs(depth(u, v) - (target.depth - target.diameter / 2)) <= reach;
    }
  }
  return line;
}

WireRecall RecallOf(const WireTarget& target, const PinholeCamera& camera,
                    const DepthImage& depth) {
  constexpr double kNear = 0.015;
  constexpr double kFlying = 0.05;
  const InnerPixels inner{12, camera.width, camera.height};
  const CenterLine line = CountCenterLine(target, camera, depth, inner, kNear);
  const double surface = target.depth - target.diameter / 2;
  double covered = 0;
  double flying = 0;
  for (int v = inner.border; v < camera.height - inner.border; ++v) {
    for (int u = inner.border; u < camera.width - inner.border; ++u) {
      covered += std::abs(depth(u, v) - surface) <= kNear;
      flying += depth(u, v) > surface + kFlying && depth(u, v) < surface + kBehindWires - kFlying;
    }
  }
  const double pixels_per_metre = camera.fx / target.depth;
  const double area =
      line.total * kWireStep * target.diameter * pixels_per_metre * pixels_per_metre;
  return {line.seen / line.total, covered / area, flying / area};
}

}  // namespace

Scene WallAt(double depth) {
  Scene scene;
  scene.planes = {{-Vec3::UnitZ(), -depth}};
  scene.materials.resize(2);
  scene.materials[1].infrared_albedo = 0.7;
  return scene;
}

WallNoise MeasureWall(const DepthSensor& sensor, double distance) {
  constexpr int kBorder = 20;
  constexpr double kFarOff = 0.1;
  const RigidTransform still = RigidTransform::Identity();
  const DepthImage depth = sensor.Measure(WallAt(distance), {still, still, 0});
  double count = 0, sum = 0, squares = 0, total = 0;
  for (int v = kBorder; v < depth.height() - kBorder; ++v) {
    for (int u = kBorder; u < depth.width() - kBorder; ++u) {
      ++total;
      const double error = depth(u, v) - distance;
      if (std::abs(error) > kFarOff) continue;
      ++count;
      sum += error;
      squares += error * error;
    }
  }
  const double mean = sum / count;
  return {std::sqrt(squares / count - mean * mean), mean, count / total};
}

Vec3 WireTarget::Direction() const { return {std::cos(angle), std::sin(angle), 0}; }

std::vector<Vec3> WireTarget::WireCenters() const {
  const Vec3 across(-std::sin(angle), std::cos(angle), 0);
  std::vector<Vec3> centers;
  for (int k = -2; k <= 2; ++k) {
    centers.push_back(k * 0.107 * depth * across + Vec3(0, 0, depth));
  }
  return centers;
}

Scene WireTarget::ToScene() const {
  Scene scene = WallAt(depth + kBehindWires);
  scene.materials[0].infrared_albedo = albedo;
  for (const Vec3& center : WireCenters()) {
    for (int k = -40; k < 40; ++k) {
      scene.capsules.push_back(
          {center + 0.01 * k * Direction(), center + 0.01 * (k + 1) * Direction(), diameter / 2});
    }
  }
  return scene;
}

WireRecall MeasureRecall(const DepthSensor& sensor, const WireTarget& target) {
  WireRecall mean;
  for (const int quarter : {0, 1}) {
    WireTarget turned = target;
    turned.angle = std::numbers::pi * (0.125 + 0.5 * quarter);
    const RigidTransform still = RigidTransform::Identity();
    const DepthImage depth =
        sensor.Measure(turned.ToScene(), {still, still, static_cast<uint64_t>(quarter)});
    const WireRecall seen = RecallOf(turned, sensor.camera(), depth);
    mean.recall += seen.recall / 2;
    mean.area_ratio += seen.area_ratio / 2;
    mean.flying += seen.flying / 2;
  }
  return mean;
}

}  // namespace curvefusion
