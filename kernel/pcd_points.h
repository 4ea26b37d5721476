#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Whether the content of a file is a point cloud of the Point Cloud Library.
bool IsPcd(std::string_view content);

/// The positions in a PCD file (version 0.5 to 0.7; ascii, binary or binary_compressed), without
/// the points whose x, y or z is NaN, with which organised clouds mark what was not measured. Other
/// fields and the viewpoint are ignored. Throws Error(kBadInput) naming `path`, what is wrong and
/// where.
std::vector<Vec3> ReadPcdPoints(const std::filesystem::path& path, std::string_view content);

}  // namespace curvefusion
