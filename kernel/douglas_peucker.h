#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace curvefusion {

/// Which of `count` items along a curve, at least one, are enough for the others to lie within a
/// tolerance of what is put between those (Douglas and Peucker 1973): deviation(a, k, b) is how far
/// item k is from what lies between a and b. Ascending, with the first and the last. O(count^2) at
/// worst.
template <class Deviation>
std::vector<size_t> DouglasPeucker(size_t count, double tolerance, const Deviation& deviation) {
  std::vector<char> keep(count, 0);
  keep.front() = keep.back() = 1;
  std::vector<std::pair<size_t, size_t>> open = {{0, count - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    size_t farthest = a;
    double greatest = tolerance;
    for (size_t k = a + 1; k < b; ++k) {
      const double d = deviation(a, k, b);
      if (d <= greatest) continue;
      greatest = d;
      farthest = k;
    }
    if (farthest == a) continue;
    keep[farthest] = 1;
    open.push_back({a, farthest});
    open.push_back({farthest, b});
  }
  std::vector<size_t> kept;
  for (size_t i = 0; i < count; ++i) {
    if (keep[i]) kept.push_back(i);
  }
  return kept;
}

}  // namespace curvefusion
