#include "experiments/studies/scan_cache.h"

#include <unistd.h>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/case_settings.h"

namespace curvefusion {

namespace fs = std::filesystem;

fs::path ScanFolder(const fs::path& folder, const SimulationOptions& scan) {
  return folder / (scan.object + "_" + scan.sensor + "_s" + std::to_string(scan.seed) + "_" +
                   SettingsKey(ScanSettings(scan)));
}

fs::path StoreOf(const CacheFolders& folders) {
  for (const fs::path& cache : folders.caches) {
    if (::access(cache.c_str(), W_OK) == 0) return cache;
  }
  return folders.folder;
}

fs::path FinishedIn(const CacheFolders& folders, const fs::path& subfolder, const char* proof) {
  std::error_code failure;
  if (fs::exists(folders.folder / subfolder / proof, failure)) return folders.folder / subfolder;
  for (const fs::path& cache : folders.caches) {
    if (fs::exists(cache / subfolder / proof, failure)) return cache / subfolder;
  }
  return {};
}

fs::path FinishedScan(const CacheFolders& folders, const std::string& scan) {
  return FinishedIn(folders, fs::path("scans") / scan, "truth/settings.json");
}

fs::path CachedScan(const CacheFolders& folders, const SimulationOptions& scan,
                    const Progress& progress) {
  const fs::path finished = FinishedScan(folders, ScanFolder({}, scan).string());
  if (!finished.empty()) return finished;
  const fs::path folder = ScanFolder(StoreOf(folders) / "scans", scan);
  SimulateScan(scan, folder, progress);
  return folder;
}

}  // namespace curvefusion
