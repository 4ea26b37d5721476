#pragma once

#include <filesystem>

#include "kernel/observed_points.h"

namespace curvefusion {

/// Reads a point cloud in the file's own unit; the caller scales it to metres. Three formats are
/// told apart by content:
/// - PLY (ascii or binary of either byte order): x, y, z; where present also `count` and ray_x,
///   ray_y, ray_z as WriteCloud writes them. Everything else is ignored; normals in particular are
///   not viewing rays.
/// - PCD (ascii, binary, binary_compressed): x, y, z; points that are NaN are left out.
/// - XYZ text: `x y z` or `x y z nx ny nz` on every line, normals ignored, '#' starts a comment.
/// Throws Error(kBadInput) that names file, line or vertex, and value: for a missing, empty or
/// truncated file or one of more than 4 GiB, a number that cannot be read or is not finite, and a
/// count that is not positive. A file that declares zero vertices is an empty cloud.
ObservedPoints ReadCloud(const std::filesystem::path& path);

/// Writes a binary little-endian PLY with x, y, z (double), ray_x, ray_y, ray_z (double) and count
/// (float): ReadCloud gives back the same bits. Throws Error(kResource) where it cannot be written.
void WriteCloud(const std::filesystem::path& path, const ObservedPoints& points);

}  // namespace curvefusion
