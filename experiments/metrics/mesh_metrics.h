#pragma once

#include <array>
#include <optional>

#include "experiments/metrics/curve_metrics.h"
#include "graph/skeleton_graph.h"
#include "kernel/triangle_mesh.h"
#include "meshing/watertight.h"

namespace curvefusion {

/// How near a surface is to that of the true tubes, by area.
struct SurfaceScores {
  std::array<PrecisionRecall, kDistanceThresholds.size()> within;  ///< of kDistanceThresholds
  std::optional<double> mean_to_truth;  ///< mean distance of the mesh from the tubes, metres
  std::optional<double> mean_to_mesh;   ///< mean distance of the tubes from the mesh, metres
};

/// Compares a mesh with the surface of the balls about all points of the true curves (which must
/// have radii), sampled about every 0.5 and 1 mm. The errors of sampling stay below 0.1 mm. Samples
/// of a tube inside another tube do not count, and ends of tubes only as far as they are round.
SurfaceScores CompareSurface(const TriangleMesh& mesh, const SkeletonGraph& truth);

/// The rigid motion that takes a mesh onto the surface of the true tubes, by AlignToTruth on
/// samples of both: for meshes that come without curves. Starts from where the mesh is.
RigidTransform AlignSurfaceToTruth(const TriangleMesh& mesh, const SkeletonGraph& truth);

/// A mesh cut to the object: scans of a volume hold the room, too.
struct MeshPart {
  TriangleMesh mesh;        ///< triangles whose centres lie inside
  double area_outside = 0;  ///< m^2, of the rest
};

/// What of a mesh lies in the bounding box of the true tubes grown by 30 mm to each side. (The
/// simulator's tables begin 60 mm below its objects, its walls farther away.)
MeshPart PartAroundTruth(const TriangleMesh& mesh, const SkeletonGraph& truth);

/// The mesh after a rigid motion.
TriangleMesh Transformed(const TriangleMesh& mesh, const RigidTransform& T);

}  // namespace curvefusion
