#include "capture/growing_folder.h"

#include <array>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "capture/intrinsics.h"
#include "capture/readers/frame_assembly.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

constexpr double kMillimetreUnits = 1000;
// Chosen: whoever writes a file of a few lines takes no longer from one write to the next.
constexpr std::chrono::seconds kWritten{2};
constexpr std::array<std::string_view, 2> kImageEnds = {
    "IEND\xAE\x42\x60\x82"sv,  // of a PNG
    "\xFF\xD9"sv,              // of a JPEG
};

bool IsThere(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

bool IsCompleteImage(const fs::path& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = file.tellg();
  for (const std::string_view end : kImageEnds) {
    const auto length = static_cast<std::streamoff>(end.size());
    if (size < length) continue;
    std::string tail(end.size(), '\0');
    file.seekg(size - length);
    if (file.read(tail.data(), length) && tail == end) return true;
  }
  return false;
}

// Nothing while it is missing or half there.
std::optional<RigidTransform> CompletePose(const fs::path& path) {
  if (!IsThere(path)) return std::nullopt;
  return ReadPoseMatrix(path, [](const CheckFinding&) {});
}

// A file that is no JSON yet, and was touched just now.
bool IsBeingWritten(const fs::path& json) {
  std::error_code unknown;
  const fs::file_time_type touched = fs::last_write_time(json, unknown);
  return !unknown && fs::file_time_type::clock::now() - touched < kWritten &&
         !nlohmann::json::accept(ReadFile(json));
}

// A folder may disappear between two looks at it.
NumberedImages ImagesIn(const fs::path& folder) {
  return IsThere(folder) ? ImagesByFrameNumber(folder) : NumberedImages();
}

}  // namespace

GrowingFolder::GrowingFolder(fs::path folder, bool use_poses)
    : folder_(std::move(folder)), use_poses_(use_poses) {}

std::optional<Sequence> GrowingFolder::Cameras() const {
  const fs::path intrinsics = folder_ / "intrinsics.json";
  if (!IsThere(intrinsics) || !IsThere(folder_ / "depth") || !IsThere(ColorFolder(folder_)) ||
      IsBeingWritten(intrinsics)) {
    return std::nullopt;
  }
  Sequence cameras;
  cameras.format = "per-frame poses";
  cameras.folder = folder_;
  cameras.has_poses = use_poses_;
  const Intrinsics read = ReadIntrinsics(intrinsics, [](const CheckFinding& finding) {
    if (finding.severity == Severity::kError) throw Error(ErrorKind::kBadInput, finding.message);
  });
  UseIntrinsics(read, kMillimetreUnits, cameras);
  return cameras;
}

std::vector<SequenceFrame> GrowingFolder::NewFrames() {
  const NumberedImages depth = ImagesIn(folder_ / "depth");
  const NumberedImages color = ImagesIn(ColorFolder(folder_));
  std::vector<SequenceFrame> frames;
  for (auto image = depth.upper_bound(last_number_); image != depth.end(); ++image) {
    const auto& [number, depth_path] = *image;
    const auto partner = color.find(number);
    if (partner == color.end() || !IsCompleteImage(depth_path) || !IsCompleteImage(partner->second))
      continue;
    SequenceFrame frame;
    frame.name = FrameName(depth_path);
    frame.timestamp = static_cast<double>(number);
    frame.depth_path = depth_path;
    frame.color_path = partner->second;
    frame.T_world_camera = RigidTransform::Identity();
    if (use_poses_) {
      const auto pose = CompletePose(folder_ / "pose" / (frame.name + ".txt"));
      if (!pose) continue;
      frame.T_world_camera = *pose;
    }
    frames.push_back(std::move(frame));
    last_number_ = number;
  }
  return frames;
}

bool GrowingFolder::HasEnded() const { return IsThere(folder_ / "end"); }

}  // namespace curvefusion
