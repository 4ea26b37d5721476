#pragma once

#include <filesystem>
#include <optional>

#include "kernel/triangle_mesh.h"
#include "meshing/corner_normals.h"

namespace curvefusion {

/// The unit of length of a mesh file; meshes in memory are in metres.
enum class MeshUnit { kMetres, kMillimetres };

/// How a mesh file is written.
struct MeshFileOptions {
  std::optional<MeshUnit> unit;    ///< by default that of the format
  bool require_watertight = true;  ///< false for surfaces that are open by nature (a scan's volume)
  /// For formats that hold them (GLB); by default ComputeCornerNormals'.
  const CornerNormals* normals = nullptr;
};

/// The unit in which a format is written unless asked for another: metres, of 3MF millimetres.
/// Throws Error(kUsage) for an extension that is none of WriteMesh's.
MeshUnit DefaultUnit(const std::filesystem::path& path);

/// The unit of a format that has but one; nothing of those whose files do not tell their unit.
/// Throws like DefaultUnit.
std::optional<MeshUnit> OnlyUnit(const std::filesystem::path& path);

/// Throws Error(kUsage) where WriteMesh would refuse this file for its extension or unit, so that
/// long work before it can be spared.
void CheckMeshFormat(const std::filesystem::path& path, std::optional<MeshUnit> unit);

/// Writes a mesh as PLY (binary), OBJ, STL (binary), GLB or 3MF, by the extension of `path`. The
/// file is read back and compared coordinate by coordinate, and examined where it has to be
/// watertight, before it gets its final name: what stands there is whole and sound. Throws Error:
/// kUsage for another extension or a unit that the format does not have (GLB is in metres, 3MF
/// here in millimetres), kBadInput for a mesh (as rounded in the file's unit) that is not
/// watertight, kResource for a file that cannot be written or does not hold what was written.
void WriteMesh(const std::filesystem::path& path, const TriangleMesh& mesh,
               const MeshFileOptions& options);

/// Reads a triangle mesh from PLY, OBJ, binary STL, GLB or 3MF, in the unit of the file. Throws
/// Error: kUsage for another extension, kBadInput for a file that is missing, damaged, has indices
/// out of range or coordinates that are not finite, or is not of triangles.
TriangleMesh ReadMesh(const std::filesystem::path& path);

}  // namespace curvefusion
