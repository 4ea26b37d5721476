#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/sweeps/sweep_cells.h"

namespace curvefusion {

/// A sweep as its folder tells it.
struct SweepPlan {
  std::filesystem::path folder;
  std::string method;  ///< the version that its keys are true for
  int threads = 1;     ///< of a cell
  int memory_mb = 0;   ///< of a cell at most
  std::vector<SweepCell> cells;
  /// Folders that may have finished cells and scans, besides `folder`: what other sweeps left.
  std::vector<std::filesystem::path> caches;
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

/// Where new results and scans go: the first cache that can be written, otherwise the folder.
std::filesystem::path StoreOf(const SweepPlan& plan);

/// Where the result of a cell lies inside a folder or a cache.
std::filesystem::path ResultFolder(const std::filesystem::path& root, const SweepCell& cell);

/// Where a cell's result lies, complete, in the sweep's folder or the first cache that has it.
/// Empty where none has.
std::filesystem::path FinishedResult(const SweepPlan& plan, const SweepCell& cell);

/// The same for a scan.
std::filesystem::path FinishedScan(const SweepPlan& plan, const std::string& scan);

}  // namespace curvefusion
