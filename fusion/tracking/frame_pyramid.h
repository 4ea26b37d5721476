#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/tracking/tracking_options.h"
#include "kernel/camera.h"
#include "kernel/image.h"

namespace curvefusion {

/// Grey (0 to 255) and its change per pixel to the right and down.
struct GreySample {
  float value = 0;
  float du = 0;
  float dv = 0;
};

/// A frame at one resolution.
struct FrameLevel {
  PinholeCamera depth_camera;
  DepthImage depth;
  PinholeCamera color_camera;
  Image<GreySample> grey;
};

/// A frame as the tracker sees it: four levels, the finest first, each of half the size of the
/// one before.
struct TrackingFrame {
  double timestamp = 0;    ///< of the depth image
  double color_delay = 0;  ///< time of the colour image after that of the depth image
  std::vector<FrameLevel> levels;
};

/// Chosen: KinectFusion (2011) has three; turns are found at one more, 40 pixels wide.
inline constexpr int kTrackingLevels = 4;

/// The cameras of a sequence, and how its colour camera lies to the depth camera.
struct TrackingCameras {
  PinholeCamera depth;
  PinholeCamera color;
  RigidTransform T_color_depth = RigidTransform::Identity();
};

TrackingCameras CamerasOf(const Sequence& sequence);

/// The camera of an image that has every n-th pixel of every n-th row of another's.
PinholeCamera EveryNth(const PinholeCamera& camera, int n);

/// Every second pixel of every second row: means of slanted surfaces lie off them.
template <class Pixel>
Image<Pixel> EverySecond(const Image<Pixel>& image) {
  Image<Pixel> half(image.width() / 2, image.height() / 2);
  for (int v = 0; v < half.height(); ++v) {
    for (int u = 0; u < half.width(); ++u) half(u, v) = image(2 * u, 2 * v);
  }
  return half;
}

/// Depth divided by a whole number: the mean of those in a square that are, by the sensor's noise,
/// of one surface with the square's median; 0 where fewer than half of its pixels are.
DepthImage ReducedDepth(const DepthImage& depth, int divisor, double max_depth);

/// The levels of a frame. `color` is empty where colour takes no part; grey is empty then.
TrackingFrame MakeTrackingFrame(const DepthImage& depth, const ColorImage& color,
                                const TrackingCameras& cameras, const TrackingOptions& options);

/// Likewise, with the stamps of a frame of a sequence.
TrackingFrame MakeTrackingFrame(const SequenceFrame& stamps, const DepthImage& depth,
                                const ColorImage& color, const TrackingCameras& cameras,
                                const TrackingOptions& options);

/// Interpolated grey and gradient at a pixel; false within a pixel of the border or outside.
bool SampleGrey(const Image<GreySample>& grey, float u, float v, GreySample& sample);

}  // namespace curvefusion
