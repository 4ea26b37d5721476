#include "apps/shard_result.h"

#include <fmt/format.h>

#include <optional>
#include <string>

#include "apps/commands/command.h"
#include "apps/output_folder.h"
#include "apps/run_observer.h"
#include "capture/content/colour_findings.h"
#include "fusion/tracking/tracked_poses.h"
#include "kernel/error.h"
#include "kernel/free_space.h"
#include "kernel/run_lock.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

// Whether it is there; what else has its name is not replaced.
bool IsFinished(const fs::path& file, ShardNumber shard, const ShardIdentity& identity) {
  if (!fs::exists(fs::symlink_status(file))) return false;
  const std::optional<std::string> why = WhyNotShard(file, shard, identity);
  if (!why) return true;
  throw Error(ErrorKind::kUsage, *why + "; --force replaces it");
}

}  // namespace

int WriteShardInto(const fs::path& folder, Sequence sequence, const ShardResult& result,
                   ProgressPrinter& printer) {
  const ShardedRun& run = result.run;
  const fs::path file = folder / ShardName(result.shard);
  const ShardIdentity identity = IdentityOf(sequence, run);
  MakeFolderOf(file);
  const RunLock lock(file.string() + ".lock", file);
  if (!result.force && IsFinished(file, result.shard, identity)) {
    if (!result.quiet) fmt::print("{} is finished; --force makes it again\n", file.string());
    return 0;
  }
  const auto frames = static_cast<std::uintmax_t>(sequence.frame_count() / result.shard.count);
  RequireFreeSpace(folder, kShardBytesOfFrame * frames);
  if (run.fit_colour_camera) UseFittedColourCamera(sequence);
  FindPoses(sequence, InterruptibleProgress(printer));
  RunObserver observer(printer, {});
  MakeShard(file, identity, sequence, run.config, result.shard, observer);
  printer.Finish();
  if (!result.quiet) {
    fmt::print("Wrote {}\nOnce all {} are there: curvefusion reconstruct {} -o RESULT --merge {}\n",
               file.string(), result.shard.count, sequence.folder.string(), folder.string());
  }
  return 0;
}

}  // namespace curvefusion
