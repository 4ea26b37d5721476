#pragma once

#include <bit>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string_view>
#include <type_traits>

namespace curvefusion {

// How shards hold numbers: in memory's own form, little-endian.
static_assert(std::endian::native == std::endian::little);

/// The checksum of a shard, FNV-1a with 64 bits: any single byte that differs changes it.
class ShardChecksum {
 public:
  void Add(std::string_view bytes) {
    for (const unsigned char c : bytes) hash_ = (hash_ ^ c) * 0x100000001b3;
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0xcbf29ce484222325;  // offset basis
};

/// Writes values of plain types one after the other and adds them to a checksum.
class ShardFields {
 public:
  explicit ShardFields(std::ostream& stream) : stream_(stream) {}

  template <class Value>
  void Put(const Value& value) {
    static_assert(std::is_arithmetic_v<Value>);
    PutBytes(&value, sizeof(Value));
  }
  void PutBytes(const void* bytes, size_t count) {
    const std::string_view view(static_cast<const char*>(bytes), count);
    checksum_.Add(view);
    stream_.write(view.data(), static_cast<std::streamsize>(count));
  }
  /// Its length, then the bytes.
  void PutText(std::string_view text) {
    Put(static_cast<uint64_t>(text.size()));
    PutBytes(text.data(), text.size());
  }
  uint64_t checksum() const { return checksum_.value(); }
  bool IsGood() const { return stream_.good(); }

 private:
  std::ostream& stream_;
  ShardChecksum checksum_;
};

}  // namespace curvefusion
