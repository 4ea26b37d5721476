#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "experiments/simulation/block_matching.h"
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

/// Depths that a sensor reports, in metres.
struct DepthRange {
  double nearest = 0;
  double farthest = 0;
};

/// A simulated depth camera. Immutable and thread-safe once made, so frames can be taken in any
/// order and in parallel.
class DepthSensor {
 public:
  virtual ~DepthSensor() = default;
  virtual const PinholeCamera& camera() const = 0;

  virtual DepthRange Range() const = 0;

  /// How far from an object one would hold it, in metres.
  virtual double WorkingDistance() const { return 0.56; }

  /// Pixels of its colour images to a pixel of depth.
  virtual double ColorScale() const { return 1; }

  /// The depth image of one frame in metres, 0 where the sensor has no measurement.
  virtual DepthImage Measure(const Scene& scene, const Exposure& exposure) const = 0;
};

/// The names MakeDepthSensor knows: `kinect_v1`, `primesense`, `kinect_v2`, `azure_kinect`,
/// `sr300`, `d400`, `d455`, `phone`, `artec_spider`, `ideal`.
std::vector<std::string> SensorNames();

/// A sensor by name; `seed` draws its pattern and noise, `matching` is for those of structured
/// light. Throws Error(kUsage) for another name.
std::unique_ptr<DepthSensor> MakeDepthSensor(const std::string& name, uint64_t seed,
                                             const BlockMatchingOptions& matching = {});

}  // namespace curvefusion
