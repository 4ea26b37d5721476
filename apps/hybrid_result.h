#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/run_report.h"
#include "kernel/progress.h"
#include "meshing/hybrid_mesh.h"

namespace curvefusion {

/// The tubes of a skeleton and solids as one watertight mesh. Throws like UniteTubesAndSolids.
HybridMesh UniteWithSolids(const SkeletonGraph& skeleton, const TubeMesh& tubes,
                           const std::vector<TriangleMesh>& solids, double default_radius);

/// What the user should know of a hybrid mesh, a sentence each.
std::vector<std::string> HybridWarnings(const HybridMesh& hybrid);

/// Finds the solid parts that the curves of a result are attached to, unites them with the tubes
/// and writes into a folder, all watertight: hybrid.ply in metres and hybrid.stl in millimetres, as
/// slicers take it, and where there are solid parts these alone, solid_parts.ply in metres. Throws
/// Error(kBadInput) where that does not come out, kResource where a file cannot be written.
HybridRecord WriteHybrid(const Reconstruction& reconstruction, const TubeOptions& options,
                         const std::filesystem::path& folder, const Progress& progress);

}  // namespace curvefusion
