#pragma once

#include <algorithm>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// Means over squares of an image's values that are not negative, from a summed-area table (Crow
/// 1984). Linear in pixels to build, constant for each mean.
class BoxSums {
 public:
  explicit BoxSums(const Image<float>& values)
      : width_(values.width()),
        height_(values.height()),
        sums_(static_cast<size_t>(width_ + 1) * (height_ + 1), Vec2::Zero()) {
    for (int v = 0; v < height_; ++v) {
      Vec2 row = Vec2::Zero();
      for (int u = 0; u < width_; ++u) {
        if (values(u, v) >= 0) row += Vec2(values(u, v), 1);
        At(u + 1, v + 1) = At(u + 1, v) + row;
      }
    }
  }

  /// Of the square of so many pixels to each side, cut at the border; -1 where nothing is known.
  float Mean(int u, int v, int reach) const {
    const int u0 = std::clamp(u - reach, 0, width_), u1 = std::clamp(u + reach + 1, 0, width_);
    const int v0 = std::clamp(v - reach, 0, height_), v1 = std::clamp(v + reach + 1, 0, height_);
    const Vec2 sum = At(u1, v1) - At(u1, v0) - At(u0, v1) + At(u0, v0);
    if (!(sum.y() > 0)) return -1;
    return static_cast<float>(std::max(0.0, sum.x()) / sum.y());
  }

 private:
  Vec2& At(int u, int v) { return sums_[static_cast<size_t>(v) * (width_ + 1) + u]; }
  const Vec2& At(int u, int v) const { return sums_[static_cast<size_t>(v) * (width_ + 1) + u]; }

  int width_, height_;
  std::vector<Vec2> sums_;  ///< of values and their number, of all pixels above and to the left
};

}  // namespace curvefusion
