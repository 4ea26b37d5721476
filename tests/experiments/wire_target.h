#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "experiments/simulation/depth_sensor.h"

namespace curvefusion {

/// A wall square to the optical axis of a camera at the origin.
inline Scene WallAt(double depth) {
  Scene scene;
  scene.planes = {{-Vec3::UnitZ(), -depth}};
  scene.materials.resize(2);
  scene.materials[1].infrared_albedo = 0.7;
  return scene;
}

/// Five parallel straight wires before a wall 0.52 m behind them, square to the optical axis, at
/// `angle` from the image's rows: a test chart for thin parts.
struct WireTarget {
  double depth = 0.7;
  double diameter = 0.004;
  double angle = 0;
  double albedo = 0.7;

  Vec3 Direction() const { return {std::cos(angle), std::sin(angle), 0}; }
  Vec3 Across() const { return {-std::sin(angle), std::cos(angle), 0}; }

  std::vector<Vec3> WireCenters() const {
    std::vector<Vec3> centers;
    for (int k = -2; k <= 2; ++k) {
      centers.push_back(k * 0.107 * depth * Across() + Vec3(0, 0, depth));
    }
    return centers;
  }

  Scene ToScene() const {
    Scene scene = WallAt(depth + 0.52);
    scene.materials[0].infrared_albedo = albedo;
    for (const Vec3& center : WireCenters()) {
      for (int k = -40; k < 40; ++k) {
        scene.capsules.push_back(
            {center + 0.01 * k * Direction(), center + 0.01 * (k + 1) * Direction(), diameter / 2});
      }
    }
    return scene;
  }
};

/// How a sensor sees the wires of a target.
struct WireRecall {
  double recall = 0;  ///< share of centre-line pixels measured within 15 mm of the truth
  double area_ratio =
      0;  ///< pixels measured within 15 mm of the wires' depth, over the wires' area
};

inline void AddRecall(const WireTarget& target, const PinholeCamera& camera,
                      const DepthImage& depth, WireRecall& sum) {
  constexpr int kBorder = 12;
  constexpr double kNear = 0.015;
  const double truth = target.depth - target.diameter / 2;
  double seen = 0;
  double total = 0;
  for (const Vec3& center : target.WireCenters()) {
    for (int k = -4000; k <= 4000; ++k) {
      const Vec2 pixel = camera.Project(center + 0.0001 * k * target.Direction());
      const int u = static_cast<int>(std::lround(pixel.x()));
      const int v = static_cast<int>(std::lround(pixel.y()));
      if (u < kBorder || v < kBorder || u >= camera.width - kBorder ||
          v >= camera.height - kBorder) {
        continue;
      }
      ++total;
      seen += std::abs(depth(u, v) - truth) <= kNear;
    }
  }
  double covered = 0;
  for (int v = kBorder; v < camera.height - kBorder; ++v) {
    for (int u = kBorder; u < camera.width - kBorder; ++u) {
      covered += std::abs(depth(u, v) - truth) <= kNear;
    }
  }
  const double pixels_per_metre = camera.fx / target.depth;
  const double area = total * 0.0001 * target.diameter * pixels_per_metre * pixels_per_metre;
  sum.recall += seen / total;
  sum.area_ratio += covered / area;
}

/// The mean over wires at 22.5 and at 112.5 degrees.
inline WireRecall MeasureRecall(const DepthSensor& sensor, WireTarget target) {
  WireRecall sum;
  for (const int quarter : {0, 1}) {
    target.angle = std::numbers::pi * (0.125 + 0.5 * quarter);
    const RigidTransform still = RigidTransform::Identity();
    const DepthImage depth =
        sensor.Measure(target.ToScene(), {still, still, static_cast<uint64_t>(quarter)});
    AddRecall(target, sensor.camera(), depth, sum);
  }
  return {sum.recall / 2, sum.area_ratio / 2};
}

/// What a sensor makes of a wall.
struct WallNoise {
  double sigma = 0;  ///< metres
  double bias = 0;
  double valid = 0;  ///< share of pixels measured within 0.1 m
};

inline WallNoise MeasureWall(const DepthSensor& sensor, double distance) {
  constexpr int kBorder = 20;
  const RigidTransform still = RigidTransform::Identity();
  const DepthImage depth = sensor.Measure(WallAt(distance), {still, still, 0});
  double count = 0, sum = 0, squares = 0, total = 0;
  for (int v = kBorder; v < depth.height() - kBorder; ++v) {
    for (int u = kBorder; u < depth.width() - kBorder; ++u) {
      ++total;
      const double error = depth(u, v) - distance;
      if (std::abs(error) > 0.1) continue;
      ++count;
      sum += error;
      squares += error * error;
    }
  }
  const double mean = sum / count;
  return {std::sqrt(squares / count - mean * mean), mean, count / total};
}

}  // namespace curvefusion
