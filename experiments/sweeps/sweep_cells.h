#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweeps/sweep_request.h"

namespace curvefusion {

/// What a setting point without any change is called.
inline constexpr const char* kDefaultSetting = "default";

/// One measurement of a sweep: a scan, a profile and the settings that differ from it.
struct SweepCell {
  std::string key;     ///< 16 hexadecimal digits of all that decides its result
  std::string object;  ///< or family
  uint64_t seed = 1;   ///< of the study; a family draws the scan's own from it
  std::string sensor;
  std::string poses;
  Profile profile = Profile::kBest;
  std::vector<std::string> settings;  ///< "section.key=value" of what differs, in their order
  std::string scan;                   ///< the name of the scan's folder, which ends with its hash
};

/// "default", or the settings with blanks between them.
std::string SettingName(const SweepCell& cell);

/// The cell with the key of this program (MethodVersion) and this simulator.
std::string CellKey(const SweepCell& cell);

/// The cell that measures the same as a case of a study whose scan is simulated.
SweepCell CellOfCase(const StudyCase& study_case);

/// All that CellKey is a hash of, as JSON.
std::string CellSettings(const SweepCell& cell);

/// The cells of a request and the scans they need.
struct SweepCells {
  std::vector<SweepCell> cells;          ///< no two of one key: points may agree
  std::vector<SimulationOptions> scans;  ///< no two alike
};

/// Every point on every scan with every profile, scan by scan. Throws Error(kUsage) for settings
/// that cannot be, as `--set` does.
SweepCells CellsOf(const SweepRequest& request);

/// What a cell's folder holds: params.toml, from which ReadParams has the same cell again.
std::string ParamsToml(const SweepCell& cell);

/// Throws Error(kBadInput) for a file that is none, and for a cell that another version of the
/// method has planned: its key would not be true.
SweepCell ReadParams(const std::filesystem::path& path);

}  // namespace curvefusion
