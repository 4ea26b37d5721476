#include "capture/readers/frame_assembly.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "capture/image_file.h"
#include "kernel/error.h"
#include "kernel/file_extension.h"

namespace curvefusion {

namespace {

// Chosen: a pixel of 100; 256x192 of 1920x1440 is exact, 640x360 of 640x480 is far off.
constexpr double kMaxProportionChange = 0.01;

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

// Tells of images in a format that is not read.
void RefuseOtherImages(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string extension = LowerCaseExtension(entry.path());
    for (const char* other : {".bmp", ".tif", ".tiff", ".pgm", ".ppm", ".webp", ".exr", ".npy"}) {
      if (extension != other) continue;
      throw Error(ErrorKind::kBadInput,
                  fmt::format("{}: is not read; convert the images to PNG (colour may be JPEG; "
                              "depth PNG of 16 bits)",
                              entry.path().string()));
    }
  }
}

// As text, but numbers by value.
bool ComesBefore(const std::string& a, const std::string& b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  size_t i = 0;
  size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    const auto number = [&](const std::string& text, size_t& at) {
      while (at < text.size() && text[at] == '0') ++at;
      const size_t begin = at;
      while (at < text.size() && is_digit(text[at])) ++at;
      return text.substr(begin, at - begin);
    };
    const std::string x = number(a, i);
    const std::string y = number(b, j);
    if (x != y) return x.size() != y.size() ? x.size() < y.size() : x < y;
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // "01" and "1"
}

void AddColorFrames(const NumberedImages& color, const PoseLookup& find_pose, Sequence& sequence) {
  sequence.has_depth = false;
  int rank = 0;
  for (const auto& [number, path] : color) {
    const auto pose = find_pose(rank++, path);
    if (pose) {
      sequence.frames.push_back({FrameName(path), static_cast<double>(number), *pose, path, {}});
    } else {
      ++sequence.frames_without_pose;
    }
  }
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
  if (images.empty()) RefuseOtherImages(folder);
  return images;
}

std::filesystem::path ColorFolder(const std::filesystem::path& folder) {
  for (const std::string_view name : kColorFolders) {
    if (std::filesystem::is_directory(folder / name)) return folder / name;
  }
  return folder / kColorFolders.front();
}

void UseIntrinsics(const Intrinsics& intrinsics, double default_depth_scale, Sequence& sequence) {
  sequence.depth_camera = intrinsics.depth_camera;
  sequence.color_camera = intrinsics.color_camera;
  sequence.depth_distortion = intrinsics.depth_distortion;
  sequence.color_distortion = intrinsics.color_distortion;
  sequence.T_color_depth = intrinsics.T_color_depth;
  sequence.depth_scale = intrinsics.depth_scale.value_or(default_depth_scale);
}

std::optional<RigidTransform> NoPose(int /*rank*/, const std::filesystem::path& /*image*/) {
  return RigidTransform::Identity();
}

NumberedImages DepthByFrameNumber(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder / "depth")) return {};
  return ImagesByFrameNumber(folder / "depth");
}

void AddFrames(NumberedImages color, const NumberedImages& depth, const PoseLookup& find_pose,
               Sequence& sequence) {
  if (depth.empty()) return AddColorFrames(color, find_pose, sequence);
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

PinholeCamera RegisteredDepthCamera(const PinholeCamera& color,
                                    const std::filesystem::path& depth_image) {
  const ImageHeader header = ReadImageHeader(depth_image);
  if (header.width <= 0 || header.height <= 0 || color.width <= 0) return color;
  const double scale_x = static_cast<double>(header.width) / color.width;
  const double scale_y = static_cast<double>(header.height) / color.height;
  if (std::abs(scale_x / scale_y - 1) > kMaxProportionChange) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: is {}x{}, the colour camera {}x{}; depth must show the view of "
                    "colour, in any size of the same proportion",
                    depth_image.string(), header.width, header.height, color.width, color.height));
  }
  return {header.width,
          header.height,
          color.fx * scale_x,
          color.fy * scale_y,
          (color.cx + 0.5) * scale_x - 0.5,
          (color.cy + 0.5) * scale_y - 0.5};
}

void NumberByColorPath(Sequence& sequence) {
  std::sort(sequence.frames.begin(), sequence.frames.end(),
            [](const SequenceFrame& a, const SequenceFrame& b) {
              return ComesBefore(a.color_path.string(), b.color_path.string());
            });
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    sequence.frames[i].timestamp = static_cast<double>(i);
  }
}

std::string FrameName(const std::filesystem::path& image) {
  const std::string name = image.filename().string();
  return name.substr(0, name.find('.'));
}

}  // namespace curvefusion
