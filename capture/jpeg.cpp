#include "capture/jpeg.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <new>

// After cstdio, which they need.
#include <jerror.h>
#include <jpeglib.h>

namespace curvefusion {

namespace {

// Chosen: ten times what the largest cameras give; more is a damaged or hostile header.
constexpr int64_t kMaxPixels = int64_t{1} << 28;

// libjpeg's state, the place its errors jump back to (its C code cannot be left by exceptions) and
// its first messages.
struct Decoder {
  jpeg_error_mgr errors;  // first: libjpeg hands back a pointer to it
  jpeg_decompress_struct jpeg;
  std::jmp_buf leave;
  bool out_of_memory = false;
  std::array<char, JMSG_LENGTH_MAX> defect{};
  std::array<char, JMSG_LENGTH_MAX> remark{};
};

Decoder& DecoderOf(j_common_ptr jpeg) { return *reinterpret_cast<Decoder*>(jpeg->err); }

void KeepFirst(j_common_ptr jpeg, std::array<char, JMSG_LENGTH_MAX>& message) {
  if (message[0] == '\0') jpeg->err->format_message(jpeg, message.data());
}

void Leave(j_common_ptr jpeg) {
  Decoder& decoder = DecoderOf(jpeg);
  decoder.out_of_memory = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
  KeepFirst(jpeg, decoder.defect);
  std::longjmp(decoder.leave, 1);
}

// Negative levels are warnings: the decoder goes on with pixels of its own making.
void NoteWarning(j_common_ptr jpeg, int level) {
  if (level >= 0) return;
  ++jpeg->err->num_warnings;
  Decoder& decoder = DecoderOf(jpeg);
  switch (jpeg->err->msg_code) {
    case JWRN_ADOBE_XFORM:
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_JFIF_MAJOR:
      KeepFirst(jpeg, decoder.remark);
      break;
    default:
      KeepFirst(jpeg, decoder.defect);
  }
}

void PrintNothing(j_common_ptr) {}

// Reads up to the image size; false where it cannot be held. All automatic objects here and below
// are trivial: jumps pass them.
bool Begin(const std::string& bytes, jpeg_decompress_struct& jpeg) {
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  if (int64_t{jpeg.image_width} * jpeg.image_height > kMaxPixels) return false;
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
  return true;
}

void ReadRows(jpeg_decompress_struct& jpeg, ColorImage& image) {
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = image.row(static_cast<int>(jpeg.output_scanline))->data();
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
}

// Fills the image and the messages.
void Decode(const std::string& bytes, Decoder& decoder, ColorImage& image) {
  jpeg_decompress_struct& jpeg = decoder.jpeg;
  if (setjmp(decoder.leave) != 0 || !Begin(bytes, jpeg)) return;
  image = ColorImage(static_cast<int>(jpeg.output_width), static_cast<int>(jpeg.output_height));
  ReadRows(jpeg, image);
}

}  // namespace

Jpeg DecodeJpeg(const std::string& bytes) {
  static_assert(sizeof(Rgb) == 3);
  Decoder decoder;
  decoder.jpeg.err = jpeg_std_error(&decoder.errors);
  decoder.errors.error_exit = Leave;
  decoder.errors.emit_message = NoteWarning;
  decoder.errors.output_message = PrintNothing;
  jpeg_create_decompress(&decoder.jpeg);
  const std::unique_ptr<jpeg_decompress_struct, decltype(&jpeg_destroy_decompress)> destroyed(
      &decoder.jpeg, jpeg_destroy_decompress);
  Jpeg result;
  Decode(bytes, decoder, result.image);
  if (decoder.out_of_memory) throw std::bad_alloc();
  result.defect = decoder.defect.data();
  result.remark = decoder.remark.data();
  if (result.defect.empty() && result.image.empty()) {
    result.defect = fmt::format("its header tells of more than {} pixels", kMaxPixels);
  }
  return result;
}

}  // namespace curvefusion
