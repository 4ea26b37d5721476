#include "capture/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include "kernel/error.h"

namespace curvefusion {

namespace {

constexpr std::string_view kPngSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kPngEnd("IEND");
constexpr std::string_view kJpegSignature("\xff\xd8", 2);
constexpr std::string_view kJpegEnd("\xff\xd9", 2);
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

int BigEndian(std::string_view bytes) {
  int value = 0;
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

cv::Mat Decode(const std::filesystem::path& path, int flags) {
  cv::Mat pixels;
  try {
    pixels = cv::imread(path.string(), flags);
  } catch (const cv::Exception&) {
    pixels.release();
  }
  if (pixels.empty()) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: cannot be decoded; copy it again or remove the frame", path.string()));
  }
  return pixels;
}

}  // namespace

ImageHeader ReadImageHeader(const std::filesystem::path& path) {
  ImageHeader header;
  std::error_code error;
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path, error));
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) {
    header.defect = "is missing or cannot be read";
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
  const cv::Mat pixels = Decode(path, cv::IMREAD_UNCHANGED);
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

ColorImage DecodeColorImage(const std::filesystem::path& path) {
  RequireUsable(path);
  const cv::Mat bgr = Decode(path, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  ColorImage color(bgr.cols, bgr.rows);
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, color.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return color;
}

}  // namespace curvefusion
