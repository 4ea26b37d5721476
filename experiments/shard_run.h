#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "experiments/config.h"
#include "fusion/shards/shard_set.h"

namespace curvefusion {

// One reconstruction by several processes (docs/scaling.md): the best profile alone.

/// What decides a reconstruction besides the scan.
struct ShardedRun {
  const Config& config;
  bool fit_colour_camera = true;  ///< where colour edges lie far from depth edges
  bool track = false;             ///< poses are tracked even where the scan has some
};

/// The options of a run that can be split. Throws Error(kUsage) for the paper profile and for runs
/// that use no depth.
const BestOptions& OptionsOfShards(const Config& config);

/// What all shards of a run of this program on this scan have in common; the sequence is as it was
/// opened.
ShardIdentity IdentityOf(const Sequence& opened, const ShardedRun& run);

/// "2/4". Throws Error(kUsage) for what is no number of a shard.
ShardNumber ParseShard(const std::string& text);

/// Why a file is not this shard of a run of this identity: it is not there, damaged, or another
/// one. None where it is that shard and complete.
std::optional<std::string> WhyNotShard(const std::filesystem::path& file, ShardNumber shard,
                                       const ShardIdentity& identity);

/// Segments one shard of a sequence, with its poses and cameras as they are to be used, into a
/// file. Throws as WriteShard, ShardOf and SegmentBest.
void MakeShard(const std::filesystem::path& file, const ShardIdentity& identity,
               const Sequence& sequence, const Config& config, ShardNumber shard,
               PipelineObserver& observer);

/// About the most that a shard takes on the disk for each of its frames. Measured (cage, 150
/// frames): 360 kB; the double for larger objects.
inline constexpr std::uintmax_t kShardBytesOfFrame = 720'000;

/// Reconstruct from all shards: the same result. Throws as BundlesOf and ReconstructBestFrom.
Reconstruction ReconstructFromShards(const std::vector<Shard>& shards, const Sequence& sequence,
                                     const Config& config, PipelineObserver& observer,
                                     bool fuse_volume);

}  // namespace curvefusion
