#pragma once

#include "experiments/simulation/depth_sensor.h"

namespace curvefusion {

/// A camera of modulated light; the defaults are a Kinect V2.
struct TimeOfFlightOptions {
  PinholeCamera camera{512, 424, 365, 365, 255.5, 211.5};
  double blur_sigma_px = 0.9;  ///< the lens; decides which wires survive
  double noise = 0.006;        ///< of each phasor's parts, relative to white at 1 m
  /// Focal length of colour over that of depth: 1920x1080 pixels of 1081, at half their size.
  double color_scale = 540.5 / 365;
  double nearest = 0.5;
  double farthest = 4.5;
};

/// Depth from the phase of modulated light at 16, 80 and 120 MHz: each pixel sums the phasors of
/// everything it sees, so that edges give flying pixels and wires drown in the wall behind. The
/// sums then pass an edge-preserving filter, unwrapping and the edge tests of the usual open driver
/// (Xiang et al., libfreenect2), with its thresholds.
class TimeOfFlightSensor : public DepthSensor {
 public:
  TimeOfFlightSensor(const TimeOfFlightOptions& options, uint64_t seed)
      : options_(options), seed_(seed) {}

  const PinholeCamera& camera() const override { return options_.camera; }
  DepthRange Range() const override { return {options_.nearest, options_.farthest}; }
  double WorkingDistance() const override { return 0.7; }
  double ColorScale() const override { return options_.color_scale; }
  DepthImage Measure(const Scene& scene, const Exposure& exposure) const override;

 private:
  TimeOfFlightOptions options_;
  uint64_t seed_;
};

/// An Azure Kinect in its narrow unbinned mode, with the V2's frequencies, filters and noise: that
/// stays below the 17 mm at 3.5 m of Tolgyessy et al. 2021.
TimeOfFlightOptions AzureKinect();

}  // namespace curvefusion
