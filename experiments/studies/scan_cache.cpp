#include "experiments/studies/scan_cache.h"

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/case_settings.h"

namespace curvefusion {

namespace fs = std::filesystem;

fs::path ScanFolder(const fs::path& folder, const SimulationOptions& scan) {
  return folder / (scan.object + "_" + scan.sensor + "_s" + std::to_string(scan.seed) + "_" +
                   SettingsKey(ScanSettings(scan)));
}

fs::path CachedScan(const fs::path& folder, const SimulationOptions& scan,
                    const Progress& progress) {
  const fs::path final_folder = ScanFolder(folder, scan);
  if (fs::exists(final_folder)) return final_folder;
  SimulateScan(scan, final_folder, progress);
  return final_folder;
}

}  // namespace curvefusion
