#pragma once

#include <istream>
#include <ostream>
#include <string>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The file formats of triangle meshes; float32 coordinates pass through all of them unchanged.
/// Streams are binary. Readers take the stream's name for their messages and throw
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

}  // namespace curvefusion
