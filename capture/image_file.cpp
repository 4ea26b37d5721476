#include "capture/image_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/jpeg.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kPngEnd("IEND");
constexpr std::string_view kJpegSignature("\xff\xd8", 2);
constexpr std::string_view kJpegEnd("\xff\xd9", 2);
// Chosen: the largest camera images, uncompressed; INT_MAX is what OpenCV can take.
constexpr std::uintmax_t kMaxImageBytes = 1u << 30;
constexpr std::streamoff kTailBytes = 1024;  // cameras append a few bytes of their own

// `count` bytes at an offset; shorter at the end of the file.
std::string ReadBytes(std::ifstream& stream, std::streamoff offset, std::streamoff count) {
  std::string bytes(static_cast<size_t>(count), '\0');
  stream.clear();
  stream.seekg(offset);
  stream.read(bytes.data(), count);
  bytes.resize(static_cast<size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
  return bytes;
}

uint32_t BigEndian(std::string_view bytes) {
  uint32_t value = 0;
  for (const char byte : bytes) value = value * 256 + static_cast<unsigned char>(byte);
  return value;
}

bool EndsWithMarker(std::ifstream& stream, std::streamoff first, std::streamoff size,
                    std::string_view marker) {
  const std::streamoff begin = std::max(first, size - kTailBytes);
  return ReadBytes(stream, begin, size - begin).rfind(marker) != std::string::npos;
}

ImageHeader ParsePng(std::ifstream& stream, std::streamoff size) {
  const std::string bytes = ReadBytes(stream, 0, 26);
  ImageHeader header;
  if (bytes.size() < 26) return {"is truncated", 0, 0, 0, 0};
  const std::string_view view(bytes);
  header.width = BigEndian(view.substr(16, 4));
  header.height = BigEndian(view.substr(20, 4));
  header.bits = BigEndian(view.substr(24, 1));
  constexpr int kChannels[] = {1, 0, 3, 3, 2, 0, 4};  // by PNG colour type
  const int color_type = BigEndian(view.substr(25, 1));
  header.channels = color_type <= 6 ? kChannels[color_type] : 0;
  if (!EndsWithMarker(stream, 26, size, kPngEnd)) header.defect = "is truncated";
  return header;
}

// Walks over the marker segments up to the frame header (SOF) and the first scan (SOS).
ImageHeader ParseJpeg(std::ifstream& stream, std::streamoff size) {
  ImageHeader header;
  std::streamoff offset = 2;
  while (true) {
    const std::string bytes = ReadBytes(stream, offset, 10);
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
      if (!EndsWithMarker(stream, offset, size, kJpegEnd)) header.defect = "is truncated";
      return header;
    }
    offset += marker == 0xff ? 1 : 2 + BigEndian(view.substr(2, 2));
  }
  header.defect = "is truncated";
  return header;
}

// Throws where the header tells that the file cannot be decoded; returns it otherwise.
ImageHeader RequireUsable(const std::filesystem::path& path) {
  const ImageHeader header = ReadImageHeader(path);
  if (!header.defect.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}; copy it again or remove the frame",
                                                  path.string(), header.defect));
  }
  return header;
}

[[noreturn]] void FailDecoding(const std::filesystem::path& path, const std::string& what) {
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: {}; copy it again or remove the frame", path.string(), what));
}

// The name of the first chunk of a PNG file whose checksum is wrong; empty where all are right.
// OpenCV does not look at all of them.
std::string DamagedChunk(std::string_view png) {
  constexpr size_t kFrame = 12;  // bytes beside the data: length, name, checksum
  for (size_t begin = kPngSignature.size(); begin + kFrame <= png.size();) {
    const auto length = BigEndian(png.substr(begin, 4));
    const std::string_view name = png.substr(begin + 4, 4);
    if (length > png.size() - begin - kFrame) return std::string(name);
    const auto* data = reinterpret_cast<const Bytef*>(name.data());
    const auto checksum = BigEndian(png.substr(begin + 8 + length, 4));
    if (::crc32(0, data, length + 4) != checksum) return std::string(name);
    if (name == kPngEnd) return "";  // cameras append bytes of their own
    begin += kFrame + length;
  }
  return "";
}

cv::Mat DecodePng(const std::filesystem::path& path, const std::string& bytes, int flags) {
  const std::string chunk = DamagedChunk(bytes);
  if (!chunk.empty()) {
    FailDecoding(path, fmt::format("is damaged (wrong checksum in its part {})", chunk));
  }
  cv::Mat pixels;
  errno = 0;
  try {
    pixels = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1,
                                  const_cast<char*>(bytes.data())),  // OpenCV has no constant views
                          flags);
  } catch (const cv::Exception& error) {
    if (error.code == cv::Error::StsNoMem) throw std::bad_alloc();
  }
  // Nothing else tells that libpng found no memory.
  if (pixels.empty() && errno == ENOMEM) throw std::bad_alloc();
  if (pixels.empty()) FailDecoding(path, "cannot be decoded");
  return pixels;
}

}  // namespace

ImageHeader ReadImageHeader(const std::filesystem::path& path) {
  ImageHeader header;
  std::error_code error;
  header.defect = ReadingObstacle(path);  // opening a pipe would wait for ever
  if (!header.defect.empty()) return header;
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path, error));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream && errno == ENOMEM) throw std::bad_alloc();
  if (error || !stream) {
    header.defect = "cannot be read";
    return header;
  }
  const std::string signature = ReadBytes(stream, 0, 8);
  if (size == 0) {
    header.defect = "is empty";
  } else if (signature == kPngSignature) {
    header = ParsePng(stream, size);
  } else if (signature.starts_with(kJpegSignature)) {
    header = ParseJpeg(stream, size);
  } else {
    header.defect = "is neither a PNG nor a JPEG file";
  }
  return header;
}

Image<uint16_t> DecodeDepthImage(const std::filesystem::path& path) {
  const ImageHeader header = RequireUsable(path);
  if (header.bits != 16 || header.channels != 1) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has {} bits and {} channels, depth needs 16 bits and one channel; "
                            "export the depth again as 16-bit PNG",
                            path.string(), header.bits, header.channels));
  }
  const cv::Mat pixels = DecodePng(path, ReadFile(path, kMaxImageBytes), cv::IMREAD_UNCHANGED);
  assert(pixels.type() == CV_16UC1);
  Image<uint16_t> depth(pixels.cols, pixels.rows);
  for (int v = 0; v < pixels.rows; ++v) {
    std::copy_n(pixels.ptr<uint16_t>(v), pixels.cols, depth.row(v));
  }
  return depth;
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

ColorImage DecodeColorImage(const std::filesystem::path& path, std::string* remark) {
  RequireUsable(path);
  const std::string bytes = ReadFile(path, kMaxImageBytes);
  if (bytes.starts_with(kJpegSignature)) {
    Jpeg jpeg = DecodeJpeg(bytes);
    if (!jpeg.defect.empty()) FailDecoding(path, fmt::format("is damaged ({})", jpeg.defect));
    if (remark != nullptr) *remark = jpeg.remark;
    return std::move(jpeg.image);
  }
  const cv::Mat bgr = DecodePng(path, bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  ColorImage color(bgr.cols, bgr.rows);
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, color.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return color;
}

}  // namespace curvefusion
