#pragma once

#include <bit>
#include <cstdint>
#include <ostream>
#include <string_view>
#include <type_traits>

#include "kernel/fnv_hash.h"

namespace curvefusion {

// How shards hold numbers: in memory's own form, little-endian.
static_assert(std::endian::native == std::endian::little);

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
  FnvHash checksum_;
};

}  // namespace curvefusion
