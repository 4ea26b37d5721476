#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "experiments/simulation/simulate.h"

namespace curvefusion {

/// Every setting of a simulated scan as JSON, one text for the same scan.
std::string ScanSettings(const SimulationOptions& scan);

/// The scan that a file of such text tells of, as every simulated scan has one in
/// truth/settings.json. Throws Error(kBadInput) for a file that is none, lacks a setting, holds one
/// out of its range, or was written by another version of the simulator.
SimulationOptions ReadScanSettings(const std::filesystem::path& path);

}  // namespace curvefusion
