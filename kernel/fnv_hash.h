#pragma once

#include <cstdint>
#include <string_view>

namespace curvefusion {

/// FNV-1a with 64 bits, the same on every machine: any single byte that differs changes it. For
/// keys and checksums, not against forgery.
class FnvHash {
 public:
  void Add(std::string_view bytes) {
    for (const unsigned char c : bytes) hash_ = (hash_ ^ c) * 0x100000001b3;
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = 0xcbf29ce484222325;  // offset basis
};

}  // namespace curvefusion
