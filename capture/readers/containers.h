#pragma once

#include <filesystem>
#include <string>

namespace curvefusion {

/// What a recording in one file is that is not read (.r3d), and how to export it to a layout
/// that is: "a recording of ...; export it with ...". Empty for other files, told by their names.
std::string ExportRemedy(const std::filesystem::path& file);

}  // namespace curvefusion
