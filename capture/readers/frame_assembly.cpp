#include "capture/readers/frame_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>

#include "kernel/error.h"

namespace curvefusion {

namespace {

std::optional<long long> FrameNumber(const std::string& name) {
  const size_t begin = name.find_first_of("0123456789");
  if (begin == std::string::npos) return std::nullopt;
  long long number = 0;
  const auto result = std::from_chars(name.data() + begin, name.data() + name.size(), number);
  if (result.ec != std::errc()) return std::nullopt;
  return number;
}

bool IsImageName(const std::string& name, const std::string& kind) {
  for (const char* extension : {".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG"}) {
    if (name.ends_with(kind + extension)) return true;
  }
  return false;
}

}  // namespace

NumberedImages ImagesByFrameNumber(const std::filesystem::path& folder, const std::string& kind) {
  if (!std::filesystem::is_directory(folder)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: this folder of images is missing", folder.string()));
  }
  NumberedImages images;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const auto number = FrameNumber(name);
    if (!number || name.front() == '.' || !IsImageName(name, kind)) continue;
    const auto [other, is_new] = images.emplace(*number, entry.path());
    if (is_new) continue;
    const auto [first, second] = std::minmax(other->second.filename().string(), name);
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: {} and {} have the same frame number {}; keep one of them",
                            folder.string(), first, second, *number));
  }
  return images;
}

std::filesystem::path ColorFolder(const std::filesystem::path& folder) {
  for (const char* name : {"color", "colour", "rgb", "image", "images"}) {
    if (std::filesystem::is_directory(folder / name)) return folder / name;
  }
  return folder / "color";
}

void UseIntrinsics(const Intrinsics& intrinsics, double default_depth_scale, Sequence& sequence) {
  sequence.depth_camera = intrinsics.depth_camera;
  sequence.color_camera = intrinsics.color_camera;
  sequence.depth_distortion = intrinsics.depth_distortion;
  sequence.color_distortion = intrinsics.color_distortion;
  sequence.T_color_depth = intrinsics.T_color_depth;
  sequence.depth_scale = intrinsics.depth_scale.value_or(default_depth_scale);
}

std::optional<RigidTransform> NoPose(int /*rank*/, const std::filesystem::path& /*depth_path*/) {
  return RigidTransform::Identity();
}

void AddFrames(NumberedImages color, const NumberedImages& depth, const PoseLookup& find_pose,
               Sequence& sequence) {
  int rank = 0;
  for (const auto& [number, depth_path] : depth) {
    const auto partner = color.extract(number);
    const auto pose = find_pose(rank++, depth_path);
    if (!partner) {
      ++sequence.frames_without_partner;
    } else if (!pose) {
      ++sequence.frames_without_pose;
    } else {
      sequence.frames.push_back({FrameName(depth_path), static_cast<double>(number), *pose,
                                 partner.mapped(), depth_path});
    }
  }
  sequence.frames_without_partner += static_cast<int>(color.size());
}

std::string FrameName(const std::filesystem::path& image) {
  const std::string name = image.filename().string();
  return name.substr(0, name.find('.'));
}

}  // namespace curvefusion
