#include "capture/detect_format.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/unpack_videos.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxProposals = 3;  // chosen: a message of one line

bool LooksLikeTum(const fs::path& folder) {
  return fs::exists(folder / "depth.txt") || fs::exists(folder / "associations.txt") ||
         (fs::exists(folder / "rgb.txt") && HasTumTrajectory(folder));
}

bool HasTrajectoryLog(const fs::path& folder) { return fs::exists(folder / "trajectory.log"); }

bool HasPoseFolder(const fs::path& folder) { return fs::is_directory(folder / "pose"); }

bool HasImageFolders(const fs::path& folder) {
  return fs::is_directory(folder / "depth") && !fs::is_empty(folder / "depth") &&
         fs::is_directory(ColorFolder(folder));
}

bool LooksLikeRedwood(const fs::path& folder) {
  return HasTrajectoryLog(folder) || (HasImageFolders(folder) && !HasPoseFolder(folder) &&
                                      fs::exists(folder / "intrinsic.json"));
}

bool LooksLikePerFramePoses(const fs::path& folder) {
  return HasPoseFolder(folder) ||
         (HasImageFolders(folder) && fs::exists(folder / "intrinsics.json"));
}

bool HasFilesEndingWith(const fs::path& folder, const std::string& ending) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("frame-") && name.ends_with(ending)) return true;
  }
  return false;
}

bool LooksLikeSevenScenes(const fs::path& folder) {
  return HasFilesEndingWith(folder, ".depth.png");
}

bool HasPoseFiles(const fs::path& folder) { return HasFilesEndingWith(folder, ".pose.txt"); }

using Reader = Sequence (*)(const fs::path& folder, const FindingHandler& on_finding);

// A layout of a folder, or a recording in one file.
struct Format {
  const char* name;
  bool (*matches)(const fs::path& path);
  bool (*has_poses)(const fs::path& path);
  Reader read;
  Reader read_images;
};

constexpr std::array<Format, 8> kFolders = {{
    {"icl-nuim", LooksLikeIclNuim, LooksLikeIclNuim, ReadIclNuim, ReadIclNuimImages},
    {"tum", LooksLikeTum, HasTumTrajectory, ReadTum, ReadTumImages},
    {"redwood", LooksLikeRedwood, HasTrajectoryLog, ReadRedwood, ReadRedwoodImages},
    {"per-frame poses", LooksLikePerFramePoses, HasPoseFolder, ReadPerFramePoses,
     ReadPerFrameImages},
    {"7-scenes", LooksLikeSevenScenes, HasPoseFiles, ReadSevenScenes, ReadSevenScenesImages},
    {"nerfstudio", HasTransforms, HasTransforms, ReadNerfstudio, ReadNerfstudioImages},
    {"stray scanner", LooksLikeStrayScanner, LooksLikeStrayScanner, ReadStrayScanner,
     ReadStrayScannerImages},
    {"colmap", HasColmapModel, HasColmapModel, ReadColmap, ReadColmapImages},
}};

constexpr std::array<Format, 3> kRecordings = {{
    {"azure kinect mkv", IsMkv, HasMkvPoses, ReadAzureKinect, ReadAzureKinectImages},
    {"realsense bag", IsBag, HasBagPoses, ReadRealSense, ReadRealSenseImages},
    {"sens", IsSens, HasSensPoses, ReadSens, ReadSensImages},
}};

// Null where the file is none.
const Format* RecordingOf(const fs::path& file) {
  const auto found = std::find_if(kRecordings.begin(), kRecordings.end(),
                                  [&](const Format& format) { return format.matches(file); });
  return found == kRecordings.end() ? nullptr : &*found;
}

// The first that matches and has poses, or else the first that matches: a folder may hold the files
// of several. Null where none does.
const Format* FormatOf(const fs::path& path) {
  if (!fs::is_directory(path)) return RecordingOf(path);
  const auto matches = [&](const Format& format) { return format.matches(path); };
  const auto complete = [&](const Format& format) {
    return format.matches(path) && format.has_poses(path);
  };
  auto found = std::find_if(kFolders.begin(), kFolders.end(), complete);
  if (found == kFolders.end()) found = std::find_if(kFolders.begin(), kFolders.end(), matches);
  return found == kFolders.end() ? nullptr : &*found;
}

// The first scans, by name, among what is inside a folder. Those that cannot be read are not.
std::vector<std::string> ScansInside(const fs::path& folder) {
  std::vector<std::string> scans;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    try {
      if (FormatOf(entry.path()) != nullptr) scans.push_back(entry.path().string());
    } catch (const fs::filesystem_error&) {
    }
  }
  std::sort(scans.begin(), scans.end());
  if (scans.size() > kMaxProposals) scans.resize(kMaxProposals);
  return scans;
}

// What a recording in one file is that is not read (.r3d), and how to export it to a layout that
// is. Empty for other files, told by their names.
std::string ExportRemedy(const fs::path& file) {
  if (file.extension() != ".r3d") return {};
  return fmt::format(
      "a recording of Record3D; it is a zip file (unzip '{}' -d DIR) of colour images, depth "
      "(LZFSE, float32, metres) and poses in 'metadata': write depth as 16-bit PNG in mm and "
      "poses and cameras as transforms.json (nerfstudio)",
      file.string());
}

// What keeps images of depth and colour from being a scan: nothing tells of the cameras.
void FailWithoutIntrinsics(const fs::path& folder) {
  if (!HasImageFolders(folder)) return;
  const bool is_misnamed = fs::exists(folder / "camera_intrinsic.json");
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: {} and depth are there, but {}", folder.string(),
                          ColorFolder(folder).filename().string(),
                          is_misnamed ? "not intrinsic.json; rename camera_intrinsic.json to that"
                                      : "not intrinsics.json, which tells the cameras' focal "
                                        "lengths and the unit of depth (docs/formats_input.md)"));
}

[[noreturn]] void FailUnknownFormat(const fs::path& folder) {
  const std::string unpacking = VideoRemedy(folder);
  if (!unpacking.empty()) throw Error(ErrorKind::kBadInput, unpacking);
  const std::vector<std::string> scans = ScansInside(folder);
  if (!scans.empty()) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no scan but holds {}; did you mean {}?", folder.string(),
                            scans.size() == 1 ? "one" : "some", fmt::join(scans, " or ")));
  }
  if (fs::is_empty(folder)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: the folder is empty", folder.string()));
  }
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string remedy = ExportRemedy(entry.path());
    if (remedy.empty()) continue;
    throw Error(ErrorKind::kBadInput, fmt::format("{}: is {}", entry.path().string(), remedy));
  }
  FailWithoutIntrinsics(folder);
  throw Error(
      ErrorKind::kBadInput,
      fmt::format(
          "{}: the format of this folder is unknown; name a recording (.sens, RealSense's .bag, "
          "Azure Kinect's .mkv) or a folder that holds one of: rgb.txt, depth.txt and "
          "trajectory.txt (TUM); color/ (or rgb/, image/), depth/, intrinsics.json and, if poses "
          "are known, pose/ (per-frame poses); "
          "color/, depth/ and "
          "trajectory.log (Open3D, Redwood); frame-000000.depth.png and so on (7-Scenes); "
          "transforms.json (nerfstudio, instant-ngp); images/, depth/ and cameras.txt or .bin in "
          "it "
          "or in sparse/0 (COLMAP); odometry.csv, camera_matrix.csv, depth/ and rgb.mp4 (Stray "
          "Scanner)",
          folder.string()));
}

void ReportDroppedFrames(const Sequence& sequence, const FindingHandler& on_finding) {
  const int kept = sequence.frame_count();
  const int total = kept + sequence.frames_without_pose + sequence.frames_without_partner / 2;
  const std::string counts = fmt::format(
      "{}: {} of {} frames have {}both images ({} without a pose, {} colour or depth images "
      "without the other)",
      sequence.folder.string(), kept, total, sequence.has_poses ? "a pose and " : "",
      sequence.frames_without_pose, sequence.frames_without_partner);
  if (kept == 0) {
    on_finding({Severity::kError, counts + "; compare the stamps or names of the images with those "
                                           "of the poses"});
  } else if (2 * kept < total) {
    on_finding({Severity::kWarning,
                counts + "; stamps must agree to 20 ms: do images and poses use the same clock?"});
  }
}

// Lists of images may name depth that was never copied.
bool HasDepthFiles(const Sequence& sequence) {
  return sequence.has_depth &&
         (sequence.frames.empty() || sequence.IsRecording() ||
          std::any_of(sequence.frames.begin(), sequence.frames.end(),
                      [](const SequenceFrame& frame) { return fs::exists(frame.depth_path); }));
}

// Leaves depth out where it is not there or not to be used. Throws where it is needed.
void UseDepth(DepthUse use, Sequence& sequence, const FindingHandler& on_finding) {
  const std::string folder = sequence.folder.string();
  if (use == DepthUse::kNeeded && sequence.has_depth) return;
  if (use == DepthUse::kNeeded) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has no depth images; give a 16-bit PNG for every colour image "
                            "(docs/formats_input.md), or let `curvefusion reconstruct` make curves "
                            "from colour images and poses alone (--depth auto or none)",
                            folder));
  }
  const bool is_given = HasDepthFiles(sequence);
  if (use == DepthUse::kIfGiven && is_given) return;
  if (!sequence.has_poses) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: neither depth images nor camera poses are there to go by; give "
                            "poses, as COLMAP's model (sparse/0) or nerfstudio's transforms.json "
                            "beside the colour images, or depth images, by which the camera is "
                            "tracked",
                            folder));
  }
  sequence = WithoutDepth(std::move(sequence));
  if (is_given) return;
  on_finding({Severity::kWarning,
              fmt::format("{}: has no depth images: curves come from colour images alone, and "
                          "their scale is that of the poses, which must be in metres",
                          folder),
              "no-depth"});
}

// Throws for a file that is no recording.
void RequireRecording(const fs::path& file) {
  const std::string obstacle = ReadingObstacle(file);
  if (!obstacle.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", file.string(), obstacle));
  }
  if (RecordingOf(file) != nullptr) return;
  const std::string remedy = ExportRemedy(file);
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: is {}", file.string(),
                          remedy.empty() ? "a file; name the folder that holds the scan, or a "
                                           "recording with depth (.sens, .bag, .mkv)"
                                         : remedy));
}

// Throws for a file that is no recording and for a folder whose files cannot be listed.
void RequireReadable(const fs::path& path) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (status.type() == fs::file_type::not_found) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: there is no such folder or recording", path.string()));
  }
  if (fs::exists(status) && !fs::is_directory(status)) return RequireRecording(path);
  if (!failure) fs::directory_iterator(path, failure);
  if (!failure && ::access(path.c_str(), X_OK) != 0) {
    failure = std::error_code(errno, std::generic_category());
  }
  if (failure) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be read ({})", path.string(), failure.message()));
  }
}

// Reads with a reader. Where it fails and images are still videos, the error is that.
Sequence ReadUnpacked(Reader read, const fs::path& folder, const FindingHandler& on_finding) {
  try {
    return read(folder, on_finding);
  } catch (const Error&) {
    const std::string remedy = fs::is_directory(folder) ? VideoRemedy(folder) : "";
    if (remedy.empty()) throw;
    throw Error(ErrorKind::kBadInput, remedy);
  }
}

}  // namespace

Sequence ReadSequence(const fs::path& folder, PoseUse poses, DepthUse depth,
                      const FindingHandler& on_finding) {
  RequireReadable(folder);
  const Format* format = FormatOf(folder);
  if (format == nullptr) FailUnknownFormat(folder);
  const bool with_poses =
      poses == PoseUse::kNeeded || (poses == PoseUse::kIfGiven && format->has_poses(folder));
  Sequence sequence =
      ReadUnpacked(with_poses ? format->read : format->read_images, folder, on_finding);
  sequence.has_poses = with_poses;
  sequence.format = format->name;
  sequence.folder = folder;
  UseDepth(depth, sequence, on_finding);
  ReportDroppedFrames(sequence, on_finding);
  return sequence;
}

Sequence ReadQuietly(const fs::path& folder) {
  return ReadSequence(folder, PoseUse::kIfGiven, DepthUse::kNeeded, [](const CheckFinding&) {});
}

}  // namespace curvefusion
