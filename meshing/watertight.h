#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "kernel/geometry.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// What a mesh is, as a program sees it that reads the file: vertices with equal coordinates are
/// one vertex. Everything is counted exactly on the float32 coordinates.
struct WatertightReport {
  int64_t vertices = 0;  ///< distinct and used by a triangle
  int64_t faces = 0;
  int components = 0;                 ///< connected by edges
  int64_t genus = 0;                  ///< sum over the components; 0 unless closed and manifold
  double volume = 0;                  ///< m^3, positive where the surface faces outwards
  double area = 0;                    ///< m^2
  int64_t boundary_edges = 0;         ///< edges of one triangle
  int64_t non_manifold_edges = 0;     ///< edges of more than two triangles
  int64_t non_manifold_vertices = 0;  ///< vertices whose triangles are more than one fan
  int64_t misoriented_edges = 0;      ///< edges that two triangles run along in one direction
  int64_t degenerate_faces = 0;       ///< triangles without area
  int64_t self_intersections = 0;     ///< pairs of triangles; counting ends at about 1000
  int misplaced_components = 0;       ///< inside out: solids that face inwards, cavities outwards
  double min_angle = 0;               ///< radians, over all triangles
  std::optional<Vec3> defect_place;   ///< of the first defect; not set for components inside out

  /// Closed, consistently oriented, 2-manifold, without self-intersections, bounding a volume.
  bool IsWatertight() const;

  /// What is wrong in one sentence; empty where nothing is.
  std::string Defects() const;
};

/// Examines a mesh. O(n log^3 n) for n triangles, in parallel. Throws Error(kBadInput) for indices
/// out of range and coordinates that are not finite.
WatertightReport ExamineMesh(const TriangleMesh& mesh);

/// Merges vertices with bitwise equal coordinates (the first one stays; -0 equals 0) and drops
/// unused ones.
TriangleMesh WeldVertices(const TriangleMesh& mesh);

}  // namespace curvefusion
