#pragma once

namespace curvefusion {

/// Camera tracking against a volume of the frames before, with depth and with colour.
struct TrackingOptions {
  /// Metres. Depth beyond is not used: at 5 m a Kinect's noise is 3.6 cm, nearly the truncation.
  double max_depth = 5.0;
  /// Pixels: images are reduced to about this width, halved three times for the coarser
  /// levels (KinectFusion: twice).
  int image_width = 320;
  /// Whether grey images take part. Without them this is KinectFusion's tracker.
  bool use_color = true;
};

}  // namespace curvefusion
