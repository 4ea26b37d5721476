#include "capture/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/big_endian.h"
#include "capture/jpeg.h"
#include "capture/png.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kPngEnd("IEND");
constexpr std::string_view kJpegSignature("\xff\xd8", 2);
constexpr std::string_view kJpegEnd("\xff\xd9", 2);
// Chosen: the largest camera images, uncompressed.
constexpr std::uintmax_t kMaxImageBytes = 1u << 30;
constexpr std::streamoff kTailBytes = 1024;  // cameras append a few bytes of their own

// The bytes of an image within its file.
struct ByteRange {
  std::istream& stream;
  std::streamoff begin;
  std::streamoff size;

  // `count` bytes at an offset; shorter at the end of the range.
  std::string Read(std::streamoff offset, std::streamoff count) {
    count = std::clamp<std::streamoff>(size - offset, 0, count);
    std::string bytes(static_cast<size_t>(count), '\0');
    stream.clear();
    stream.seekg(begin + offset);
    stream.read(bytes.data(), count);
    bytes.resize(static_cast<size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return bytes;
  }
  bool EndsWithMarker(std::streamoff first, std::string_view marker) {
    const std::streamoff tail = std::max(first, size - kTailBytes);
    return Read(tail, size - tail).rfind(marker) != std::string::npos;
  }
};

ImageHeader ParsePng(ByteRange range) {
  const std::string bytes = range.Read(0, 26);
  ImageHeader header;
  if (bytes.size() < 26) return {"is truncated", 0, 0, 0, 0};
  const std::string_view view(bytes);
  header.width = BigEndian(view.substr(16, 4));
  header.height = BigEndian(view.substr(20, 4));
  header.bits = BigEndian(view.substr(24, 1));
  constexpr int kChannels[] = {1, 0, 3, 3, 2, 0, 4};  // by PNG colour type
  const int color_type = BigEndian(view.substr(25, 1));
  header.channels = color_type <= 6 ? kChannels[color_type] : 0;
  if (!range.EndsWithMarker(26, kPngEnd)) header.defect = "is truncated";
  return header;
}

// Walks over the marker segments up to the frame header (SOF) and the first scan (SOS).
ImageHeader ParseJpeg(ByteRange range) {
  ImageHeader header;
  std::streamoff offset = 2;
  while (true) {
    const std::string bytes = range.Read(offset, 10);
    if (bytes.size() < 4 || bytes[0] != '\xff') break;
    const std::string_view view(bytes);
    const int marker = BigEndian(view.substr(1, 1));
    const bool is_frame_header =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame_header && bytes.size() == 10) {
      header.bits = BigEndian(view.substr(4, 1));
      header.height = BigEndian(view.substr(5, 2));
      header.width = BigEndian(view.substr(7, 2));
      header.channels = BigEndian(view.substr(9, 1));
    }
    if (marker == 0xda) {
      if (!range.EndsWithMarker(offset, kJpegEnd)) header.defect = "is truncated";
      return header;
    }
    offset += marker == 0xff ? 1 : 2 + BigEndian(view.substr(2, 2));
  }
  header.defect = "is truncated";
  return header;
}

[[noreturn]] void FailDecoding(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}; {}", name, what, kUnreadableImageRemedy));
}

// Throws where the header tells that the image cannot be decoded; returns it otherwise.
ImageHeader RequireUsable(const std::filesystem::path& path, const ImagePart& part) {
  const ImageHeader header = ReadImageHeader(path, part);
  if (!header.defect.empty()) FailDecoding(ImageName(path, part), header.defect);
  return header;
}

ImageHeader WithSizeChecked(ImageHeader header) {
  if (header.defect.empty()) header.defect = SizeDefect(header.width, header.height);
  return header;
}

ImageHeader HeaderOf(const ImagePart& part, ByteRange range) {
  if (IsRaw(part.coding)) {
    return {RawDefect(part), part.width, part.height, BitsOf(part.coding), ChannelsOf(part.coding)};
  }
  const std::string signature = range.Read(0, 8);
  if (range.size == 0) return {"is empty"};
  if (signature == kPngSignature) return WithSizeChecked(ParsePng(range));
  if (signature.starts_with(kJpegSignature)) return WithSizeChecked(ParseJpeg(range));
  return {part.IsWholeFile() ? "is neither a PNG nor a JPEG file" : "is neither PNG nor JPEG data"};
}

std::string ReadRange(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t count,
                      const std::string& name) {
  if (count > kMaxImageBytes) {
    FailDecoding(name, fmt::format("has {} bytes; more than {} MiB cannot be an image", count,
                                   kMaxImageBytes >> 20));
  }
  std::ifstream stream = OpenFile(path);
  std::string bytes(count, '\0');
  stream.seekg(static_cast<std::streamoff>(offset));
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) FailDecoding(name, "is truncated");
  return bytes;
}

}  // namespace

ImageHeader ReadImageHeader(const std::filesystem::path& path, const ImagePart& part) {
  std::error_code error;
  std::string obstacle = ReadingObstacle(path);  // opening a pipe would wait for ever
  if (!obstacle.empty()) return {obstacle};
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream && errno == ENOMEM) throw std::bad_alloc();
  if (error || !stream) return {"cannot be read"};
  if (part.IsWholeFile()) return HeaderOf(part, {stream, 0, static_cast<std::streamoff>(size)});
  const bool is_packed = part.chunk.packing != Packing::kNone;
  const std::uint64_t offset = is_packed ? part.chunk.offset : part.offset;
  const std::uint64_t bytes = is_packed ? part.chunk.bytes : part.bytes;
  if (offset > size || bytes > size - offset) return {"is truncated"};
  return HeaderOf(part, {stream, static_cast<std::streamoff>(part.offset),
                         static_cast<std::streamoff>(part.bytes)});
}

bool IsJpeg(const std::filesystem::path& path, const ImagePart& part) {
  std::ifstream stream(path, std::ios::binary);
  ByteRange range{stream, static_cast<std::streamoff>(part.offset), 2};
  return range.Read(0, 2) == kJpegSignature;
}

std::string ReadImageBytes(const std::filesystem::path& path, const ImagePart& part) {
  if (part.IsWholeFile()) return ReadFile(path, kMaxImageBytes);
  const std::string name = ImageName(path, part);
  if (part.chunk.packing == Packing::kNone) return ReadRange(path, part.offset, part.bytes, name);
  const PackedChunk& chunk = part.chunk;
  std::string unpacked;
  const std::string defect =
      Unpack(chunk, ReadRange(path, chunk.offset, chunk.bytes, name), unpacked);
  if (!defect.empty()) FailDecoding(name, "cannot be unpacked: " + defect);
  if (part.offset > unpacked.size() || part.bytes > unpacked.size() - part.offset) {
    FailDecoding(name, "is truncated");
  }
  return unpacked.substr(part.offset, part.bytes);
}

Image<uint16_t> DecodeDepthImage(const std::filesystem::path& path, const ImagePart& part) {
  const ImageHeader header = RequireUsable(path, part);
  if (header.bits != 16 || header.channels != 1) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has {} bits and {} channels, depth needs 16 bits and one channel; "
                            "export the depth again as 16-bit PNG",
                            ImageName(path, part), header.bits, header.channels));
  }
  const std::string bytes = ReadImageBytes(path, part);
  if (IsRaw(part.coding)) return DecodeRawDepth(path, part, bytes);
  Png<uint16_t> png = DecodeDepthPng(bytes);
  if (!png.defect.empty()) FailDecoding(ImageName(path, part), png.defect);
  return std::move(png.image);
}

DepthImage MetricDepth(const Image<uint16_t>& raw, double units_per_metre, int invalid_value) {
  DepthImage depth(raw.width(), raw.height());
  const double metres_per_unit = 1 / units_per_metre;
  for (size_t i = 0; i < raw.size(); ++i) {
    const uint16_t value = raw.data()[i];
    depth.data()[i] = value == invalid_value ? 0.0f : static_cast<float>(value * metres_per_unit);
  }
  return depth;
}

ColorImage DecodeColorImage(const std::filesystem::path& path, const ImagePart& part,
                            std::string* remark) {
  RequireUsable(path, part);
  const std::string name = ImageName(path, part);
  const std::string bytes = ReadImageBytes(path, part);
  if (IsRaw(part.coding)) return DecodeRawColor(part, bytes);
  if (bytes.starts_with(kJpegSignature)) {
    Jpeg jpeg = DecodeJpeg(bytes);
    if (!jpeg.defect.empty()) FailDecoding(name, fmt::format("is damaged ({})", jpeg.defect));
    if (remark != nullptr) *remark = jpeg.remark;
    return std::move(jpeg.image);
  }
  Png<Rgb> png = DecodeColorPng(bytes);
  if (!png.defect.empty()) FailDecoding(name, png.defect);
  return std::move(png.image);
}

}  // namespace curvefusion
