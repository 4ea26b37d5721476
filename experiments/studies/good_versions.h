#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace curvefusion {

/// What can be made of a simulated scan without a mistake: "first_third" and "every_third" of its
/// frames, "twelve" of them, and "poses_NAME", the true poses with the errors of every pose source.
std::vector<std::string> GoodVersions();

/// Writes such a version into `folder`: links to the images of `scan`, which must have a truth for
/// poses. Throws Error(kUsage) for another name.
void WriteGoodVersion(const std::filesystem::path& scan, const std::string& name,
                      const std::filesystem::path& folder);

}  // namespace curvefusion
