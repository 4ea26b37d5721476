#pragma once

#include <cstdint>
#include <string>

namespace curvefusion {

/// How a piece of a recording is compressed as a whole.
enum class Packing {
  kNone,
  kLz4,  ///< an LZ4 frame
  kBzip2,
};

/// Where a packed piece of a recording lies in its file.
struct PackedChunk {
  Packing packing = Packing::kNone;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
  std::uint64_t unpacked_bytes = 0;
};

/// Unpacks the bytes of a chunk into `unpacked`, which must come out at `chunk.unpacked_bytes` and
/// is never longer. Returns what is wrong with them, empty where nothing is. Throws std::bad_alloc.
std::string Unpack(const PackedChunk& chunk, const std::string& packed, std::string& unpacked);

}  // namespace curvefusion
