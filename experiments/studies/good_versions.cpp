#include "experiments/studies/good_versions.h"

#include <string_view>

#include "capture/content/repair.h"
#include "capture/sequence.h"
#include "capture/trajectory.h"
#include "experiments/simulation/drift.h"
#include "experiments/simulation/scan_settings.h"
#include "kernel/error.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

constexpr size_t kFew = 12;  // fewer are said to be few
constexpr std::string_view kPoses = "poses_";

template <class Choice>
void KeepFrames(Sequence& sequence, const Choice& choice) {
  std::vector<SequenceFrame> kept;
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    if (choice(i, sequence.frames.size())) kept.push_back(sequence.frames[i]);
  }
  sequence.frames = std::move(kept);
}

// The scan's frames are all of those of its truth, in the same order.
void TakePosesOf(const std::string& source, const fs::path& scan, Sequence& sequence) {
  const SimulationOptions settings = ReadScanSettings(scan / "truth" / "settings.json");
  std::vector<RigidTransform> poses;
  for (const StampedPose& pose :
       ReadTumTrajectory(scan / "truth" / "trajectory.txt", [](const CheckFinding&) {})) {
    poses.push_back(pose.T_world_camera);
  }
  poses = DriftedPoses(poses, settings.motion.frame_rate, PoseErrorOf(source), settings.seed);
  for (size_t i = 0; i < sequence.frames.size(); ++i) {
    sequence.frames[i].T_world_camera = poses.at(i);
  }
}

}  // namespace

std::vector<std::string> GoodVersions() {
  std::vector<std::string> names = {"first_third", "every_third", "twelve"};
  for (const std::string& source : PoseSourceNames()) names.push_back(kPoses.data() + source);
  return names;
}

void WriteGoodVersion(const fs::path& scan, const std::string& name, const fs::path& folder) {
  Sequence sequence = OpenSequence(scan);
  if (name == "first_third") {
    KeepFrames(sequence, [](size_t i, size_t count) { return i < (count + 2) / 3; });
  } else if (name == "every_third") {
    KeepFrames(sequence, [](size_t i, size_t) { return i % 3 == 0; });
  } else if (name == "twelve") {
    KeepFrames(sequence, [](size_t i, size_t count) {
      return i == 0 || i * kFew / count != (i - 1) * kFew / count;
    });
  } else if (name.starts_with(kPoses)) {
    TakePosesOf(name.substr(kPoses.size()), scan, sequence);
  } else {
    throw Error(ErrorKind::kUsage, "there is no good version " + name);
  }
  WriteRepairedSequence({sequence, false, {}}, folder);
}

}  // namespace curvefusion
