#pragma once

#include <cstdint>
#include <vector>

#include "capture/sequence.h"

namespace curvefusion {

/// The images of a sequence at a fraction of their size: enough to tell whether poses, depth and
/// colour belong together. 37 kB a frame of 640x480.
struct Thumbnails {
  PinholeCamera depth_camera;  ///< of the thumbnails
  PinholeCamera color_camera;
  std::vector<Image<uint16_t>> depth;  ///< by frame, raw values; empty where there is none
  std::vector<Image<uint8_t>> grey;    ///< likewise, of the colour images
};

/// Thumbnails of a sequence without any image yet. All is empty where the cameras are unknown.
Thumbnails EmptyThumbnails(const Sequence& sequence);

/// Every n-th pixel of a depth image, n so that about 128 remain in a row. Empty where the image
/// has not the size of the sequence's camera.
Image<uint16_t> ShrunkDepth(const Sequence& sequence, const Image<uint16_t>& raw);

/// A colour image as grey means over squares of pixels, about 128 in a row. Empty as ShrunkDepth.
Image<uint8_t> ShrunkColor(const Sequence& sequence, const ColorImage& color);

/// Decodes the depth of these frames; others stay empty, and those that cannot be decoded too:
/// other checks report them.
Thumbnails DepthThumbnails(const Sequence& sequence, const std::vector<int>& frames);

}  // namespace curvefusion
