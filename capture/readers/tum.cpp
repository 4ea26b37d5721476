#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/stamps.h"
#include "capture/text_lines.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

constexpr double kTumDepthUnits = 5000;
// ICL-NUIM, of its site: rendered at 30 Hz by a camera whose y runs up, so fy is -480 there. Its
// PNGs are stored from the top, as all are; the negative sign goes into the poses (Mirrored).
constexpr PinholeCamera kIclNuimCamera = {640, 480, 481.2, 480, 319.5, 239.5};
constexpr double kIclNuimFrameRate = 30;
constexpr const char* kTrajectoryNames[] = {"trajectory.txt", "groundtruth.txt"};

// A line "stamp path" of rgb.txt or depth.txt.
struct StampedImage {
  double timestamp = 0;
  std::string stamp;  // as it is written
  std::filesystem::path path;
};

struct ImagePair {
  StampedImage color;
  StampedImage depth;
};

StampedImage ParseStampedImage(const TextLine& line, size_t column,
                               const std::filesystem::path& list) {
  const auto stamp =
      column + 1 < line.fields.size() ? ParseNumber(line.fields[column]) : std::optional<double>();
  if (!stamp || !std::isfinite(*stamp)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}:{}: a stamp in seconds and a file name are needed at column {}",
                            list.string(), line.number, column + 1));
  }
  return {*stamp, line.fields[column], list.parent_path() / line.fields[column + 1]};
}

std::vector<StampedImage> ReadImageList(const std::filesystem::path& list,
                                        const FindingHandler& on_finding) {
  std::vector<StampedImage> images;
  for (const TextLine& line : ReadTextLines(list)) {
    images.push_back(ParseStampedImage(line, 0, list));
  }
  SortByStamp(
      list.string(), [](const StampedImage& image) { return image.timestamp; }, on_finding, images);
  return images;
}

std::vector<ImagePair> Associate(const std::vector<StampedImage>& color,
                                 const std::vector<StampedImage>& depth) {
  const auto stamps = [](const std::vector<StampedImage>& images) {
    std::vector<double> times;
    for (const StampedImage& image : images) times.push_back(image.timestamp);
    return times;
  };
  std::vector<ImagePair> pairs;
  for (const auto& [d, c] : AssociateStamps(stamps(depth), stamps(color), kAssociationTolerance)) {
    pairs.push_back({color[c], depth[d]});
  }
  return pairs;
}

// associations.txt comes with colour first or depth first; the folder's name tells.
std::vector<ImagePair> ReadAssociations(const std::filesystem::path& list,
                                        const FindingHandler& on_finding) {
  std::vector<ImagePair> pairs;
  for (const TextLine& line : ReadTextLines(list)) {
    ImagePair pair{ParseStampedImage(line, 0, list), ParseStampedImage(line, 2, list)};
    if (line.fields[1].find("depth") != std::string::npos) std::swap(pair.color, pair.depth);
    pairs.push_back(std::move(pair));
  }
  SortByStamp(
      list.string(), [](const ImagePair& pair) { return pair.depth.timestamp; }, on_finding, pairs);
  return pairs;
}

// Colour images without depth, which have its stamps.
std::vector<ImagePair> ColorOnly(const std::vector<StampedImage>& color, Sequence& sequence) {
  sequence.has_depth = false;
  std::vector<ImagePair> pairs;
  for (const StampedImage& image : color)
    pairs.push_back({image, {image.timestamp, image.stamp, {}}});
  return pairs;
}

std::vector<ImagePair> ReadPairs(const std::filesystem::path& folder,
                                 const FindingHandler& on_finding, Sequence& sequence) {
  if (std::filesystem::exists(folder / "associations.txt")) {
    return ReadAssociations(folder / "associations.txt", on_finding);
  }
  const auto color = ReadImageList(folder / "rgb.txt", on_finding);
  if (!std::filesystem::exists(folder / "depth.txt")) return ColorOnly(color, sequence);
  const auto depth = ReadImageList(folder / "depth.txt", on_finding);
  std::vector<ImagePair> pairs = Associate(color, depth);
  sequence.frames_without_partner =
      static_cast<int>(color.size() + depth.size() - 2 * pairs.size());
  return pairs;
}

SequenceFrame FrameOf(const ImagePair& pair, const RigidTransform& T_world_camera) {
  return {pair.depth.stamp, pair.depth.timestamp, T_world_camera,
          pair.color.path,  pair.depth.path,      pair.color.timestamp - pair.depth.timestamp};
}

// The file of poses that ICL-NUIM ships, such as livingRoom1.gt.freiburg; empty where none is
// there.
std::filesystem::path FreiburgPath(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".freiburg") paths.push_back(entry.path());
  }
  return paths.empty() ? std::filesystem::path() : *std::min_element(paths.begin(), paths.end());
}

// Poses of ICL-NUIM are rotations between two left-handed frames, y up; here y is down in both.
RigidTransform Mirrored(const RigidTransform& T_world_camera) {
  const Eigen::DiagonalMatrix<double, 3> flip(1, -1, 1);
  RigidTransform mirrored = RigidTransform::Identity();
  mirrored.linear() = flip * T_world_camera.linear() * flip;
  mirrored.translation() = flip * T_world_camera.translation();
  return mirrored;
}

Sequence ReadIclNuimWith(const std::filesystem::path& folder, bool with_poses,
                         const FindingHandler& on_finding) {
  Sequence sequence;
  Intrinsics intrinsics;
  intrinsics.depth_camera = intrinsics.color_camera = kIclNuimCamera;
  if (std::filesystem::exists(folder / "intrinsics.json")) {
    intrinsics = ReadIntrinsics(folder / "intrinsics.json", on_finding);
  }
  UseIntrinsics(intrinsics, kTumDepthUnits, sequence);
  const Trajectory trajectory =
      with_poses ? ReadTumTrajectory(FreiburgPath(folder), on_finding) : Trajectory();
  for (const ImagePair& pair : ReadPairs(folder, on_finding, sequence)) {
    const StampedPose* pose = NearestPose(trajectory, pair.depth.timestamp);
    if (with_poses && pose == nullptr) {
      ++sequence.frames_without_pose;
      continue;
    }
    sequence.frames.push_back(
        FrameOf(pair, with_poses ? Mirrored(pose->T_world_camera) : RigidTransform::Identity()));
    SequenceFrame& frame = sequence.frames.back();
    frame.timestamp /= kIclNuimFrameRate;  // the stamps are numbers of frames
    frame.color_delay = 0;
  }
  return sequence;
}

}  // namespace

bool LooksLikeIclNuim(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / "associations.txt") && !HasTumTrajectory(folder) &&
         !FreiburgPath(folder).empty();
}

Sequence ReadIclNuim(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  return ReadIclNuimWith(folder, true, on_finding);
}

Sequence ReadIclNuimImages(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  return ReadIclNuimWith(folder, false, on_finding);
}

bool HasTumTrajectory(const std::filesystem::path& folder) {
  return std::any_of(std::begin(kTrajectoryNames), std::end(kTrajectoryNames),
                     [&](const char* name) { return std::filesystem::exists(folder / name); });
}

std::filesystem::path TumTrajectoryPath(const std::filesystem::path& folder) {
  for (const char* name : kTrajectoryNames) {
    if (std::filesystem::exists(folder / name)) return folder / name;
  }
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: neither trajectory.txt nor groundtruth.txt is there; write the camera "
                  "poses as lines 't tx ty tz qx qy qz qw', or let `curvefusion track` find them",
                  folder.string()));
}

Sequence ReadTum(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  Sequence sequence;
  UseIntrinsics(ReadIntrinsics(folder / "intrinsics.json", on_finding), kTumDepthUnits, sequence);
  const Trajectory trajectory = ReadTumTrajectory(TumTrajectoryPath(folder), on_finding);
  for (const ImagePair& pair : ReadPairs(folder, on_finding, sequence)) {
    const StampedPose* pose = NearestPose(trajectory, pair.depth.timestamp);
    if (pose == nullptr) {
      ++sequence.frames_without_pose;
      continue;
    }
    sequence.frames.push_back(FrameOf(pair, pose->T_world_camera));
  }
  return sequence;
}

Sequence ReadTumImages(const std::filesystem::path& folder, const FindingHandler& on_finding) {
  Sequence sequence;
  sequence.format = "tum";
  sequence.folder = folder;
  UseIntrinsics(ReadIntrinsics(folder / "intrinsics.json", on_finding), kTumDepthUnits, sequence);
  for (const ImagePair& pair : ReadPairs(folder, on_finding, sequence)) {
    sequence.frames.push_back(FrameOf(pair, RigidTransform::Identity()));
  }
  return sequence;
}

}  // namespace curvefusion
