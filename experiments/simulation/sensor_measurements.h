#pragma once

#include <vector>

#include "experiments/simulation/depth_sensor.h"

namespace curvefusion {

/// A wall square to the optical axis of a camera at the origin, of infrared albedo .7.
Scene WallAt(double depth);

/// What a sensor makes of a wall.
struct WallNoise {
  double sigma = 0;  ///< metres
  double bias = 0;   ///< metres
  double valid = 0;  ///< share of pixels measured within 0.1 m
};
WallNoise MeasureWall(const DepthSensor& sensor, double distance);

/// A test chart for thin parts: five parallel straight wires before a wall 0.52 m behind them,
/// square to the optical axis. Metres and radians.
struct WireTarget {
  double depth = 0.7;
  double diameter = 0.004;
  double angle = 0;  ///< of the wires to the image's rows
  double albedo = 0.7;

  Vec3 Direction() const;
  std::vector<Vec3> WireCenters() const;
  Scene ToScene() const;
};

/// How a sensor sees the wires of a target.
struct WireRecall {
  double recall = 0;      ///< share of centre-line pixels measured within 15 mm of the truth
  double area_ratio = 0;  ///< pixels measured within 15 mm of the wires' depth, by the wires' area
  double flying = 0;      ///< pixels measured in between, 50 mm from wires and wall, by that area
};

/// The mean over wires at 22.5 and at 112.5 degrees; the target's own angle does not matter.
WireRecall MeasureRecall(const DepthSensor& sensor, const WireTarget& target);

}  // namespace curvefusion
