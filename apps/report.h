#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/graph_figures.h"
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

/// What report.json tells of a run.
struct RunRecord {
  const Sequence& sequence;
  const Config& config;
  const Reconstruction& reconstruction;
  std::optional<MeshRecord> mesh;     ///< missing where nothing was found
  double seconds = 0;                 ///< the whole run
  int64_t peak_memory = 0;            ///< bytes
  bool colour_camera_fitted = false;  ///< that of the sequence; otherwise that of the intrinsics
  std::optional<TrackingResult> tracking;  ///< where the poses come from it
};

/// The text of report.json: profile, sequence, frames, stages with seconds and counts, warnings,
/// figures of the skeleton and the mesh. Lengths in metres, diameters in millimetres.
std::string ReportJson(const RunRecord& record);

/// "16 curves, 2.86 m, diameter 5.0 mm, 12 junctions, 0 free ends".
std::string FiguresLine(const GraphFigures& figures);

/// What a run tells the person at its end: what was found, where files and the report lie,
/// warnings.
std::string Summary(const RunRecord& record, const std::filesystem::path& folder,
                    const std::filesystem::path& report);

}  // namespace curvefusion
