#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "kernel/triangle_mesh.h"
#include "meshing/corner_normals.h"

namespace curvefusion {

/// The file formats of triangle meshes; float32 coordinates pass through all of them unchanged,
/// except for 3MF. Streams are binary. Readers take the stream's name for their messages and throw
/// Error(kBadInput) for what is cut off, damaged, or not a triangle mesh.

/// Binary little-endian PLY.
void WritePly(const TriangleMesh& mesh, std::ostream& stream);
/// ASCII or binary little-endian PLY; further properties and elements are skipped.
TriangleMesh ReadPly(std::istream& stream, const std::string& name);

/// Wavefront OBJ, nine digits.
void WriteObj(const TriangleMesh& mesh, std::ostream& stream);
/// Vertices and triangles of an OBJ file; other statements are skipped.
TriangleMesh ReadObj(std::istream& stream, const std::string& name);

/// Binary STL with facet normals. STL has no indices: -0 is written as 0, so that programs which
/// compare bytes find equal vertices.
void WriteStl(const TriangleMesh& mesh, std::ostream& stream);
/// Binary STL; vertices with equal coordinates become one.
TriangleMesh ReadStl(std::istream& stream, const std::string& name);

/// Binary glTF 2.0 (tinygltf) with normals for shading: smooth along the wires, broken at seams.
/// glTF is always in metres. A stream that cannot be written is left in the state failbit.
void WriteGlb(const TriangleMesh& mesh, std::ostream& stream);
/// The same with given normals.
void WriteShadedGlb(const TriangleMesh& mesh, const CornerNormals& normals, std::ostream& stream);
/// The triangles of all meshes in the scene of a binary glTF, transformed as its nodes say;
/// vertices with equal coordinates become one.
TriangleMesh ReadGlb(std::istream& stream, const std::string& name);

/// 3MF (lib3MF), the coordinates taken for millimetres; lib3MF writes six
/// decimals, computed in float32: the last two bits of a coordinate may change.
void Write3mf(const TriangleMesh& mesh, std::ostream& stream);
/// The triangles of all build items of a 3MF file, in the unit of the file.
TriangleMesh Read3mf(std::istream& stream, const std::string& name);

}  // namespace curvefusion
