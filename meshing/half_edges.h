#pragma once

#include <array>
#include <vector>

#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// A half-edge of a triangle, listed under its edge (low, high).
struct HalfEdge {
  int low, high;  ///< vertices, low <= high
  bool forward;   ///< runs from low to high
  int face;
};

/// The half-edges of all triangles, those of one edge next to each other. O(n log n).
std::vector<HalfEdge> SortedHalfEdges(const std::vector<std::array<int, 3>>& triangles);

/// The number 3 f + k of the corner of face f at `vertex`, its k-th.
int CornerOf(const TriangleMesh& mesh, int face, int vertex);

}  // namespace curvefusion
