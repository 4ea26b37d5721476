#pragma once

#include <filesystem>

#include "kernel/image.h"

namespace curvefusion {

/// Writes a picture as a PNG file, atomically. Throws Error(kResource) where it cannot be written.
void WritePng(const std::filesystem::path& path, const ColorImage& picture);

}  // namespace curvefusion
