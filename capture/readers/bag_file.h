#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <string>

#include "capture/packed_chunk.h"

namespace curvefusion {

/// A message of a ROS bag: where its bytes are. Lives as long as the call it is handed to.
class BagMessage {
 public:
  BagMessage(std::istream& stream, const PackedChunk& chunk, std::uint64_t offset,
             std::uint32_t bytes)
      : stream_(stream), chunk_(chunk), offset_(offset), bytes_(bytes) {}

  std::uint32_t bytes() const { return bytes_; }
  const PackedChunk& chunk() const { return chunk_; }
  /// Of the first byte: in the file, or in the unpacked chunk where it is packed.
  std::uint64_t offset() const { return offset_; }
  /// `count` bytes from `first` on; fewer at the end of the message.
  std::string Read(std::uint64_t first, std::uint64_t count) const;

 private:
  std::istream& stream_;
  const PackedChunk& chunk_;
  std::uint64_t offset_;
  std::uint32_t bytes_;
};

/// What is told of each message: its topic, when it was recorded (seconds), the message itself.
using UseBagMessage =
    std::function<void(const std::string& topic, double time, const BagMessage& message)>;

/// Calls `use` for all messages of a ROS bag (format 2.0) in the order of the file, whether the bag
/// has an index or not. Holds one chunk at a time in memory, and that only where it is packed.
/// Throws Error(kBadInput) naming the file and the place for what is no bag, is cut off or damaged,
/// after the messages before it.
void ReadBag(const std::filesystem::path& file, const UseBagMessage& use);

}  // namespace curvefusion
