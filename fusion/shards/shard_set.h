#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/shards/shard_file.h"

namespace curvefusion {

/// The header of a shard but for its identity: which bundles of a sequence, as it will be
/// segmented, are its own. All shards have about as many frames, and at least a bundle. Throws
/// Error(kUsage) where there are more shards than bundles.
ShardHeader ShardOf(const Sequence& sequence, const BestOptions& options, ShardNumber shard);

/// Why a shard is none of this identity: a sentence that begins with what the shard "was made with"
/// and ends with what to do; empty where it is one.
std::string ForeignText(const ShardIdentity& shard, const ShardIdentity& wanted);

/// Opens all shards of a reconstruction, in their order: these files, or all *.cfshard of a folder.
/// Throws Error(kBadInput), naming files, values and what to do, where one cannot be read
/// (OpenShard), is not of this identity, is there twice or missing, and where they do not agree in
/// what they have learned of the whole scan.
std::vector<Shard> OpenShards(const std::vector<std::filesystem::path>& paths,
                              const ShardIdentity& identity);

/// Their bundles. Throws Error(kBadInput) where other poses or cameras than those of `sequence`
/// were used for them. `shards` must outlive the source.
BundleSource BundlesOf(const std::vector<Shard>& shards, const Sequence& sequence);

}  // namespace curvefusion
