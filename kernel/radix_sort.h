#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace curvefusion {

/// Sorts values by the 64-bit number key(value), those of equal number in their order. Linear: one
/// pass for each byte in which the numbers differ, so that it pays from some hundred values on.
template <class T, class Key>
void RadixSort(std::vector<T>& values, const Key& key) {
  constexpr int kBytes = 8;
  constexpr std::size_t kDigits = 256;
  std::array<std::array<std::size_t, kDigits>, kBytes> counts{};
  for (const T& value : values) {
    const uint64_t number = key(value);
    for (int byte = 0; byte < kBytes; ++byte) ++counts[byte][number >> (8 * byte) & 0xff];
  }
  std::vector<T> sorted(values.size());
  for (int byte = 0; byte < kBytes; ++byte) {
    std::array<std::size_t, kDigits>& next = counts[byte];
    if (std::find(next.begin(), next.end(), values.size()) != next.end()) continue;
    std::size_t begin = 0;
    for (std::size_t& count : next) begin += std::exchange(count, begin);
    for (T& value : values) sorted[next[key(value) >> (8 * byte) & 0xff]++] = std::move(value);
    std::swap(values, sorted);
  }
}

}  // namespace curvefusion
