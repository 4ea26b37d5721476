#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/studies/scan_cache.h"
#include "experiments/sweeps/sweep_cells.h"

namespace curvefusion {

/// A sweep as its folder tells it; its caches are what other sweeps and studies have left.
struct SweepPlan : CacheFolders {
  std::string method;  ///< the version that its keys are true for
  int threads = 1;     ///< of a cell
  int memory_mb = 0;   ///< of a cell at most
  int shards = 1;      ///< that a cell of the best profile is split into
  std::vector<SweepCell> cells;
};

/// Writes a sweep into `folder`: cells/KEY/params.toml for each cell, scans/NAME.json for each
/// scan (of simulate --draw), study.toml (a copy), Snakefile, and last plan.json. Results that lie
/// there stay, those of an earlier plan too. `program` is what the Snakefile
/// calls. Throws as ReadSweepRequest and CellsOf before anything is written, and Error(kResource).
SweepPlan WriteSweepPlan(const std::filesystem::path& study, const std::filesystem::path& folder,
                         const std::vector<std::filesystem::path>& caches,
                         const std::filesystem::path& program);

/// Throws Error(kBadInput) for a folder without a plan that can be read.
SweepPlan ReadSweepPlan(const std::filesystem::path& folder);

/// Writes root/cells/KEY/params.toml, from which the cell can be measured (ReadParams).
void WriteCell(const std::filesystem::path& root, const SweepCell& cell);

/// Where the result of a cell lies inside a folder or a cache.
std::filesystem::path ResultFolder(const std::filesystem::path& root, const SweepCell& cell);

/// Where a cell's result lies, complete, in the folder or the first cache that has it. Empty where
/// none has.
std::filesystem::path FinishedResult(const CacheFolders& folders, const SweepCell& cell);

}  // namespace curvefusion
