#pragma once

#include <filesystem>

namespace curvefusion {

/// Makes a folder and its parents where they are missing and tries whether files can be written
/// into it, so that a long run does not fail at its end. Throws Error(kResource) naming the folder.
void MakeOutputFolder(const std::filesystem::path& folder);

/// The same for the folder that will hold a file; removes what killed runs have left of the file.
/// Throws Error(kResource) as well where a folder or a device has the file's name.
void MakeFolderOf(const std::filesystem::path& file);

}  // namespace curvefusion
