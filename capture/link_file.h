#pragma once

#include <filesystem>

namespace curvefusion {

/// Makes `link` a symbolic link to a file or folder, or a hard link where there are none. Throws
/// Error(kResource) naming both where neither can be made.
void LinkFile(const std::filesystem::path& file, const std::filesystem::path& link);

}  // namespace curvefusion
