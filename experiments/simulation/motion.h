#pragma once

#include <cstdint>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/options.h"

namespace curvefusion {

/// How the camera is carried.
struct MotionOptions {
  double speed = 0.15;     ///< metres per second on average; it varies by a third
  double frame_rate = 30;  ///< frames per second
  double standoff = 0;  ///< metres from the object's near side; 0 = the sensor's working distance
  double hand_noise = 1.0;            ///< factor on sway and tremor of the hand; 0 is a robot's
  double sweep = 1.0471975511965976;  ///< radians to either side at most: 60 degrees
  double azimuth = 0;                 ///< radians by which the sweeps' middle lies beside the front
  double pause = 0;                   ///< seconds that the camera rests after every 1.5 s of motion
};

void VisitOptions(MotionOptions& options, OptionVisitor& visitor);

/// What is to be scanned, from where.
struct ScanTask {
  Eigen::AlignedBox3d object_bounds;
  double table_height = 0;
  double standoff = 0.56;         ///< mean distance from the object's near side
  double view_half_height = 0.2;  ///< half of what an image shows at that distance
};

/// Poses of a camera carried by hand around an object, one per frame: arcs back and forth on the
/// side of -y at 5 to 31 degrees above the horizon, at most `sweep` to either side, at a
/// distance that varies by an eighth, looking at the object (along it where the view does not show
/// all), plus Ornstein-Uhlenbeck sway (4 mm in .4 s, .5 degrees in .3 s) and a tremor of .2 mm at 9
/// Hz. Never lower than 0.1 m above the table.
std::vector<RigidTransform> HandheldPath(const ScanTask& task, int frames,
                                         const MotionOptions& options, uint64_t seed);

}  // namespace curvefusion
