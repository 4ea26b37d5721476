#pragma once

#include <vector>

#include "kernel/triangle_mesh.h"
#include "meshing/corner_normals.h"
#include "meshing/tube_paths.h"

namespace curvefusion {

/// The normals to shade a mesh of tubes with: those of the round tubes. Every triangle takes them
/// from the tube whose surface it lies on; corners of one vertex share a normal where those of
/// their tubes nearly agree, so that shading breaks at seams and nowhere else. A triangle that lies
/// on no tube (one of a wrapped junction) has its own normal. Near-linear in triangles and in tubes
/// near each of them.
CornerNormals ComputeTubeNormals(const TriangleMesh& mesh, const std::vector<TubePath>& paths);

}  // namespace curvefusion
