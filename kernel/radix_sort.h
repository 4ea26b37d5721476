#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "kernel/parallel.h"

namespace curvefusion {

/// Sorts values by the 64-bit number key(value), those of equal number in their order. Linear: one
/// pass for every eleven bits in which the numbers differ, so that it pays from some thousand
/// values on. Many values are sorted in parallel.
template <class T, class Key>
void RadixSort(std::vector<T>& values, const Key& key) {
  constexpr int kBits = 11;  // of a digit; its counts stay in the cache
  constexpr uint64_t kMask = (uint64_t{1} << kBits) - 1;
  constexpr int64_t kPart = int64_t{1} << 16;  // values counted and moved by one task
  uint64_t different = 0;
  for (const T& value : values) different |= key(value) ^ key(values.front());
  std::vector<T> sorted(values.size());
  const auto count = static_cast<int64_t>(values.size());
  // By part and digit: how many there are, then where the next one goes.
  std::vector<std::array<std::size_t, kMask + 1>> next((count + kPart - 1) / kPart);
  const int end = static_cast<int>(std::bit_width(different));
  for (int shift = std::countr_zero(different); shift < end; shift += kBits) {
    if ((different >> shift & kMask) == 0) continue;
    const auto digit = [&](const T& value) { return key(value) >> shift & kMask; };
    ParallelChunks(0, count, kPart, [&](int64_t first, int64_t last) {
      auto& counts = next[first / kPart];
      counts.fill(0);
      for (int64_t i = first; i < last; ++i) ++counts[digit(values[i])];
    });
    std::size_t begin = 0;
    for (uint64_t d = 0; d <= kMask; ++d) {
      for (auto& counts : next) begin += std::exchange(counts[d], begin);
    }
    ParallelChunks(0, count, kPart, [&](int64_t first, int64_t last) {
      auto& places = next[first / kPart];
      for (int64_t i = first; i < last; ++i) {
        sorted[places[digit(values[i])]++] = std::move(values[i]);
      }
    });
    std::swap(values, sorted);
  }
}

}  // namespace curvefusion
