#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/silhouettes/view_evidence.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// The colour images in which wires have been told from what is behind them. A wire is seen as wire
/// in every image that it lies in, whether it stands before the others or behind them; what is not
/// a wire lies beside all of them in one image or another.
class WireSilhouettes {
 public:
  /// `frames` of the sequence, whose poses and colour camera fit the curves, and for each how
  /// likely its pixels are to show wire (these images must outlive this); at most max_frames of
  /// them are used. Decodes their depth images, which tell where something large stands before a
  /// place; throws Error(kBadInput) like LoadDepth.
  WireSilhouettes(const Sequence& sequence, const std::vector<int>& frames,
                  const std::vector<PosteriorImage>& posteriors, int max_frames);

  /// The images in which a place (world frame) lies and is not hidden by something large, and those
  /// of them whose pixel there shows wire.
  ViewCount Count(const Vec3& p) const;

  /// The share of the images that show wire at a place; `untold` where too few were looked at to
  /// tell: nothing speaks for what is to be added, nor against what is to be taken away.
  double Share(const Vec3& p, double untold = 0) const;

  /// The same for each point of a curve.
  std::vector<double> SharesAlong(const Polyline& points, double untold = 0) const;

 private:
  // One of the images.
  struct View {
    RigidTransform T_depth_world;
    RigidTransform T_color_world;
    const PosteriorImage* posterior = nullptr;
    Image<float> farthest;  // the greatest depth around cells of the depth image, metres
  };
  bool IsHidden(const View& view, const Vec3& p_depth) const;

  PinholeCamera depth_camera_;
  PinholeCamera color_camera_;
  std::vector<View> views_;
};

}  // namespace curvefusion
