#include "capture/png.h"

#include <fmt/format.h>
#include <spng.h>
#include <zlib.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

#include "capture/big_endian.h"

namespace curvefusion {

namespace {

// Chosen: of depth images, higher levels save a few percent in several times as long.
constexpr int kCompression = 3;

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

Context NewContext(int flags) {
  Context context(spng_ctx_new(flags), spng_ctx_free);
  if (context == nullptr) throw std::bad_alloc();
  return context;
}

// The name of the first chunk of a PNG file whose checksum is wrong; empty where all are right.
std::string DamagedChunk(std::string_view png) {
  constexpr size_t kSignature = 8;
  constexpr size_t kFrame = 12;  // bytes beside the data: length, name, checksum
  for (size_t begin = kSignature; begin + kFrame <= png.size();) {
    const auto length = BigEndian(png.substr(begin, 4));
    const std::string_view name = png.substr(begin + 4, 4);
    if (length > png.size() - begin - kFrame) return std::string(name);
    const auto* data = reinterpret_cast<const Bytef*>(name.data());
    const auto checksum = BigEndian(png.substr(begin + 8 + length, 4));
    if (::crc32(0, data, length + 4) != checksum) return std::string(name);
    if (name == "IEND") return "";  // cameras append bytes of their own
    begin += kFrame + length;
  }
  return "";
}

std::string Defect(int error) {
  if (error == SPNG_EMEM) throw std::bad_alloc();
  return error == 0 ? "" : fmt::format("cannot be decoded: {}", spng_strerror(error));
}

// Returns libspng's error.
template <class Pixel>
int Decode(const std::string& bytes, spng_format format, Image<Pixel>& image) {
  // The checksums are right; zlib's own, within the data, need not be looked at too.
  const Context context = NewContext(SPNG_CTX_IGNORE_ADLER32);
  spng_set_crc_action(context.get(), SPNG_CRC_USE, SPNG_CRC_USE);
  if (const int error = spng_set_png_buffer(context.get(), bytes.data(), bytes.size()))
    return error;
  spng_ihdr header;
  if (const int error = spng_get_ihdr(context.get(), &header)) return error;
  size_t size = 0;
  if (const int error = spng_decoded_image_size(context.get(), format, &size)) return error;
  Image<Pixel> decoded(static_cast<int>(header.width), static_cast<int>(header.height));
  if (size != decoded.size() * sizeof(Pixel)) return SPNG_EFMT;
  const int error = spng_decode_image(context.get(), decoded.data(), size, format, 0);
  if (error == 0) image = std::move(decoded);
  return error;
}

template <class Pixel>
Png<Pixel> DecodePng(const std::string& bytes, spng_format format) {
  Png<Pixel> png;
  const std::string chunk = DamagedChunk(bytes);
  if (!chunk.empty()) {
    png.defect = fmt::format("is damaged (wrong checksum in its part {})", chunk);
    return png;
  }
  png.defect = Defect(Decode(bytes, format, png.image));
  return png;
}

template <class Pixel>
std::string Encode(const Image<Pixel>& image, uint8_t bits, spng_color_type color_type) {
  const Context context = NewContext(SPNG_CTX_ENCODER);
  spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  spng_set_option(context.get(), SPNG_IMG_COMPRESSION_LEVEL, kCompression);
  spng_ihdr header = {};
  header.width = static_cast<uint32_t>(image.width());
  header.height = static_cast<uint32_t>(image.height());
  header.bit_depth = bits;
  header.color_type = static_cast<uint8_t>(color_type);
  int error = spng_set_ihdr(context.get(), &header);
  if (error == 0) {
    error = spng_encode_image(context.get(), image.data(), image.size() * sizeof(Pixel),
                              SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  }
  size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(
      error == 0 ? spng_get_png_buffer(context.get(), &size, &error) : nullptr, std::free);
  // Nothing else can go wrong with an image that is there.
  if (bytes == nullptr) throw std::bad_alloc();
  return {static_cast<const char*>(bytes.get()), size};
}

}  // namespace

Png<uint16_t> DecodeDepthPng(const std::string& bytes) {
  return DecodePng<uint16_t>(bytes, SPNG_FMT_PNG);
}

Png<Rgb> DecodeColorPng(const std::string& bytes) {
  static_assert(sizeof(Rgb) == 3);
  return DecodePng<Rgb>(bytes, SPNG_FMT_RGB8);
}

std::string EncodePng(const Image<uint16_t>& depth) {
  return Encode(depth, 16, SPNG_COLOR_TYPE_GRAYSCALE);
}

std::string EncodePng(const ColorImage& color) {
  return Encode(color, 8, SPNG_COLOR_TYPE_TRUECOLOR);
}

}  // namespace curvefusion
