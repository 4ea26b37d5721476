#pragma once

#include <filesystem>
#include <string>

#include "experiments/run_report.h"
#include "graph/graph_figures.h"

namespace curvefusion {

/// "16 curves, 2.86 m, diameter 5.0 mm, 12 junctions, 0 free ends".
std::string FiguresLine(const GraphFigures& figures);

/// What a run tells the person at its end: what was found, where files, the page and the report
/// lie, warnings.
std::string Summary(const RunRecord& record, const std::filesystem::path& folder,
                    const std::filesystem::path& page, const std::filesystem::path& report);

}  // namespace curvefusion
