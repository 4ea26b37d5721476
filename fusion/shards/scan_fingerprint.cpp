#include "fusion/shards/scan_fingerprint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kIs = " = ";  // chosen: of the format (docs/formats_shard.md)

template <class Value>
void AddLine(const std::string& name, const Value& value, std::string& text) {
  text += fmt::format("{}{}{}\n", name, kIs, value);
}

std::string CameraText(const PinholeCamera& camera) {
  return fmt::format("{}x{} pixels, focal lengths {} and {}, centre {}, {}", camera.width,
                     camera.height, camera.fx, camera.fy, camera.cx, camera.cy);
}

std::string DistortionText(const Distortion& d) {
  const std::vector<double> numbers = {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6};
  return fmt::format("{}", fmt::join(numbers, " "));
}

// The first three rows, one after the other.
std::string PoseText(const RigidTransform& T) {
  std::vector<double> numbers;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) numbers.push_back(T(row, column));
  return fmt::format("{}", fmt::join(numbers, " "));
}

// Empty where it cannot be told: whoever reads the image says so.
std::string SizeText(const fs::path& file) {
  std::error_code failure;
  const std::uintmax_t bytes = fs::file_size(file, failure);
  return failure ? "" : fmt::format(" of {} bytes", bytes);
}

// "depth/000012.png of 31245 bytes", or "scan.bag, bytes 1000 to 2000".
std::string ImageText(const Sequence& sequence, const fs::path& file, const ImagePart& part) {
  if (!part.IsWholeFile()) {
    return fmt::format("{}, bytes {} to {} of chunk {}", file.filename().string(), part.offset,
                       part.offset + part.bytes, part.chunk.offset);
  }
  const fs::path name = file.lexically_normal().lexically_relative(
      (sequence.folder / "").lexically_normal().parent_path());
  return name.generic_string() + SizeText(file);
}

void AddFrame(const Sequence& sequence, const SequenceFrame& frame, std::string& text) {
  const std::string name = "frame " + frame.name + ", ";
  AddLine(name + "seconds", frame.timestamp, text);
  AddLine(name + "depth image", ImageText(sequence, frame.depth_path, frame.depth_part), text);
  AddLine(name + "colour image", ImageText(sequence, frame.color_path, frame.color_part), text);
  AddLine(name + "colour delay", frame.color_delay, text);
  if (sequence.has_poses) AddLine(name + "pose", PoseText(frame.T_world_camera), text);
}

ChangedLine Changed(std::string_view before, std::string_view now) {
  const auto name = [](std::string_view line) { return line.substr(0, line.find(kIs)); };
  const auto value = [](std::string_view line) {
    return std::string(line.substr(std::min(line.size(), line.find(kIs) + kIs.size())));
  };
  if (before.empty()) return {std::string(name(now)), "nothing", value(now)};
  return {std::string(name(before)), value(before),
          name(before) == name(now) ? value(now) : "nothing"};
}

}  // namespace

std::string ScanFingerprint(const Sequence& sequence) {
  std::string text;
  AddLine("format", sequence.format, text);
  AddLine("frames", sequence.frame_count(), text);
  AddLine("poses", sequence.has_poses ? "given" : "none", text);
  if (sequence.IsRecording()) AddLine("recording", SizeText(sequence.frames[0].depth_path), text);
  AddLine("depth camera", CameraText(sequence.depth_camera), text);
  AddLine("colour camera", CameraText(sequence.color_camera), text);
  AddLine("depth distortion", DistortionText(sequence.depth_distortion), text);
  AddLine("colour distortion", DistortionText(sequence.color_distortion), text);
  AddLine("T_color_depth", PoseText(sequence.T_color_depth), text);
  AddLine("depth scale", sequence.depth_scale, text);
  AddLine("invalid depth", sequence.invalid_depth, text);
  for (const SequenceFrame& frame : sequence.frames) AddFrame(sequence, frame, text);
  return text;
}

std::optional<ChangedLine> FirstChange(const std::string& before, const std::string& now) {
  LineScanner of_before(before), of_now(now);
  while (true) {
    std::string_view a, b;
    const bool more = of_before.Next(a);
    const bool more_now = of_now.Next(b);
    if (!more && !more_now) return std::nullopt;
    if (a != b) return Changed(a, b);
  }
}

}  // namespace curvefusion
