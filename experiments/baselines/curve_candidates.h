#pragma once

#include <vector>

#include "experiments/baselines/image_curves.h"
#include "experiments/baselines/silhouette_maps.h"
#include "kernel/polyline.h"
#include "kernel/progress.h"

namespace curvefusion {

// The first half of Liu et al. 2017 (three_view_wires.h): curves in space that three images admit.

/// A candidate has more points, and a curve of an image more pixels, than this to count: the
/// authors' program has 2 to 15 for its nine examples and calls 10 general.
inline constexpr int kLeastCurvePixels = 10;

/// How far the image of a candidate may lie beside the curves of each of the three images, in
/// pixels: the median over the authors' nine examples (1.0 to 3.8).
inline constexpr double kSupportDistance_px = 1.5;

/// What is compared with it, of the distances d_i of n points.
enum class SupportRule {
  kOfProgram,    ///< sqrt(sum d_i^2) / n, as the authors' program has it: lax for long candidates
  kMeanDistance  ///< sum d_i / n
};

/// A camera and the curves of its image.
struct CurveView {
  PinholeCamera camera;
  RigidTransform T_world_camera = RigidTransform::Identity();
  ImageCurves curves;
};

/// What is more likely object than not, thinned and split at junctions.
CurveView FindImageCurves(const SilhouetteMap& map);

/// A curve in space, which was found by walking along a curve of one image.
struct CurveCandidate {
  int view = 0;             ///< the image
  std::vector<int> pixels;  ///< of each point: the number of the image curves' point
  Polyline points;          ///< world frame, metres
  double distance_px = 0;   ///< how far its images lie beside the curves: root mean square
};

/// The candidates of three views that have support in all. `views` must be three.
std::vector<CurveCandidate> SupportedCandidates(const std::vector<CurveView>& views,
                                                SupportRule rule, const Progress& progress);

}  // namespace curvefusion
