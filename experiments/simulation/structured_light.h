#pragma once

#include "experiments/simulation/block_matching.h"
#include "experiments/simulation/depth_sensor.h"
#include "experiments/simulation/dot_pattern.h"

namespace curvefusion {

struct RayHit;
struct SceneRay;

/// A Kinect V1 or PrimeSense camera.
struct StructuredLightOptions {
  PinholeCamera camera{640, 480, 580, 580, 319.5, 239.5};
  double baseline = 0.075;  ///< metres from the camera to the projector, along +x
  /// Mean intensity of a dot of integral 1 px on a white surface, times the squared distance in mm:
  /// twice the 5.9e8 of Landau et al. 2015 (whose dots are wider), whose wall is taken as of albedo
  /// .7.
  double light_power = 1.69e9;
  double noise_sigma = 10.4;  ///< of the infrared image in 1/1023; Landau et al. 2015
  BlockMatchingOptions matching;
};

/// Depth from a projected dot pattern, by its cause: the infrared image is rendered with the
/// pattern, shadows, falloff, speckle and noise, and matched against the reference as the camera
/// does it. Wires thinner than a block are lost, thickened or merged for the real reason.
class StructuredLightSensor : public DepthSensor {
 public:
  StructuredLightSensor(const StructuredLightOptions& options, uint64_t seed);

  const PinholeCamera& camera() const override { return options_.camera; }
  DepthRange Range() const override;
  DepthImage Measure(const Scene& scene, const Exposure& exposure) const override;

  /// The infrared image alone, 10 bits.
  IntensityImage InfraredImage(const Scene& scene, const Exposure& exposure) const;

 private:
  struct Moment;

  double Pattern(int surface, uint64_t frame, double u_projector, double v) const;
  double Returned(const Scene& scene, const Moment& moment, const SceneRay& ray, const RayHit& hit,
                  double v) const;
  double RayIntensity(const Scene& scene, const Moment& moment, double u, double v) const;
  double FaceIntensity(const Scene& scene, const Moment& moment, int u, int v) const;
  Image<float> Irradiance(const Scene& scene, const Exposure& exposure) const;

  StructuredLightOptions options_;
  uint64_t seed_;
  DotPattern pattern_;
  std::vector<float> speckle_;  // a sample of the speckle's distribution
  BlockMatcher matcher_;
};

}  // namespace curvefusion
