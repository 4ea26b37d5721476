#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "capture/image_file.h"
#include "capture/json_fields.h"
#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/text_lines.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr double kMillimetreUnits = 1000;

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

double NumberAt(const TextLine& line, size_t column, const fs::path& path) {
  const auto number =
      column < line.fields.size() ? ParseNumber(line.fields[column]) : std::optional<double>();
  if (number) return *number;
  Fail(fmt::format("{}:{}: column {} is no number", path.string(), line.number, column + 1));
}

PinholeCamera ColorCamera(const fs::path& path, const fs::path& color_image) {
  const ImageHeader header = ReadImageHeader(color_image);
  const std::vector<TextLine> rows = ReadTextLines(path);
  if (rows.size() != 3) Fail(path.string() + ": a 3x3 camera matrix is needed, a row a line");
  const PinholeCamera camera = {header.width,
                                header.height,
                                NumberAt(rows[0], 0, path),
                                NumberAt(rows[1], 1, path),
                                NumberAt(rows[0], 2, path),
                                NumberAt(rows[1], 2, path)};
  if (header.defect.empty()) RequirePlausible(camera, path.string());
  return camera;
}

// Lines "timestamp, frame, x, y, z, qx, qy, qz, qw" below a header.
std::map<long long, StampedPose> ReadOdometry(const fs::path& path,
                                              const FindingHandler& on_finding) {
  std::map<long long, StampedPose> poses;
  for (const TextLine& line : ReadTextLines(path)) {
    if (line.fields[0] == "timestamp") continue;
    const double frame = NumberAt(line, 1, path);
    if (!(frame >= 0 && frame < 1e9)) {
      Fail(fmt::format("{}:{}: {} is no frame number", path.string(), line.number, frame));
    }
    Eigen::Matrix<double, 7, 1> values;
    for (size_t i = 0; i < 7; ++i) values[static_cast<int>(i)] = NumberAt(line, i + 2, path);
    const Eigen::Quaterniond rotation(values[6], values[3], values[4], values[5]);
    const auto pose = RigidFromQuaternion(
        rotation, values.head<3>(), fmt::format("{}:{}", path.string(), line.number), on_finding);
    if (pose) poses[static_cast<long long>(frame)] = {NumberAt(line, 0, path), *pose};
  }
  return poses;
}

// Poses and times of the frames, whose timestamps are their numbers; those without are dropped.
void UseOdometry(const std::map<long long, StampedPose>& poses, Sequence& sequence) {
  std::vector<SequenceFrame> frames;
  for (SequenceFrame& frame : sequence.frames) {
    const auto pose = poses.find(std::llround(frame.timestamp));
    if (pose == poses.end()) continue;
    frame.timestamp = pose->second.timestamp;
    frame.T_world_camera = pose->second.T_world_camera;
    frames.push_back(std::move(frame));
  }
  sequence.frames_without_pose = static_cast<int>(sequence.frames.size() - frames.size());
  sequence.frames = std::move(frames);
}

Sequence ReadWith(const fs::path& folder, bool with_poses, const FindingHandler& on_finding) {
  const NumberedImages color = ImagesByFrameNumber(ColorFolder(folder));
  const NumberedImages depth = ImagesByFrameNumber(folder / "depth");
  if (color.empty() || depth.empty()) Fail(folder.string() + ": holds no colour or depth images");
  Sequence sequence;
  sequence.depth_scale = kMillimetreUnits;
  sequence.color_camera = ColorCamera(folder / "camera_matrix.csv", color.begin()->second);
  sequence.depth_camera = RegisteredDepthCamera(sequence.color_camera, depth.begin()->second);
  AddFrames(color, depth, NoPose, sequence);
  if (with_poses) UseOdometry(ReadOdometry(folder / "odometry.csv", on_finding), sequence);
  return sequence;
}

}  // namespace

bool LooksLikeStrayScanner(const fs::path& folder) {
  return fs::exists(folder / "odometry.csv") && fs::exists(folder / "camera_matrix.csv");
}

Sequence ReadStrayScanner(const fs::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, true, on_finding);
}

Sequence ReadStrayScannerImages(const fs::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, false, on_finding);
}

}  // namespace curvefusion
