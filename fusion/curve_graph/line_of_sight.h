#pragma once

#include <cstddef>
#include <vector>

#include "fusion/curve_graph/strip_image.h"
#include "fusion/curve_graph/strip_views.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// Places on a line of sight, by their distances along it: in every image they lie on a line.
class LineOfSight {
 public:
  /// From the camera of view number `view` in a unit direction; `views` must outlive this.
  LineOfSight(const StripViews& views, size_t view, const Vec3& direction);

  Vec3 At(double distance) const { return start_ + distance * direction_; }

  /// Of each of some distances, by every fifth image and strips within 3.5 pixels.
  std::vector<StripAgreement> FirstLooks(const std::vector<double>& distances) const {
    return Looks(distances, StripImage::kFirstLook, kFew);
  }

  /// By every fifth image and strips within 1.4 pixels: whether a close look is worth its time.
  std::vector<StripAgreement> QuickLooks(const std::vector<double>& distances) const {
    return Looks(distances, StripImage::kCloseLook, kFew);
  }

  /// By all images and strips within 1.4 pixels, whichever way these run.
  std::vector<StripAgreement> CloseLooks(const std::vector<double>& distances) const {
    return Looks(distances, StripImage::kCloseLook, 1);
  }

  /// Whether the depth of its own view shows only what is nearer.
  bool IsHidden(double distance) const;

 private:
  static constexpr size_t kFew = 5;  // chosen: every so many-th image

  // Pixels times depth, and depth: of the start, and what a metre adds.
  struct Line {
    Vec3f start, step;
  };
  struct Lines {
    Line color, depth;
  };

  std::vector<StripAgreement> Looks(const std::vector<double>& distances, StripImage::Look look,
                                    size_t stride) const;
  static void Project(const Line& line, const std::vector<float>& distances, float nearest,
                      const PinholeCamera& camera, std::vector<float>& z, LookedAt& places);
  // Those that are not behind what depth shows in one view.
  static void LeaveOutHidden(const std::vector<float>& z, const LookedAt& in_depth,
                             const Image<float>& farthest, LookedAt& places);

  const StripViews& views_;
  size_t view_;
  Vec3 start_, direction_;
  std::vector<Lines> lines_;  // in every view
};

}  // namespace curvefusion
