#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/simulation/simulate.h"

namespace curvefusion {

/// Where a simulated scan with these settings lies below `folder`: "cage_kinect_v1_s1_<hash>".
std::filesystem::path ScanFolder(const std::filesystem::path& folder,
                                 const SimulationOptions& scan);

/// Where finished scans and results may lie.
struct CacheFolders {
  std::filesystem::path folder;               ///< of the study or sweep itself
  std::vector<std::filesystem::path> caches;  ///< of others, whose finished ones are taken over
};

/// Where new ones go: the first cache that can be written, otherwise the folder.
std::filesystem::path StoreOf(const CacheFolders& folders);

/// `subfolder` in the folder or the first cache where it holds `proof`, the file that is written
/// last. Empty where none does.
std::filesystem::path FinishedIn(const CacheFolders& folders,
                                 const std::filesystem::path& subfolder, const char* proof);

/// Where the scan of that name lies, complete; empty where it does nowhere.
std::filesystem::path FinishedScan(const CacheFolders& folders, const std::string& scan);

/// The same of a scan with these settings, which is simulated into StoreOf where it lies nowhere.
/// It gets its name only when it is complete; an older one with other settings is never taken for
/// it. Errors as SimulateScan.
std::filesystem::path CachedScan(const CacheFolders& folders, const SimulationOptions& scan,
                                 const Progress& progress);

}  // namespace curvefusion
