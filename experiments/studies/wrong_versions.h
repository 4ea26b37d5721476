#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/content/geometry_check.h"

namespace curvefusion {

/// A mistake that people make with a scan.
struct WrongVersion {
  std::string name;   ///< "translations_mm"
  std::string cause;  ///< what `check` should call it
};

/// All mistakes there are: conventions of poses, units, clocks, orders, jumps, lost tracking, a
/// wrong colour camera.
std::vector<WrongVersion> WrongVersions();

/// Writes a scan with a mistake into `folder`: links to its images (swapped bytes: new ones), wrong
/// poses, lists or intrinsics. Returns what `check` should find: cause, frames and amount. Throws
/// Error(kUsage) for another name.
Mistake WriteWrongVersion(const std::filesystem::path& scan, const std::string& name,
                          const std::filesystem::path& folder);

}  // namespace curvefusion
