#pragma once

#include "experiments/simulation/depth_sensor.h"

namespace curvefusion {

/// A depth camera described by what one of its pixels sees and how it errs. Metres unless marked.
struct FootprintSensorOptions {
  PinholeCamera camera{640, 480, 580, 580, 319.5, 239.5};
  double nearest = 0;
  double farthest = 100;
  double working_distance = 0.56;
  double blur_sigma_px = 0;      ///< Gaussian footprint of a pixel; 0 = its middle ray alone
  int footprint_reach_px = 2;    ///< how far that extends to each side
  double color_scale = 1;        ///< pixels of colour to a pixel of depth
  double noise_sigma = 0;        ///< standard deviation of depth at any distance
  double noise_per_square = 0;   ///< and what adds to it per squared metre of distance
  double step = 0;               ///< depth is rounded to multiples of this; 0 = not
  double support_share = 0;      ///< share of the 7x7 pixels around that must agree ...
  double support_tolerance = 0;  ///< ... within this, or the pixel is dropped
};

/// Depth of the surface that fills most of each pixel's footprint (what a Gray code's thresholds or
/// a block match decide), with noise, rounding and the camera's filter of lonely pixels. Sensors
/// whose causes are not public are fitted with it.
class FootprintSensor : public DepthSensor {
 public:
  FootprintSensor(const FootprintSensorOptions& options, uint64_t seed)
      : options_(options), seed_(seed) {}

  const PinholeCamera& camera() const override { return options_.camera; }
  DepthRange Range() const override { return {options_.nearest, options_.farthest}; }
  double WorkingDistance() const override { return options_.working_distance; }
  double ColorScale() const override { return options_.color_scale; }
  DepthImage Measure(const Scene& scene, const Exposure& exposure) const override;

 private:
  FootprintSensorOptions options_;
  uint64_t seed_;
};

/// Exact depth of each pixel's middle ray, on the Kinect V1's pixels.
FootprintSensorOptions IdealSensor();

/// RealSense SR300: 0.2 to 1.5 m, steps of .125 mm, sigma 4 z^2 mm. The filter is fitted so that a
/// 5 mm wire at 0.7 m is lost and one of 8 mm survives.
FootprintSensorOptions RealSenseSr300();

/// RealSense D435: stereo of baseline 50 mm, sigma .08 px of disparity.
FootprintSensorOptions RealSenseD400();

/// RealSense D455: the same with a baseline of 95 mm.
FootprintSensorOptions RealSenseD455();

/// A phone with LiDAR: 24x24 beams, made into 256x192 pixels of depth beside 1920x1440 of colour.
FootprintSensorOptions PhoneLidar();

/// Artec Space Spider: 0.2 to 0.3 m, a grid of .15 mm, sigma .05 mm.
FootprintSensorOptions ArtecSpider();

}  // namespace curvefusion
