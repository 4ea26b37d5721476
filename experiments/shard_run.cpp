#include "experiments/shard_run.h"

#include <fmt/format.h>

#include <variant>

#include "experiments/studies/provenance.h"
#include "fusion/best/best_pipeline.h"
#include "fusion/shards/scan_fingerprint.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace fs = std::filesystem;

const BestOptions& OptionsOfShards(const Config& config) {
  if (const auto* best = std::get_if<BestOptions>(&config.pipeline)) {
    if (best->depth.use != DepthRole::kNone) return *best;
    throw Error(ErrorKind::kUsage,
                "depth.use=none: shards are segmented in depth images; leave --shard and --merge "
                "out, or use depth");
  }
  throw Error(
      ErrorKind::kUsage,
      "--profile paper: its bundles are fused one by one and cannot be split; leave --shard "
      "and --merge out, or use --profile best");
}

namespace {

// Lines "section.key = value" of the config.
std::string SettingLines(const Config& config) {
  const std::string toml = ConfigToml(config);
  std::string lines, section;
  LineScanner scanner(toml);
  for (std::string_view line; scanner.Next(line);) {
    if (line.starts_with('[')) {
      section = line.substr(1, line.find(']') - 1);
    } else if (!line.empty() && !line.starts_with('#')) {
      lines += fmt::format("{}{}{}\n", section, section.empty() ? "" : ".", line);
    }
  }
  return lines;
}

}  // namespace

ShardIdentity IdentityOf(const Sequence& opened, const ShardedRun& run) {
  const std::string settings =
      fmt::format("--track = {}\n--colour-camera = {}\n{}", run.track ? "given" : "not given",
                  run.fit_colour_camera ? "auto" : "given", SettingLines(run.config));
  return {MethodVersion(), settings, ScanFingerprint(opened)};
}

ShardNumber ParseShard(const std::string& text) {
  constexpr int64_t kMostShards = 100000;
  const size_t slash = text.find('/');
  if (slash != std::string::npos) {
    const auto number = ParseInteger(std::string_view(text).substr(0, slash));
    const auto count = ParseInteger(std::string_view(text).substr(slash + 1));
    if (number && count && *number >= 1 && *number <= *count && *count <= kMostShards) {
      return {static_cast<int>(*number), static_cast<int>(*count)};
    }
  }
  throw Error(ErrorKind::kUsage,
              fmt::format("--shard {}: write i/N, the number of the shard and how many there are, "
                          "from 1/{} to {}/{}",
                          text, 4, 4, 4));
}

std::optional<std::string> WhyNotShard(const fs::path& file, ShardNumber shard,
                                       const ShardIdentity& identity) {
  try {
    const ShardHeader header = OpenShard(file).header;
    const std::string foreign = ForeignText(header.identity, identity);
    if (!foreign.empty()) return file.string() + ": " + foreign;
    if (header.shard != shard) return file.string() + ": is shard " + ShardText(header.shard);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kBadInput) throw;
    return error.what();
  }
  return std::nullopt;
}

void MakeShard(const fs::path& file, const ShardIdentity& identity, const Sequence& sequence,
               const Config& config, ShardNumber shard, PipelineObserver& observer) {
  const BestOptions& options = OptionsOfShards(config);
  ShardHeader header = ShardOf(sequence, options, shard);
  header.identity = identity;
  header.prepared = ScanFingerprint(sequence);
  WriteShard(file, header, [&](const BundleSink& sink) {
    SegmentBest(sequence, options, header.bundles, sink, observer);
  });
}

Reconstruction ReconstructFromShards(const std::vector<Shard>& shards, const Sequence& sequence,
                                     const Config& config, PipelineObserver& observer,
                                     bool fuse_volume) {
  return ReconstructBestFrom(BundlesOf(shards, sequence), sequence, OptionsOfShards(config),
                             observer, fuse_volume);
}

}  // namespace curvefusion
