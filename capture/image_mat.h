#pragma once

#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>
#include <type_traits>

#include "kernel/image.h"

namespace curvefusion {

/// The pixels of an image as OpenCV sees them, not copied: they must outlive it. OpenCV has no view
/// of const pixels: nothing may be written to those.
template <class Pixel>
cv::Mat MatOf(Image<Pixel>& image) {
  constexpr int kType = std::is_same_v<Pixel, Rgb>       ? CV_8UC3
                        : std::is_same_v<Pixel, float>   ? CV_32FC1
                        : std::is_same_v<Pixel, uint8_t> ? CV_8UC1
                                                         : -1;
  static_assert(kType >= 0, "an image of bytes, floats or colours");
  return {image.height(), image.width(), kType, image.data()};
}

template <class Pixel>
cv::Mat MatOf(const Image<Pixel>& image) {
  return MatOf(const_cast<Image<Pixel>&>(image));
}

/// A colour as OpenCV draws with it.
inline cv::Scalar Ink(const Rgb& color) {
  return {double(color[0]), double(color[1]), double(color[2])};
}

/// An image of fewer pixels, each the mean of those that it covers.
template <class Pixel>
Image<Pixel> ShrunkTo(int width, int height, const Image<Pixel>& image) {
  Image<Pixel> small(width, height);
  cv::resize(MatOf(image), MatOf(small), {width, height}, 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace curvefusion
