#pragma once

#include <cstdint>
#include <string>

#include "kernel/image.h"

namespace curvefusion {

/// A decoded PNG.
template <class Pixel>
struct Png {
  Image<Pixel> image;
  std::string defect;  ///< why there are no pixels; empty where there are
};

/// Decode a whole PNG file of a size that memory holds; bytes behind its end are passed over. Grey
/// of 16 bits as it is; else anything as RGB: grey as three equal channels, of 16 bits the upper
/// eight, without transparency. Throw std::bad_alloc where memory runs out; all else that is wrong
/// is the defect.
Png<uint16_t> DecodeDepthPng(const std::string& bytes);
Png<Rgb> DecodeColorPng(const std::string& bytes);

/// A PNG file of an image that is not empty. Throw std::bad_alloc where memory runs out.
std::string EncodePng(const Image<uint16_t>& depth);
std::string EncodePng(const ColorImage& color);

}  // namespace curvefusion
