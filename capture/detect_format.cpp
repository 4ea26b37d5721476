#include "capture/detect_format.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <vector>

#include "capture/readers/containers.h"
#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxProposals = 3;  // chosen: a message of one line

bool LooksLikeTum(const fs::path& folder) {
  return fs::exists(folder / "depth.txt") || fs::exists(folder / "associations.txt");
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

struct Format {
  const char* name;
  bool (*matches)(const fs::path& folder);
  bool (*has_poses)(const fs::path& folder);
  Reader read;
  Reader read_images;
};

constexpr std::array<Format, 8> kFormats = {{
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

// The first that matches and has poses, or else the first that matches: a folder may hold the files
// of several. Null where none does.
const Format* FormatOf(const fs::path& folder) {
  const auto matches = [&](const Format& format) { return format.matches(folder); };
  const auto complete = [&](const Format& format) {
    return format.matches(folder) && format.has_poses(folder);
  };
  auto found = std::find_if(kFormats.begin(), kFormats.end(), complete);
  if (found == kFormats.end()) found = std::find_if(kFormats.begin(), kFormats.end(), matches);
  return found == kFormats.end() ? nullptr : &*found;
}

// The first scans, by name, among the folders inside a folder. Those that cannot be read are not.
std::vector<std::string> ScansInside(const fs::path& folder) {
  std::vector<std::string> scans;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    try {
      if (entry.is_directory() && FormatOf(entry.path()) != nullptr) {
        scans.push_back(entry.path().string());
      }
    } catch (const fs::filesystem_error&) {
    }
  }
  std::sort(scans.begin(), scans.end());
  if (scans.size() > kMaxProposals) scans.resize(kMaxProposals);
  return scans;
}

[[noreturn]] void FailUnknownFormat(const fs::path& folder) {
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
  throw Error(
      ErrorKind::kBadInput,
      fmt::format(
          "{}: the format of this folder is unknown; it must hold one of: rgb.txt, depth.txt and "
          "trajectory.txt (TUM); color/ (or rgb/, image/), depth/, intrinsics.json and pose/ "
          "(per-frame poses); "
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

// Throws where its files cannot be listed.
void RequireFolder(const fs::path& folder) {
  std::error_code failure;
  const fs::file_status status = fs::status(folder, failure);
  if (status.type() == fs::file_type::not_found) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: there is no such folder", folder.string()));
  }
  if (fs::exists(status) && !fs::is_directory(status)) {
    const std::string remedy = ExportRemedy(folder);
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is {}", folder.string(),
                            remedy.empty() ? "a file; name the folder of the sequence" : remedy));
  }
  if (!failure) fs::directory_iterator(folder, failure);
  if (!failure && ::access(folder.c_str(), X_OK) != 0) {
    failure = std::error_code(errno, std::generic_category());
  }
  if (failure) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: cannot be read ({})", folder.string(), failure.message()));
  }
}

}  // namespace

Sequence ReadSequence(const fs::path& folder, PoseUse use, const FindingHandler& on_finding) {
  RequireFolder(folder);
  const Format* format = FormatOf(folder);
  if (format == nullptr) FailUnknownFormat(folder);
  const bool with_poses =
      use == PoseUse::kNeeded || (use == PoseUse::kIfGiven && format->has_poses(folder));
  Sequence sequence = (with_poses ? format->read : format->read_images)(folder, on_finding);
  sequence.has_poses = with_poses;
  sequence.format = format->name;
  sequence.folder = folder;
  ReportDroppedFrames(sequence, on_finding);
  return sequence;
}

}  // namespace curvefusion
