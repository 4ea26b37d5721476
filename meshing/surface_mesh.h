#pragma once

// Brings in OpenMesh, whose warnings are silenced here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wextra"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#pragma GCC diagnostic pop

#include <optional>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// A half-edge triangle mesh in metres with float32 coordinates.
using SurfaceMesh = OpenMesh::TriMesh_ArrayKernelT<>;

/// Builds the half-edges of an indexed mesh; nothing where it is not an oriented manifold (with or
/// without boundary). Vertex and face indices stay the same.
std::optional<SurfaceMesh> ToSurfaceMesh(const TriangleMesh& mesh);

/// The live vertices and faces of a mesh, in order.
TriangleMesh ToTriangleMesh(const SurfaceMesh& mesh);

}  // namespace curvefusion
