#pragma once

#include <utility>

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"
#include "kernel/observed_points.h"
#include "kernel/options.h"

namespace curvefusion {

/// CurveFusion 4.1 "Removing large surfaces".
struct SurfaceRemovalOptions {
  /// Metres, 0.001 to 0.5. "We set the distance used for both erosion and dilation to 2 cm",
  /// measured across the line of sight, as topological operators on an image do. Sides of boxes
  /// that are seen at a grazing angle are narrow there and stay in the difference set; measured on
  /// the surface they would go, but so would wires side by side that the volume holds as one sheet.
  double opening_radius = 20 * kMillimetre;
  /// Metres, 0.001 to 0.5. "Detect edges ... by analyzing depth discontinuity": the paper gives no
  /// value; chosen: three voxels.
  double discontinuity = 15 * kMillimetre;
  /// Metres, 0 to 0.2. Assumption (i): thin structures are "sufficiently separated (~2-5cm
  /// depending on depth) from other large surfaces". A depth nearer than this to a large surface,
  /// in any direction, belongs to it: depth images fatten the outlines of surfaces, and opening
  /// rounds their corners. From 2.2 m on three standard deviations of depth noise are more and take
  /// its place.
  double separation = 20 * kMillimetre;
  /// Whether depth stays where the volume shows no surface, near or far. The text says neither;
  /// without a surface to compare with, what a Kinect measures there is mostly noise. A scanner of
  /// short range sees nothing behind what it scans.
  bool keep_unrendered = false;
};
void VisitOptions(SurfaceRemovalOptions& options, OptionVisitor& visitor);

/// First and one past the last frame of a bundle.
using BundleFrames = std::pair<int, int>;

/// What the image difference sets of a bundle hold together.
struct BundleDifference {
  ObservedPoints points;     ///< in the first frame's camera, one for each pixel
  int64_t depth_pixels = 0;  ///< with a depth, of all frames
};

/// The bundle difference set: depth pixels of all frames of a bundle that the volume of the whole
/// scene, without its thin parts, does not explain, moved to the camera of the first frame. Throws
/// Error(kBadInput) for an image that cannot be read.
BundleDifference FindBundleDifference(const Sequence& sequence, const BundleFrames& frames,
                                      const TsdfVolume& volume,
                                      const SurfaceRemovalOptions& options);

}  // namespace curvefusion
