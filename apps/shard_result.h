#pragma once

#include <filesystem>

#include "apps/progress_printer.h"
#include "capture/sequence.h"
#include "experiments/shard_run.h"

namespace curvefusion {

/// How a sequence becomes a shard of a reconstruction.
struct ShardResult {
  ShardedRun run;
  ShardNumber shard;
  bool force = false;  ///< replaces whatever has the name of the shard
  bool quiet = false;
};

/// Finds what the sequence lacks (poses, the colour camera) and writes one shard into the folder,
/// which is made. Does nothing where the shard is there already. Returns the exit code of the
/// command. Throws Error where the sequence cannot be used or the file not be written, and
/// Error(kBusy) where another run writes this shard.
int WriteShardInto(const std::filesystem::path& folder, Sequence sequence,
                   const ShardResult& result, ProgressPrinter& printer);

}  // namespace curvefusion
