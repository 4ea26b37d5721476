#pragma once

#include <algorithm>
#include <vector>

#include "kernel/image.h"

namespace curvefusion {

/// Means over squares of an image's values that are not negative, from a summed-area table (Crow
/// 1984). Linear in pixels to build, constant for each mean.
class BoxSums {
 public:
  explicit BoxSums(const Image<float>& values)
      : width_(values.width()),
        height_(values.height()),
        sums_(static_cast<size_t>(width_ + 1) * (height_ + 1)) {
    for (int v = 0; v < height_; ++v) {
      Sum row;
      for (int u = 0; u < width_; ++u) {
        if (values(u, v) >= 0) row += {values(u, v), 1};
        At(u + 1, v + 1) = At(u + 1, v);
        At(u + 1, v + 1) += row;
      }
    }
  }

  /// Of the square of so many pixels to each side, cut at the border; -1 where nothing is known.
  float Mean(int u, int v, int reach) const {
    const int u0 = std::clamp(u - reach, 0, width_), u1 = std::clamp(u + reach + 1, 0, width_);
    const int v0 = std::clamp(v - reach, 0, height_), v1 = std::clamp(v + reach + 1, 0, height_);
    const Sum &a = At(u0, v0), &b = At(u1, v0), &c = At(u0, v1), &d = At(u1, v1);
    const double count = d.count - b.count - c.count + a.count;
    if (!(count > 0)) return -1;
    return static_cast<float>(std::max(0.0, d.value - b.value - c.value + a.value) / count);
  }

 private:
  struct Sum {
    double value = 0;
    double count = 0;
    Sum& operator+=(const Sum& other) {
      value += other.value;
      count += other.count;
      return *this;
    }
  };
  Sum& At(int u, int v) { return sums_[static_cast<size_t>(v) * (width_ + 1) + u]; }
  const Sum& At(int u, int v) const { return sums_[static_cast<size_t>(v) * (width_ + 1) + u]; }

  int width_, height_;
  std::vector<Sum> sums_;  ///< of all pixels above and to the left
};

}  // namespace curvefusion
