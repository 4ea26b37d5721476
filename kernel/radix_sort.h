#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace curvefusion {

/// Sorts values by the 64-bit number key(value), those of equal number in their order. Linear: one
/// pass for every eleven bits in which the numbers differ, so that it pays from some thousand
/// values on.
template <class T, class Key>
void RadixSort(std::vector<T>& values, const Key& key) {
  constexpr int kBits = 11;  // of a digit; its counts stay in the cache
  constexpr uint64_t kMask = (uint64_t{1} << kBits) - 1;
  uint64_t different = 0;
  for (const T& value : values) different |= key(value) ^ key(values.front());
  std::vector<T> sorted(values.size());
  const int end = static_cast<int>(std::bit_width(different));
  for (int shift = std::countr_zero(different); shift < end; shift += kBits) {
    if ((different >> shift & kMask) == 0) continue;
    std::array<std::size_t, kMask + 1> next{};
    for (const T& value : values) ++next[key(value) >> shift & kMask];
    std::size_t begin = 0;
    for (std::size_t& count : next) begin += std::exchange(count, begin);
    for (T& value : values) sorted[next[key(value) >> shift & kMask]++] = std::move(value);
    std::swap(values, sorted);
  }
}

}  // namespace curvefusion
