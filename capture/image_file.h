#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "capture/image_part.h"
#include "kernel/image.h"

namespace curvefusion {

/// What the first and last bytes of an image say, without decoding it.
struct ImageHeader {
  std::string defect;  ///< why the file cannot be used ("is truncated"), empty where it can
  int width = 0;
  int height = 0;
  int bits = 0;      ///< per channel
  int channels = 0;  ///< 1 grey, 3 colour, 4 with alpha
};

/// What messages advise where an image cannot be read.
constexpr const char* kUnreadableImageRemedy =
    "copy it again, or leave the frame out (curvefusion check --repair DIR does so)";

/// Reads the header of a PNG or JPEG file, or of the part of a recording, and looks for its end
/// marker: a file cut off is told from a whole one, which decoders do not do for JPEG. Does not
/// throw for bad files.
ImageHeader ReadImageHeader(const std::filesystem::path& path, const ImagePart& part = {});

/// Whether an image begins as a JPEG does; false where it cannot be read.
bool IsJpeg(const std::filesystem::path& path, const ImagePart& part = {});

/// The bytes of an image as they are stored. Throws Error(kBadInput) naming the file where they
/// cannot be read.
std::string ReadImageBytes(const std::filesystem::path& path, const ImagePart& part = {});

/// Decodes a 16-bit grey PNG or bare depth. Throws Error(kBadInput) naming the file where it is
/// missing, truncated, broken or of another kind.
Image<uint16_t> DecodeDepthImage(const std::filesystem::path& path, const ImagePart& part = {});

/// Raw depth in metres: `invalid_value` and 0 become 0, others are divided by `units_per_metre`.
DepthImage MetricDepth(const Image<uint16_t>& raw, double units_per_metre, int invalid_value);

/// Decodes an 8-bit PNG, JPEG or bare image, grey or colour. Orientation tags are ignored:
/// intrinsics belong to the stored pixels. Throws like DecodeDepthImage. `remark` takes what is odd
/// about the file but need not touch its pixels.
ColorImage DecodeColorImage(const std::filesystem::path& path, const ImagePart& part = {},
                            std::string* remark = nullptr);

}  // namespace curvefusion
