#include "experiments/simulation/scan_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "capture/camera_json.h"
#include "capture/jpeg.h"
#include "capture/png.h"
#include "kernel/atomic_file.h"

namespace curvefusion {
namespace {

constexpr int kJpegQuality = 95;
constexpr double kStartTime = 1000;  // names of equal width sort by time

bool SameCamera(const PinholeCamera& a, const PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy;
}

}  // namespace

double FrameTime(int frame, double frame_rate) { return kStartTime + frame / frame_rate; }

std::string FrameName(int frame, double frame_rate) {
  char name[32];
  std::snprintf(name, sizeof name, "%.6f", FrameTime(frame, frame_rate));
  return name;
}

void WriteDepthPng(const std::filesystem::path& path, const DepthImage& depth) {
  Image<uint16_t> units(depth.width(), depth.height());
  std::transform(depth.data(), depth.data() + depth.size(), units.data(), [](float z) {
    const double rounded = std::round(z * kDepthScale);
    return rounded > 65535 ? uint16_t{0} : static_cast<uint16_t>(rounded);
  });
  WriteBytesAtomically(path, EncodePng(units));
}

void WriteColorJpeg(const std::filesystem::path& path, const ColorImage& color) {
  WriteBytesAtomically(path, EncodeJpeg(color, kJpegQuality));
}

void WriteFrameLists(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  const auto write = [&](const char* file, const auto& line_of) {
    WriteStreamAtomically(folder / file, [&](std::ostream& stream) {
      for (const std::string& name : names) stream << line_of(name) << "\n";
    });
  };
  const auto color = [](const std::string& name) { return name + " rgb/" + name + ".jpg"; };
  const auto depth = [](const std::string& name) { return name + " depth/" + name + ".png"; };
  write("rgb.txt", color);
  write("depth.txt", depth);
  write("associations.txt",
        [&](const std::string& name) { return color(name) + " " + depth(name); });
}

void WriteIntrinsics(const std::filesystem::path& path, const PinholeCamera& depth_camera,
                     const PinholeCamera& color_camera, const RigidTransform& T_color_depth) {
  nlohmann::ordered_json json = CameraJson(depth_camera);
  json["depth_scale"] = kDepthScale;
  if (!SameCamera(depth_camera, color_camera)) json["color_camera"] = CameraJson(color_camera);
  if (!T_color_depth.matrix().isIdentity(0)) json["T_color_depth"] = RowsJson(T_color_depth);
  WriteStreamAtomically(path, [&](std::ostream& stream) { stream << json.dump() << "\n"; });
}

}  // namespace curvefusion
