#pragma once

#include "capture/sequence.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// The colour pixel at which a depth pixel is seen.
class ColourLookup {
 public:
  /// `shift_px`: from where a depth pixel projects to where it is seen. The sequence must outlive
  /// this.
  ColourLookup(const Sequence& sequence, const Vec2& shift_px)
      : sequence_(sequence), shift_px_(shift_px) {}

  /// False outside the colour image.
  bool Find(int u, int v, float depth, int& color_u, int& color_v) const {
    const Vec3 p_color = sequence_.T_color_depth * sequence_.depth_camera.Unproject(u, v, depth);
    if (p_color.z() <= 0) return false;
    const Vec2 pixel = sequence_.color_camera.Project(p_color) + shift_px_;
    const Eigen::Vector2i rounded = PinholeCamera::Rounded(pixel);
    color_u = rounded.x();
    color_v = rounded.y();
    return sequence_.color_camera.Contains(pixel);
  }

 private:
  const Sequence& sequence_;
  Vec2 shift_px_;
};

/// Calls body(u, v, color_u, color_v) for the pixels of a mask that were measured and lie in the
/// colour image.
template <typename Body>
void ForEachColour(const MaskImage& mask, const DepthImage& depth, const ColourLookup& lookup,
                   const Body& body) {
  int color_u = 0, color_v = 0;
  for (int v = 0; v < mask.height(); ++v) {
    for (int u = 0; u < mask.width(); ++u) {
      if (mask(u, v) && depth(u, v) > 0 && lookup.Find(u, v, depth(u, v), color_u, color_v)) {
        body(u, v, color_u, color_v);
      }
    }
  }
}

}  // namespace curvefusion
