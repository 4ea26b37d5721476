#pragma once

#include <vector>

#include "kernel/geometry.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// A surface within a box, and what is asked of its triangles time and again. All arrays but the
/// vertices have one entry a triangle.
struct SurfaceTriangles {
  TriangleMesh mesh;
  std::vector<Vec3> centers;
  std::vector<Vec3> normals;  ///< of unit length, towards the free side
  std::vector<double> areas;  ///< m^2
  std::vector<char> is_cut;   ///< the surface goes on beyond the box

  size_t size() const { return areas.size(); }
};

/// The triangles of a surface that reach into a box; those without area are left out.
SurfaceTriangles TrianglesWithin(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// A mark for each triangle.
using TriangleMarks = std::vector<char>;

/// A connected piece of the marked triangles.
struct SurfacePiece {
  std::vector<int> triangles;  ///< ascending
  double area = 0;
  bool is_cut = false;  ///< one of them is
};

/// The pieces that the marked triangles fall into, connected by vertices, in the order of their
/// first triangles. Linear.
std::vector<SurfacePiece> PiecesOf(const SurfaceTriangles& surface, const TriangleMarks& marked);

/// The marked triangles alone.
TriangleMesh MarkedPart(const TriangleMesh& mesh, const TriangleMarks& marked);

}  // namespace curvefusion
