#pragma once

#include "experiments/studies/study.h"
#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"
#include "kernel/triangle_mesh.h"
#include "meshing/tubes.h"

namespace curvefusion {

// Methods of different kinds are compared in the same figures and in pictures of the same view: F5,
// F2, recall and precision at 5 mm, pieces; all aligned. Those of curves are taken of the curves,
// those of a surface of the part around the true tubes, against the tubes' surface. Where there is
// a surface there are surface.F2, surface.recall (at 5 mm) and normal_error_deg (MeanNormalError)
// too.

/// The box 30 mm around the true object, as far as a mesh is cut to it (PartAroundTruth).
Eigen::AlignedBox3d BoxAround(const SkeletonGraph& truth);

/// Writes a picture of curves and points in that view, as large as the others.
void DrawInCommonView(const std::filesystem::path& file, const SkeletonGraph& graph,
                      const ObservedPoints& points, const SkeletonGraph& truth);

/// Keeps a skeleton (EvaluateAndKeep), skeleton.png and points.png. Its figures have
/// spurious_junctions and missed_junctions (of pairs within 10 mm, aligned) too.
RunOutcome KeepSkeletonOfMethod(const RunInput& input, const SkeletonGraph& skeleton,
                                const ObservedPoints& points, const SkeletonGraph& truth);

/// Adds the figures of a surface for the tubes of curves; none for curves that are none.
void AddSurfaceOfCurves(const SkeletonGraph& skeleton, const TubeOptions& options,
                        const SkeletonGraph& truth, Figures& figures);

/// Keeps mesh.png.
RunOutcome KeepSurfaceOfMethod(const RunInput& input, const TriangleMesh& surface,
                               const SkeletonGraph& truth);

}  // namespace curvefusion
