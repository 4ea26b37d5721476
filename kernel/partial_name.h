#pragma once

#include <filesystem>

namespace curvefusion {

// What is being written has a temporary name that tells which process writes it:
// "mesh.partial-SPACE-PID.ply" for mesh.ply, "scan.partial-SPACE-PID" for the folder scan.

/// The temporary name of a file, with its extension at the end for writers that look at it.
std::filesystem::path PartialFilePath(const std::filesystem::path& file);

/// The temporary name of a folder.
std::filesystem::path PartialFolderPath(const std::filesystem::path& folder);

/// Whether a name is a temporary one of a process that is gone, of this host and container.
bool IsStalePartial(const std::filesystem::path& path);

/// Removes what processes that are gone have left of a file or folder of this name. What cannot be
/// removed stays.
void RemoveStalePartials(const std::filesystem::path& final_path);

/// The same for all names inside a folder.
void RemoveStalePartialsIn(const std::filesystem::path& folder);

}  // namespace curvefusion
