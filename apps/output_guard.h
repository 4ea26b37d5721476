#pragma once

#include <filesystem>
#include <vector>

namespace curvefusion {

/// Throws Error(kUsage) where the file to write is one of the files that are read, by whatever name
/// or link, so that no command destroys its input. Empty paths are none.
void RequireApart(const std::vector<std::filesystem::path>& inputs,
                  const std::filesystem::path& output);

/// Throws Error(kUsage) where `output` is a folder that is read or lies inside it.
void RequireOutside(const std::filesystem::path& input_folder, const std::filesystem::path& output);

}  // namespace curvefusion
