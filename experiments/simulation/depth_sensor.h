#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/simulation/scene.h"
#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// Where the camera is while one frame is taken: at the first and at the last row (equal unless the
/// shutter rolls), and the number of the frame, from which its noise is drawn.
struct Exposure {
  RigidTransform T_world_first;
  RigidTransform T_world_last;
  uint64_t frame = 0;
};

/// A simulated depth camera. Immutable and thread-safe once made, so frames can be taken in any
/// order and in parallel.
class DepthSensor {
 public:
  virtual ~DepthSensor() = default;
  virtual const PinholeCamera& camera() const = 0;

  /// The depth image of one frame in metres, 0 where the sensor has no measurement.
  virtual DepthImage Measure(const Scene& scene, const Exposure& exposure) const = 0;
};

}  // namespace curvefusion
