#pragma once

#include <filesystem>

#include "kernel/progress.h"

namespace curvefusion {

/// What the demo scan consists of.
struct DemoScanOptions {
  int frame_count = 75;
  int width = 640;
  int height = 480;
};

/// Writes a made-up scan of a wire frame as a TUM sequence folder (rgb/, depth/, rgb.txt,
/// depth.txt, trajectory.txt, intrinsics.json), so that everything can be tried without a camera.
/// The same files for any number of threads. Existing files of these names are replaced. Throws
/// Error(kResource) where the folder cannot be written.
void WriteDemoScan(const std::filesystem::path& folder, const DemoScanOptions& options,
                   const Progress& progress);

}  // namespace curvefusion
