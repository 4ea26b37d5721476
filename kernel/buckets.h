#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace curvefusion {

/// The items of each bucket, in ascending order: members[first[b]] to members[first[b + 1] - 1].
struct Buckets {
  std::vector<int> first;  ///< of each bucket, and the end
  std::vector<int> members;

  int size() const { return static_cast<int>(first.size()) - 1; }
  std::span<const int> operator[](int64_t bucket) const {
    return {members.begin() + first[bucket], members.begin() + first[bucket + 1]};
  }
};

/// Sorts items into buckets by counting; those in a negative bucket are left out. Linear.
inline Buckets SortIntoBuckets(const std::vector<int>& bucket_of_item, int bucket_count) {
  Buckets buckets;
  buckets.first.assign(static_cast<std::size_t>(bucket_count) + 1, 0);
  for (const int bucket : bucket_of_item)
    if (bucket >= 0) ++buckets.first[bucket + 1];
  std::partial_sum(buckets.first.begin(), buckets.first.end(), buckets.first.begin());
  buckets.members.resize(buckets.first.back());
  std::vector<int> next = buckets.first;
  for (std::size_t i = 0; i < bucket_of_item.size(); ++i)
    if (bucket_of_item[i] >= 0) buckets.members[next[bucket_of_item[i]]++] = static_cast<int>(i);
  return buckets;
}

}  // namespace curvefusion
