#pragma once

#include <cstdint>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/options.h"

namespace curvefusion {

/// How the camera is carried.
struct MotionOptions {
  double speed = 0.15;      ///< metres per second on average; it varies by a third
  double frame_rate = 30;   ///< frames per second
  double standoff = 0.56;   ///< metres from the object's near side on average; it varies by .07
  double hand_noise = 1.0;  ///< factor on sway and tremor of the hand; 0 is a robot's
};

void VisitOptions(MotionOptions& options, OptionVisitor& visitor);

/// Poses of a camera carried by hand around an object, one per frame: arcs back and forth on the
/// side of -y at 5 to 31 degrees above the horizon, at most 60 degrees to either side, looking at
/// the object (along it where it is large), plus Ornstein-Uhlenbeck sway (4 mm in .4 s, .5 degrees
/// in .3 s) and a tremor of .2 mm at 9 Hz. Never lower than 0.1 m above the table.
std::vector<RigidTransform> HandheldPath(const Eigen::AlignedBox3d& object_bounds,
                                         double table_height, int frames,
                                         const MotionOptions& options, uint64_t seed);

}  // namespace curvefusion
