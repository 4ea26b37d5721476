#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "experiments/config.h"
#include "fusion/pipeline.h"
#include "fusion/tracking/track_sequence.h"
#include "meshing/watertight.h"

namespace curvefusion {

/// What became of the tubes.
struct MeshRecord {
  WatertightReport figures;
  double seconds = 0;
  std::vector<std::string> warnings;
};

/// What became of the tubes together with the solid parts they are attached to.
struct HybridRecord {
  WatertightReport figures;
  double seconds = 0;
  int parts = 0;         ///< solids
  double seen_area = 0;  ///< m^2, of these
  double room_area = 0;  ///< m^2, of floors, walls and table tops near the curves, left out
  std::vector<std::string> warnings;
};

/// What report.json tells of a run.
struct RunRecord {
  const Sequence& sequence;
  const Config& config;
  const Reconstruction& reconstruction;
  std::optional<MeshRecord> mesh;     ///< missing where nothing was found
  double seconds = 0;                 ///< the whole run
  int64_t peak_memory = 0;            ///< bytes
  bool colour_camera_fitted = false;  ///< that of the sequence; otherwise that of the intrinsics
  std::optional<TrackingResult> tracking;   ///< where the poses come from it
  std::optional<HybridRecord> hybrid = {};  ///< where it was asked for
};

/// What report.json holds: profile, sequence, frames, stages with seconds and counts, warnings,
/// figures of the skeleton and the mesh. Lengths in metres, diameters in millimetres.
nlohmann::ordered_json ReportData(const RunRecord& record);

/// The text of report.json.
std::string ReportJson(const RunRecord& record);

/// All warnings of a run, each once.
std::vector<std::string> AllWarnings(const RunRecord& record);

}  // namespace curvefusion
