#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "fusion/best/bundle_segmentation.h"

namespace curvefusion {

/// One of the parts that a reconstruction is split into.
struct ShardNumber {
  int number = 1;  ///< from 1 to count
  int count = 1;

  bool operator==(const ShardNumber&) const = default;
};

/// "2 of 4".
std::string ShardText(ShardNumber shard);

/// "shard_2_of_4.cfshard".
std::string ShardName(ShardNumber shard);

/// What all shards of a reconstruction, and whoever puts them together, have in common.
struct ShardIdentity {
  std::string method;    ///< version of the method
  std::string settings;  ///< lines "name = value", all in force
  std::string scan;      ///< ScanFingerprint as it was opened
};

struct ShardHeader {
  ShardIdentity identity;
  std::string prepared;  ///< ScanFingerprint with the poses and cameras that were used
  ShardNumber shard;
  BundleRange bundles;
  int first_frame = 0;  ///< of the first bundle
  int last_frame = 0;   ///< behind the last one
};

/// Writes what `source` gives for the bundles of the header into a file (docs/formats_shard.md)
/// that gets its name only when it is complete. Bundles are written as they come, and not kept.
/// The same for the same input: the file holds no times. Throws Error(kResource) where the file
/// cannot be written; exceptions of `source` pass through.
void WriteShard(const std::filesystem::path& file, const ShardHeader& header,
                const BundleSource& source);

/// A shard whose file has been looked through.
struct Shard {
  std::filesystem::path file;
  ShardHeader header;
  LearnedScan learned;
  std::uint64_t bundles_at = 0;  ///< bytes from the beginning
};

/// Reads a whole file once, in little memory, and all of it but the bundles. Throws
/// Error(kBadInput), naming the file and what to do, where it is no shard, one of another version
/// of the format, truncated, or does not match its checksum.
Shard OpenShard(const std::filesystem::path& file);

/// Hands out the bundles of a shard one by one. Throws Error(kBadInput) where they cannot be read;
/// exceptions of `on_bundle` pass through.
void ReadBundles(const Shard& shard, const std::function<void(const SegmentedBundle&)>& on_bundle);

/// Whether two shards have learned the same, bit for bit.
bool IsSame(const LearnedScan& a, const LearnedScan& b);

}  // namespace curvefusion
