#include "capture/jpeg.h"

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>

// After cstdio, which they need.
#include <jerror.h>
#include <jpeglib.h>

namespace curvefusion {

namespace {

// The first messages of libjpeg, and the place its errors jump back to: its C code cannot be left
// by exceptions.
struct Messages {
  jpeg_error_mgr errors;  // first: libjpeg hands back a pointer to it
  std::jmp_buf leave;
  bool out_of_memory = false;
  std::array<char, JMSG_LENGTH_MAX> defect{};
  std::array<char, JMSG_LENGTH_MAX> remark{};
};

Messages& MessagesOf(j_common_ptr jpeg) { return *reinterpret_cast<Messages*>(jpeg->err); }

void KeepFirst(j_common_ptr jpeg, std::array<char, JMSG_LENGTH_MAX>& message) {
  if (message[0] == '\0') jpeg->err->format_message(jpeg, message.data());
}

void Leave(j_common_ptr jpeg) {
  Messages& messages = MessagesOf(jpeg);
  messages.out_of_memory = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
  KeepFirst(jpeg, messages.defect);
  std::longjmp(messages.leave, 1);
}

// Negative levels are warnings: the decoder goes on with pixels of its own making.
void NoteWarning(j_common_ptr jpeg, int level) {
  if (level >= 0) return;
  ++jpeg->err->num_warnings;
  Messages& messages = MessagesOf(jpeg);
  switch (jpeg->err->msg_code) {
    case JWRN_ADOBE_XFORM:
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_JFIF_MAJOR:
      KeepFirst(jpeg, messages.remark);
      break;
    default:
      KeepFirst(jpeg, messages.defect);
  }
}

void PrintNothing(j_common_ptr) {}

// Reads up to the image size. All automatic objects here and below are trivial: jumps pass them.
void Begin(const std::string& bytes, jpeg_decompress_struct& jpeg) {
  jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  jpeg.out_color_space = JCS_RGB;
  jpeg_start_decompress(&jpeg);
}

void ReadRows(jpeg_decompress_struct& jpeg, ColorImage& image) {
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = image.row(static_cast<int>(jpeg.output_scanline))->data();
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
}

jpeg_error_mgr* Prepared(Messages& messages) {
  jpeg_error_mgr* errors = jpeg_std_error(&messages.errors);
  errors->error_exit = Leave;
  errors->emit_message = NoteWarning;
  errors->output_message = PrintNothing;
  return errors;
}

// Of a jpeg_decompress_struct or a jpeg_compress_struct; destroying one that was not created does
// nothing.
template <class Jpeg>
struct Codec {
  Codec() { jpeg.err = Prepared(messages); }
  ~Codec() { jpeg_destroy(reinterpret_cast<j_common_ptr>(&jpeg)); }
  Codec(const Codec&) = delete;
  Codec& operator=(const Codec&) = delete;

  Messages messages;
  Jpeg jpeg{};
};

// Fills the image and the messages.
void Decode(const std::string& bytes, Codec<jpeg_decompress_struct>& codec, ColorImage& image) {
  jpeg_decompress_struct& jpeg = codec.jpeg;
  if (setjmp(codec.messages.leave) != 0) return;
  jpeg_create_decompress(&jpeg);
  Begin(bytes, jpeg);
  image = ColorImage(static_cast<int>(jpeg.output_width), static_cast<int>(jpeg.output_height));
  ReadRows(jpeg, image);
}

// What libjpeg allocates for the file, which the caller frees.
struct EncodedBytes {
  unsigned char* data = nullptr;
  unsigned long size = 0;
};

void Encode(const ColorImage& image, int quality, Codec<jpeg_compress_struct>& codec,
            EncodedBytes& encoded) {
  jpeg_compress_struct& jpeg = codec.jpeg;
  if (setjmp(codec.messages.leave) != 0) return;
  jpeg_create_compress(&jpeg);
  jpeg_mem_dest(&jpeg, &encoded.data, &encoded.size);
  jpeg.image_width = static_cast<JDIMENSION>(image.width());
  jpeg.image_height = static_cast<JDIMENSION>(image.height());
  jpeg.input_components = 3;
  jpeg.in_color_space = JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, quality, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    // libjpeg only reads them.
    auto* row = const_cast<JSAMPROW>(image.row(static_cast<int>(jpeg.next_scanline))->data());
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
}

}  // namespace

Jpeg DecodeJpeg(const std::string& bytes) {
  static_assert(sizeof(Rgb) == 3);
  Codec<jpeg_decompress_struct> codec;
  Jpeg result;
  Decode(bytes, codec, result.image);
  if (codec.messages.out_of_memory) throw std::bad_alloc();
  result.defect = codec.messages.defect.data();
  result.remark = codec.messages.remark.data();
  return result;
}

std::string EncodeJpeg(const ColorImage& image, int quality) {
  Codec<jpeg_compress_struct> codec;
  const Messages& messages = codec.messages;
  EncodedBytes encoded;
  Encode(image, quality, codec, encoded);
  // After an error nothing tells which of its buffers libjpeg has left.
  if (messages.out_of_memory) throw std::bad_alloc();
  if (messages.defect[0] != '\0') throw std::invalid_argument(messages.defect.data());
  const std::unique_ptr<unsigned char, decltype(&std::free)> bytes(encoded.data, std::free);
  return {reinterpret_cast<const char*>(encoded.data), encoded.size};
}

}  // namespace curvefusion
