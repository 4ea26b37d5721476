#pragma once

namespace curvefusion {

/// Camera tracking against a volume of the frames before, with depth and with colour.
struct TrackingOptions {
  /// Metres, 0.002 to 0.05. Voxels of the tracker's own volume. Chosen on fr1_rpy and simulated
  /// scans: finer ones take longer and track no better.
  double voxel_size = 0.01;
  /// Voxels (Curless and Levoy 1996: more than the noise, which is 2 cm at 4 m).
  int truncation_voxels = 4;
  /// Metres. Depth beyond is not used: at 5 m a Kinect's noise is 3.6 cm, nearly the truncation.
  double max_depth = 5.0;
  /// Pixels: images are reduced to about this width, halved three times for the coarser
  /// levels (KinectFusion: twice).
  int image_width = 320;
  /// Whether grey images take part. Without them this is KinectFusion's tracker.
  bool use_color = true;
};

}  // namespace curvefusion
