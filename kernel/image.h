#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace curvefusion {

/// A row-major image. Pixel (u, v) is column u, row v; (0, 0) is the centre of the top-left pixel.
template <class T>
class Image {
 public:
  Image() = default;
  Image(int width, int height, const T& fill = T())
      : width_(width), height_(height), pixels_(static_cast<size_t>(width) * height, fill) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  size_t size() const { return pixels_.size(); }
  bool Contains(int u, int v) const { return u >= 0 && v >= 0 && u < width_ && v < height_; }

  T& operator()(int u, int v) { return pixels_[Index(u, v)]; }
  const T& operator()(int u, int v) const { return pixels_[Index(u, v)]; }
  T* row(int v) { return pixels_.data() + static_cast<size_t>(v) * width_; }
  const T* row(int v) const { return pixels_.data() + static_cast<size_t>(v) * width_; }
  T* data() { return pixels_.data(); }
  const T* data() const { return pixels_.data(); }

 private:
  size_t Index(int u, int v) const {
    assert(Contains(u, v));
    return static_cast<size_t>(v) * width_ + u;
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

/// Depth along the optical axis in metres; 0 = no measurement.
using DepthImage = Image<float>;
/// Red, green, blue.
using Rgb = std::array<uint8_t, 3>;
using ColorImage = Image<Rgb>;
/// 0 or 1 per pixel.
using MaskImage = Image<uint8_t>;

/// From a pixel to those that share a side with it.
inline constexpr std::array<std::pair<int, int>, 4> kPixelsBeside = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// By how much an image was divided to get another: a whole number, whereas sizes are rounded
/// (PinholeCamera::Scaled). Pixel u of the first is in pixel u / Divisor of the other, or in its
/// last.
template <class T, class U>
int Divisor(const Image<T>& image, const Image<U>& smaller) {
  return (image.width() + smaller.width() / 2) / smaller.width();
}

/// How many pixels were measured.
inline int64_t CountMeasured(const DepthImage& depth) {
  return std::count_if(depth.data(), depth.data() + depth.size(), [](float z) { return z > 0; });
}

inline bool AnySet(const MaskImage& mask) {
  return std::find(mask.data(), mask.data() + mask.size(), 1) != mask.data() + mask.size();
}

}  // namespace curvefusion
