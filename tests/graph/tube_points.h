#pragma once

#include <cmath>
#include <random>

#include "kernel/observed_points.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// Adds `count` points spread evenly over the surface of a round tube around a curve, each moved by
/// Gaussian noise of standard deviation `noise` along every axis.
inline void AddTube(const Polyline& axis, double radius, int count, double noise,
                    ObservedPoints& points) {
  std::mt19937 random(static_cast<unsigned>(points.size()) + 7);
  std::uniform_real_distribution<double> along(0, Length(axis));
  std::normal_distribution<double> gauss;
  const std::vector<double> lengths = CumulativeLength(axis);
  for (int i = 0; i < count; ++i) {
    const double s = along(random);
    const Vec3 tangent = PointAt(axis, lengths, s + 1e-4) - PointAt(axis, lengths, s - 1e-4);
    const Vec3 any(gauss(random), gauss(random), gauss(random));
    const Vec3 normal = tangent.cross(any).normalized();
    const Vec3 error(gauss(random), gauss(random), gauss(random));
    points.Add(PointAt(axis, lengths, s) + radius * normal + noise * error, Vec3::Zero(), 1);
  }
}

/// Two turns of a helix around z: 50 mm radius, 40 mm rise a turn, 634 mm long.
inline Polyline TestHelix() {
  Polyline axis;
  for (int i = 0; i <= 800; ++i) {
    const double angle = 4 * M_PI * i / 800;
    axis.emplace_back(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.02 * angle / M_PI);
  }
  return axis;
}

/// A wire of 5 mm with a tenth of it as noise, 10 points per mm^2 of its silhouette: 6000 points.
inline ObservedPoints HelixTube() {
  ObservedPoints points;
  AddTube(TestHelix(), 2.5e-3, 6000, 0.5e-3, points);
  return points;
}

}  // namespace curvefusion
