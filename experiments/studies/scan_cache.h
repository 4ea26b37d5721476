#pragma once

#include <filesystem>

#include "experiments/simulation/simulate.h"

namespace curvefusion {

/// Where a simulated scan with these settings lies below `folder`: "cage_kinect_v1_s1_<hash>".
std::filesystem::path ScanFolder(const std::filesystem::path& folder,
                                 const SimulationOptions& scan);

/// The same, simulated first unless it is there. It gets its name only when it is complete; an
/// older one with other settings is never taken for it. Errors as SimulateScan.
std::filesystem::path CachedScan(const std::filesystem::path& folder, const SimulationOptions& scan,
                                 const Progress& progress);

}  // namespace curvefusion
