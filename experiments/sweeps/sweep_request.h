#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/studies/study.h"
#include "experiments/sweeps/setting_points.h"

namespace curvefusion {

/// What a study file asks for: every point of settings on every scan, with every profile.
struct SweepRequest {
  Split split = Split::kTrain;
  int seeds = 3;
  std::vector<Profile> profiles = {Profile::kBest};
  std::vector<std::string> objects;                  ///< of the simulator
  std::vector<std::string> families;                 ///< of random scans
  std::vector<std::string> sensors = {"kinect_v1"};  ///< of objects
  std::vector<std::string> poses = {"orbslam2"};     ///< of objects
  int frames = 0;  ///< of objects, otherwise 150; of families at most, otherwise as drawn
  std::vector<SettingPoint> points = {{}};  ///< the first is the profile as it is
  int threads = 1;                          ///< of a cell
  int shards = 1;                           ///< of a cell of the best profile
  int memory_mb = 2000;                     ///< that a cell may need, for whoever places it
};

/// Reads a study file (docs/sweeps.md). Throws Error(kBadInput) where it cannot be read, and
/// Error(kUsage), naming file and key, for what is no TOML, keys, objects, families, sensors and
/// sources of poses that are none (with the nearest one), numbers out of their range, a study
/// without scans, and one that compares settings on the validation or test split.
SweepRequest ReadSweepRequest(const std::filesystem::path& path);

}  // namespace curvefusion
