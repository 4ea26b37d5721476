#include "apps/page_frames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "apps/frame_overlay.h"
#include "capture/image_mat.h"
#include "capture/jpeg.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFrameWidth = 640;  // pixels
constexpr int kCandidates = 10;   // of a stretch of frames
constexpr int kJpegQuality = 80;
constexpr double kRotationDigits = 1e6;  // a millionth of a radian is no pixel in any image

std::string Base64(std::string_view bytes) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    const size_t count = std::min<size_t>(3, bytes.size() - i);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k) {
      text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

double Rounded(double value, double steps) { return std::round(value * steps) / steps; }

Json PoseJson(const RigidTransform& T) {
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row) {
    Json values = Json::array();
    for (int column = 0; column < 3; ++column) {
      values.push_back(Rounded(T.linear()(row, column), kRotationDigits));
    }
    values.push_back(Rounded(T.translation()[row] / kMillimetre, 100));
    rows.push_back(values);
  }
  return rows;
}

double ScaleTo(int width, int max_width) {
  return std::min(1.0, static_cast<double>(max_width) / width);
}

// No wider than `max_width`.
ColorImage Shrunk(ColorImage picture, int max_width) {
  const double scale = ScaleTo(picture.width(), max_width);
  if (scale == 1) return picture;
  return ShrunkTo(static_cast<int>(std::lround(picture.width() * scale)),
                  static_cast<int>(std::lround(picture.height() * scale)), picture);
}

}  // namespace

std::vector<int> ShownFrames(const SkeletonGraph& graph, const Sequence& sequence, int count) {
  std::vector<int> shown;
  const int total = sequence.frame_count();
  for (int i = 0; i < std::min(count, total); ++i) {
    const int first = i * total / std::min(count, total);
    const int last = (i + 1) * total / std::min(count, total);
    const int stride = (last - first + kCandidates - 1) / kCandidates;
    Sequence candidates = sequence;
    candidates.frames.clear();
    for (int frame = first; frame < last; frame += stride) {
      candidates.frames.push_back(sequence.frames[frame]);
    }
    shown.push_back(first + stride * FrameSeeingMost(graph, candidates));
  }
  return shown;
}

PageFrame MakePageFrame(const Sequence& sequence, int frame) {
  const ColorImage image = LoadColor(sequence, frame);
  return {sequence.frames[frame].name, JpegUrl(image, kFrameWidth),
          sequence.color_camera.Scaled(ScaleTo(image.width(), kFrameWidth)),
          sequence.T_color_world(frame)};
}

Json FrameJson(const PageFrame& frame) {
  const PinholeCamera& camera = frame.camera;
  return {{"name", frame.name},
          {"image", frame.image},
          {"width", camera.width},
          {"height", camera.height},
          {"fx", Rounded(camera.fx, 100)},
          {"fy", Rounded(camera.fy, 100)},
          {"cx", Rounded(camera.cx, 100)},
          {"cy", Rounded(camera.cy, 100)},
          {"T_camera_world", PoseJson(frame.T_camera_world)}};
}

std::string JpegUrl(const ColorImage& picture, int max_width) {
  if (picture.empty()) return "";
  return "data:image/jpeg;base64," + Base64(EncodeJpeg(Shrunk(picture, max_width), kJpegQuality));
}

}  // namespace curvefusion
