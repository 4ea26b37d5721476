#pragma once

#include <array>
#include <vector>

#include "kernel/triangle_mesh.h"
#include "meshing/sweep.h"

namespace curvefusion {

/// The open mesh of the segments first..last-1 of a tube, with the tube's own ends where they
/// belong to it; the segments of a closed tube are counted on over its start.
TriangleMesh SideOfStub(const TubeRings& rings, int first_segment, int last_segment);

/// The closed mesh of the segments first..last-1 of a tube (counted on over the start of a closed
/// one): at the tube's own ends its caps, where
/// it is cut through a flat disc that uses only the vertices of the ring.
TriangleMesh CloseStub(const TubeRings& rings, int first_segment, int last_segment);

/// The triangles of the side of a segment, with the cap where the tube ends there; indices into
/// rings.vertices.
std::vector<std::array<int, 3>> SegmentTriangles(const TubeRings& rings, int segment);

}  // namespace curvefusion
