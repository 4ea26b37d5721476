#pragma once

#include <filesystem>
#include <string>

#include "experiments/studies/scan_cache.h"
#include "experiments/sweeps/cell_shards.h"
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
/// may not come again. With `shards`, from so many of MeasureCellShard (cell_shards.h), which are
/// removed.
CellOutcome MeasureCell(const SweepCell& cell, const std::filesystem::path& scan,
                        const std::filesystem::path& result, const Progress& progress,
                        int shards = 0);

/// Makes one shard of a cell in CellShards(result), unless the result is there. Returns why it
/// cannot be made, where the same program would fail again: MeasureCell then runs the whole method.
/// Throws as MeasureCell.
std::string MeasureCellShard(const SweepCell& cell, const std::filesystem::path& scan,
                             const std::filesystem::path& result, ShardNumber shard,
                             const Progress& progress);

/// Measures cases of studies as the cells of sweeps that they are: a cell is taken from the first
/// folder that has it, otherwise measured into StoreOf(folders), and copied into RunInput::folder.
/// A recording is no cell: ReconstructAndEvaluate. Throws as MeasureCell, and Error(kBadInput) with
/// the message of a cell that has failed.
CaseMeasurement MeasurementByCells(const CacheFolders& folders);

/// Simulates the scan that a settings file tells of, unless it is there. Where another process
/// makes the same scan meanwhile, that one stays.
void MakeSweepScan(const std::filesystem::path& settings, const std::filesystem::path& folder,
                   const Progress& progress);

/// About the most that the result of a cell takes on the disk. Chosen: five times the result of a
/// wire cube.
inline constexpr std::uintmax_t kCellBytes = 8u << 20;

}  // namespace curvefusion
