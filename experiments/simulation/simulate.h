#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "experiments/simulation/block_matching.h"
#include "experiments/simulation/color_camera.h"
#include "experiments/simulation/motion.h"
#include "experiments/simulation/objects.h"
#include "experiments/simulation/scene.h"
#include "kernel/progress.h"

namespace curvefusion {

/// To be raised with every change of the bytes of a simulated scan: what keeps scans under a name
/// then makes them anew.
inline constexpr int kSimulatorVersion = 3;

/// A scan to simulate.
struct SimulationOptions {
  std::string object = "cubeframe";      ///< one of ObjectNames(), or of object_options.curves
  std::string sensor = "kinect_v1";      ///< one of SensorNames()
  std::string pose_source = "orbslam2";  ///< one of PoseSourceNames()
  uint64_t seed = 1;
  int frames = 150;
  double pose_error_scale = 1;          ///< factor on the pose source's errors
  bool large_color = false;             ///< colour at 1280x1024 instead of 640x480
  double registration_error_px = 1;     ///< fixed shift between depth and colour, in depth pixels
  double registration_jitter_px = 0.5;  ///< standard deviation of its change from frame to frame
  double readout_time = 0;  ///< seconds from first to last row (rolling shutter); 0 = all at once
  ColorOptions color;
  ObjectOptions object_options;
  SceneOptions scene;
  MotionOptions motion;
  BlockMatchingOptions matching;  ///< of kinect_v1 and primesense
};

void VisitOptions(SimulationOptions& options, OptionVisitor& visitor);

/// About the most that a scan takes on the disk.
std::uintmax_t ScanBytes(const SimulationOptions& options);

/// Simulates a scan into `folder`, which must not exist or be empty: a TUM sequence with depth/,
/// rgb/, depth.txt, rgb.txt, associations.txt, trajectory.txt with the pose source's errors and
/// intrinsics.json; and the truth: truth/skeleton.json with radii, truth/curves.json,
/// truth/trajectory.txt without errors, truth/scene.json, and truth/settings.json, from which
/// ReadScanSettings has the same scan again. The folder gets its name when all is
/// written. The same options give the same bytes for any number of threads. Frames are made in
/// parallel; one takes about .4 s of one core. Throws Error(kUsage) for an unknown name, a count
/// that is not positive, a readout longer than a frame, a distance out of the sensor's range, wires
/// thicker than their spacing, or a folder that is not empty; Error(kResource) where a file cannot
/// be written or the disk has less room than ScanBytes.
void SimulateScan(const SimulationOptions& options, const std::filesystem::path& folder,
                  const Progress& progress);

}  // namespace curvefusion
