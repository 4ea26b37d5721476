#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curvefusion {

/// A mistake that people make with a scan.
struct WrongVersion {
  std::string name;   ///< "translations_mm"
  std::string cause;  ///< what `check` should call it
};

/// All mistakes there are, thirty of them: conventions of poses, units, clocks, orders, jumps.
std::vector<WrongVersion> WrongVersions();

/// Writes a scan with a mistake into `folder`: links to its images (swapped bytes: new ones), wrong
/// poses, lists or intrinsics. An empty name writes it as it is. Throws Error(kUsage) for another.
void WriteWrongVersion(const std::filesystem::path& scan, const std::string& name,
                       const std::filesystem::path& folder);

}  // namespace curvefusion
