#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace curvefusion {

/// Union-find over 0 .. n-1. The lowest member of a set is its root, so that results do not depend on
/// the order in which sets are united.
class DisjointSets {
 public:
  explicit DisjointSets(size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }

  int Root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void Unite(int a, int b) {
    const auto [low, high] = std::minmax({Root(a), Root(b)});
    parent_[high] = low;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace curvefusion
