#pragma once

#include <filesystem>

#include "experiments/sweeps/sweep_cells.h"
#include "kernel/progress.h"

namespace curvefusion {

/// What became of a cell.
struct CellOutcome {
  std::string outcome;  ///< as StudyRun::outcome
  std::string message;  ///< of a failed one
};

/// Reconstructs and evaluates one cell into `result`, which gets run.json, config.toml,
/// skeleton.json and evaluation.json and appears only when complete. Does nothing where it is
/// there; where another process finishes the same cell meanwhile, the result of that one stays. A
/// reconstruction that fails is recorded as a result, too: the same program would fail again.
/// Throws Error(kUsage) for another scan than the cell's, Error(kResource) and kInterrupted, which
/// may not come again.
CellOutcome MeasureCell(const SweepCell& cell, const std::filesystem::path& scan,
                        const std::filesystem::path& result, const Progress& progress);

/// A case of a study whose scan is simulated, as the cell of a sweep that it is: taken from the
/// first of input.caches that has it, otherwise measured into the first that can be written, and
/// copied into input.folder. Throws as MeasureCell, and Error(kBadInput) with the message of a cell
/// that has failed.
RunOutcome RunAsCell(const RunInput& input);

/// Simulates the scan that a settings file tells of, unless it is there. Where another process
/// makes the same scan meanwhile, that one stays.
void MakeSweepScan(const std::filesystem::path& settings, const std::filesystem::path& folder,
                   const Progress& progress);

/// About the most that the result of a cell takes on the disk. Chosen: five times the result of a
/// wire cube.
inline constexpr std::uintmax_t kCellBytes = 8u << 20;

}  // namespace curvefusion
