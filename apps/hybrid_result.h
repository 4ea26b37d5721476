#pragma once

#include <filesystem>

#include "experiments/run_report.h"
#include "kernel/progress.h"

namespace curvefusion {

/// Finds the solid parts that the curves of a result are attached to, unites them with the tubes
/// and writes into a folder, all watertight: hybrid.ply in metres and hybrid.stl in millimetres, as
/// slicers take it, and where there are solid parts these alone, solid_parts.ply in metres. Throws
/// Error(kBadInput) where that does not come out, kResource where a file cannot be written.
HybridRecord WriteHybrid(const Reconstruction& reconstruction, const TubeOptions& options,
                         const std::filesystem::path& folder, const Progress& progress);

}  // namespace curvefusion
