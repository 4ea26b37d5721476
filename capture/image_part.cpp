#include "capture/image_part.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cstring>
#include <new>

#include "kernel/error.h"

namespace curvefusion {

namespace {

// Chosen: ten times what the largest cameras give; more is a damaged or hostile header.
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 28;
// Derived: deflate codes at most 258 bytes by two bits and less than a byte of other things.
constexpr std::uint64_t kMaxDeflateRatio = 1032;

struct Layout {
  int bits;  // per channel
  int channels;
};

Layout LayoutOf(PixelCoding coding) {
  switch (coding) {
    case PixelCoding::kDepth16:
    case PixelCoding::kDepth16BigEndian:
    case PixelCoding::kDepth16Zlib:
      return {16, 1};
    case PixelCoding::kGrey8:
      return {8, 1};
    case PixelCoding::kRgb8:
    case PixelCoding::kBgr8:
      return {8, 3};
    case PixelCoding::kRgba8:
    case PixelCoding::kBgra8:
      return {8, 4};
    case PixelCoding::kPngOrJpeg:
      break;
  }
  return {0, 0};
}

std::uint64_t PixelBytes(const ImagePart& part) {
  const Layout layout = LayoutOf(part.coding);
  return static_cast<std::uint64_t>(part.width) * part.height * layout.channels * layout.bits / 8;
}

// Inflates a zlib stream into exactly `size` bytes; returns what is wrong with it.
std::string Inflate(const std::string& packed, void* target, std::uint64_t size) {
  z_stream stream{};
  if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  // zlib does not write through it
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = static_cast<Bytef*>(target);
  stream.avail_out = static_cast<uInt>(size);
  const int status = inflate(&stream, Z_FINISH);
  const std::uint64_t missing = stream.avail_out;
  inflateEnd(&stream);
  if (status == Z_MEM_ERROR) throw std::bad_alloc();
  if (status == Z_DATA_ERROR || status == Z_NEED_DICT) return "is damaged (its zlib data)";
  if (missing > 0) return fmt::format("has {} bytes of pixels too few", missing);
  if (status != Z_STREAM_END) return "has more pixels than its size allows, or is cut off";
  return {};
}

}  // namespace

std::string ImageName(const std::filesystem::path& path, const ImagePart& part) {
  return part.name.empty() ? path.string() : path.string() + ": " + part.name;
}

bool IsRaw(PixelCoding coding) { return coding != PixelCoding::kPngOrJpeg; }

int BitsOf(PixelCoding coding) { return LayoutOf(coding).bits; }

int ChannelsOf(PixelCoding coding) { return LayoutOf(coding).channels; }

std::string SizeDefect(int width, int height) {
  const auto columns = static_cast<std::uint32_t>(width), rows = static_cast<std::uint32_t>(height);
  if (std::uint64_t{columns} * rows <= kMaxPixels) return {};
  return fmt::format("has more than {} pixels", kMaxPixels);
}

std::string RawDefect(const ImagePart& part) {
  std::string too_large = SizeDefect(part.width, part.height);
  if (!too_large.empty()) return too_large;
  const std::uint64_t needed = PixelBytes(part);
  const bool is_deflated = part.coding == PixelCoding::kDepth16Zlib;
  if (is_deflated ? part.bytes * kMaxDeflateRatio >= needed : part.bytes == needed) return {};
  return fmt::format("has {} bytes, {}x{} pixels need {}{}", part.bytes, part.width, part.height,
                     is_deflated ? "more than " : "",
                     is_deflated ? needed / kMaxDeflateRatio : needed);
}

Image<std::uint16_t> DecodeRawDepth(const std::filesystem::path& path, const ImagePart& part,
                                    const std::string& bytes) {
  Image<std::uint16_t> depth(part.width, part.height);
  const std::uint64_t size = PixelBytes(part);
  std::string defect;
  if (part.coding == PixelCoding::kDepth16Zlib) {
    defect = Inflate(bytes, depth.data(), size);
  } else if (bytes.size() == size) {
    std::memcpy(depth.data(), bytes.data(), size);
  } else {
    defect = RawDefect(part);
  }
  for (size_t i = 0; part.coding == PixelCoding::kDepth16BigEndian && i < depth.size(); ++i) {
    const std::uint16_t value = depth.data()[i];
    depth.data()[i] = static_cast<std::uint16_t>((value << 8) | (value >> 8));
  }
  if (defect.empty()) return depth;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: {}; copy the recording again", ImageName(path, part), defect));
}

ColorImage DecodeRawColor(const ImagePart& part, const std::string& bytes) {
  ColorImage color(part.width, part.height);
  const auto step = static_cast<size_t>(ChannelsOf(part.coding));
  const auto* pixel = reinterpret_cast<const std::uint8_t*>(bytes.data());
  const bool is_grey = part.coding == PixelCoding::kGrey8;
  const bool is_blue_first =
      part.coding == PixelCoding::kBgr8 || part.coding == PixelCoding::kBgra8;
  const size_t red = is_blue_first ? 2 : 0;
  const size_t green = is_grey ? 0 : 1;
  const size_t blue = is_grey || is_blue_first ? 0 : 2;
  for (size_t i = 0; i < color.size() && (i + 1) * step <= bytes.size(); ++i, pixel += step) {
    color.data()[i] = {pixel[red], pixel[green], pixel[blue]};
  }
  return color;
}

}  // namespace curvefusion
