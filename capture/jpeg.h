#pragma once

#include <string>

#include "kernel/image.h"

namespace curvefusion {

/// A decoded JPEG.
struct Jpeg {
  ColorImage image;    ///< RGB, grey as three equal channels
  std::string defect;  ///< why the pixels cannot be trusted; empty where they can
  std::string remark;  ///< what is odd but need not touch them: bytes between two markers
};

/// Decodes a whole JPEG file of one or three channels of 8 bits, of a size that memory holds.
/// Throws std::bad_alloc where memory runs out; all else that is wrong with it is the defect.
Jpeg DecodeJpeg(const std::string& bytes);

/// A JPEG file of an image of at most 65,500 pixels each way; quality 1 to 100. Throws
/// std::bad_alloc where memory runs out and std::invalid_argument for other sizes.
std::string EncodeJpeg(const ColorImage& image, int quality);

}  // namespace curvefusion
