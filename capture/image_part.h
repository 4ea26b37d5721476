#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "capture/packed_chunk.h"
#include "kernel/image.h"

namespace curvefusion {

/// How bytes code the pixels of an image.
enum class PixelCoding {
  kPngOrJpeg,  ///< those of a PNG or JPEG file
  kDepth16,    ///< 16-bit little-endian, row by row
  kDepth16BigEndian,
  kDepth16Zlib,  ///< the same as a zlib stream
  kGrey8,
  kRgb8,
  kBgr8,
  kRgba8,
  kBgra8,
};

/// Where in a recording the bytes of an image are, and how they code it; packed images are bare
/// pixels. The default stands for an image file: the whole of it.
struct ImagePart {
  std::uint64_t offset = 0;  ///< of the first byte in the file, or in the unpacked chunk
  std::uint64_t bytes = 0;   ///< how many; 0: all of the file
  PixelCoding coding = PixelCoding::kPngOrJpeg;
  int width = 0;  ///< pixels, as the recording says; PNG and JPEG say it themselves
  int height = 0;
  std::string name;   ///< what messages call it: "depth image of frame 12"
  PackedChunk chunk;  ///< what has to be unpacked to get at the bytes, if it is packed

  bool IsWholeFile() const { return bytes == 0; }
};

/// What messages call an image: its file, and its part.
std::string ImageName(const std::filesystem::path& path, const ImagePart& part);

/// Whether the bytes are bare pixels, whose size the recording tells.
bool IsRaw(PixelCoding coding);

/// Bits per channel and channels of bare pixels.
int BitsOf(PixelCoding coding);
int ChannelsOf(PixelCoding coding);

/// Why no image has this size ("has more than 268435456 pixels"); empty where one may.
std::string SizeDefect(int width, int height);

/// Why bare pixels cannot be what the part says ("has 100 bytes, 640x480 pixels of 16 bits need
/// 614400"); empty where they can. Reads nothing.
std::string RawDefect(const ImagePart& part);

/// Decodes bare depth. Throws Error(kBadInput) naming file and part where the bytes are damaged.
Image<std::uint16_t> DecodeRawDepth(const std::filesystem::path& path, const ImagePart& part,
                                    const std::string& bytes);

/// Decodes bare grey or colour.
ColorImage DecodeRawColor(const ImagePart& part, const std::string& bytes);

}  // namespace curvefusion
