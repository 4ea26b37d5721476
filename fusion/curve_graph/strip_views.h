#pragma once

#include <Eigen/Geometry>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "capture/sequence.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/curve_graph/strip_image.h"
#include "graph/skeleton_graph.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"
#include "kernel/polyline.h"

namespace curvefusion {

/// Colour images in which strips stand out that no known curve explains, and what depth shows of
/// the space in front of them. Where images are full of strips one more tells little.
class StripViews {
 public:
  /// Images that are asked, at most. Chosen: time grows with them.
  static constexpr int kMaxViews = 90;

  struct View {
    RigidTransform T_color_world;
    /// From places in the world, with a one below, to pixels times depth, and depth.
    Eigen::Matrix<float, 3, 4> color_from_world, depth_from_world;
    Vec3 center;
    StripImage strips;
    Image<float> farthest;  // depth, in cells, metres
  };

  /// `frames` are those whose images of how likely pixels show wire are in `posteriors`. The object
  /// is `around`; no curve is known yet. Images much larger than 640 x 480 are looked at in half
  /// their size, all of them times `scale`; `posteriors` may have that size already.
  StripViews(const Sequence& sequence, const std::vector<int>& frames,
             const std::vector<PosteriorImage>& posteriors, const Eigen::AlignedBox3d& around,
             double scale = 1);

  /// The camera of images as they are looked at.
  static PinholeCamera CameraLookedThrough(const PinholeCamera& color_camera, double scale = 1);

  const std::vector<View>& views() const { return views_; }

  /// Around the object: a quarter of its extent farther to all sides. Strips elsewhere are not
  /// looked for.
  const Eigen::AlignedBox3d& bounds() const { return bounds_; }
  const PinholeCamera& color_camera() const { return color_camera_; }
  const PinholeCamera& depth_camera() const { return depth_camera_; }

  /// From now on these curves explain the strips along them, which then do not count as chance.
  void ExplainAll(const SkeletonGraph& skeleton);

  /// From now on a curve explains the strips along it.
  void Explain(const Polyline& points, const std::vector<double>& radii);

  /// By all images and strips within 1.4 pixels that run as a curve through a place does. An image
  /// counts less the more the curve is foreshortened in it.
  StripAgreement Along(const Vec3& p, const Vec3& direction) const;

  /// Along at each place of a curve.
  std::vector<StripAgreement> AgreementsAlong(const Polyline& points) const;

  /// The share of the images of Along that show a strip at each place of a curve; 1 where too few
  /// look.
  std::vector<double> SharesAlong(const Polyline& points) const;

  /// Whether depth shows something farther behind a place in most of the images that can tell.
  bool IsFree(const Vec3& p) const;

  /// Whether depth shows only what is nearer than a place, in pixels times depth, and depth.
  bool IsHidden(const View& view, const Vec3f& in_depth) const;

 private:
  // A pixel that shows a place.
  struct Sight {
    int u, v;
    Eigen::Vector2f pixel;
  };

  static std::optional<Sight> RoundedIn(const PinholeCamera& camera, const Vec3f& p);
  std::optional<Sight> SightOf(const View& view, const Vec3f& in_color,
                               const Vec3f& in_depth) const;
  bool RunsAlong(const View& view, const Sight& sight, const Vec3& p_color, const Vec3& d) const;
  float Behind(const View& view, const Vec3f& in_depth) const;
  cv::Rect RegionIn(const RigidTransform& T_color_world) const;
  void ExplainIn(View& view, const Polyline& points, const std::vector<double>& radii) const;

  PinholeCamera depth_camera_;
  PinholeCamera color_camera_;  // of images as they are looked at
  Eigen::AlignedBox3d bounds_;
  std::vector<View> views_;
};

}  // namespace curvefusion
