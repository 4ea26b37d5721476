#include "experiments/sweeps/cell_shards.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "capture/content/colour_findings.h"
#include "experiments/studies/reconstruction_run.h"
#include "kernel/atomic_file.h"
#include "kernel/free_space.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

namespace {

fs::path CostFile(const fs::path& folder, ShardNumber shard) {
  return (folder / ShardName(shard)).replace_extension(".json");
}

void WriteCost(const fs::path& file, const Cost& cost) {
  const nlohmann::json json = {{"seconds", cost.seconds},
                               {"cpu_seconds", cost.cpu_seconds},
                               {"peak_memory", cost.peak_memory}};
  WriteStreamAtomically(file, [&](std::ostream& stream) { stream << json.dump(1) << '\n'; });
}

// None where the file is not there.
std::optional<Cost> ReadCost(const fs::path& file) {
  if (!fs::exists(file)) return std::nullopt;
  const nlohmann::json json = ParseJson(ReadFile(file), file.string());
  try {
    return Cost{json.at("seconds"), json.at("cpu_seconds"), json.at("peak_memory")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

ShardIdentity IdentityOfCase(const RunInput& input, const Sequence& opened) {
  return IdentityOf(opened, {input.study_case.config});
}

}  // namespace

fs::path CellShards(const fs::path& result) { return result.parent_path() / "shards"; }

void MeasureShard(const RunInput& input, ShardNumber shard) {
  Sequence sequence = OpenSequence(input.scan);
  const ShardIdentity identity = IdentityOfCase(input, sequence);
  const fs::path file = input.folder / ShardName(shard);
  const fs::path cost_file = CostFile(input.folder, shard);
  if (ReadCost(cost_file) && !WhyNotShard(file, shard, identity)) return;
  RequireFreeSpace(input.folder, kShardBytesOfFrame * static_cast<std::uintmax_t>(
                                                          sequence.frame_count() / shard.count));
  fs::create_directories(input.folder);
  UseFittedColourCamera(sequence);  // as ReconstructAndEvaluate does
  InterruptibleObserver observer(input.progress);
  const Cost cost = CostOf(
      [&] { MakeShard(file, identity, sequence, input.study_case.config, shard, observer); });
  WriteCost(cost_file, cost);
}

RunOutcome MergeAndEvaluate(const RunInput& input, const fs::path& folder, int count) {
  Cost before;
  std::vector<fs::path> files;
  for (ShardNumber shard{1, count}; shard.number <= count; ++shard.number) {
    const std::optional<Cost> cost = ReadCost(CostFile(folder, shard));
    if (!cost) return ReconstructAndEvaluate(input);
    before = {std::max(before.seconds, cost->seconds), before.cpu_seconds + cost->cpu_seconds,
              std::max(before.peak_memory, cost->peak_memory)};
    files.push_back(folder / ShardName(shard));
  }
  const std::vector<Shard> shards =
      OpenShards(files, IdentityOfCase(input, OpenSequence(input.scan)));
  return ReconstructAndEvaluateBy(
      [&](const Sequence& sequence, PipelineObserver& observer) {
        return ReconstructFromShards(shards, sequence, input.study_case.config, observer, false);
      },
      before, input);
}

}  // namespace curvefusion
