#pragma once

#include <filesystem>

#include "capture/content/geometry_check.h"

namespace curvefusion {

/// Writes a corrected copy of a sequence: symbolic links to the images, new lists, poses and
/// intrinsics. Only depth whose bytes were swapped, and images of recordings, are written anew. A
/// TUM sequence stays one, with associations.txt; the others become one pose a frame, or 7-Scenes
/// where they were. The folder gets its name when it is complete. Throws Error(kUsage) where it is
/// there and not empty, Error(kResource) where it cannot be written.
void WriteRepairedSequence(const SequenceCorrection& given, const std::filesystem::path& folder);

}  // namespace curvefusion
