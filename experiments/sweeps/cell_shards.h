#pragma once

#include <filesystem>

#include "experiments/shard_run.h"
#include "experiments/studies/study.h"

namespace curvefusion {

// A cell of the best profile by several processes: each makes a shard, the last one the result.

/// Where the shards of the cell with this result lie until it is finished.
std::filesystem::path CellShards(const std::filesystem::path& result);

/// Makes one shard of a case into RunInput::folder, and beside it shard_i_of_N.json: what it cost.
/// Does nothing where both are there. Throws as MakeShard.
void MeasureShard(const RunInput& input, ShardNumber shard);

/// ReconstructAndEvaluate from all shards of a folder: the same but for the costs. `cpu_seconds`
/// are those of all shards and of this process, `seconds` those of the longest shard and of this
/// process, memory the most that one of them took. Where a shard is missing, as of scans that have
/// fewer bundles, the whole method runs here.
RunOutcome MergeAndEvaluate(const RunInput& input, const std::filesystem::path& shards, int count);

}  // namespace curvefusion
