#include "kernel/radix_sort.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

struct Numbered {
  uint64_t key;
  int number;
  bool operator==(const Numbered&) const = default;
};

uint64_t KeyOf(const Numbered& value) { return value.key; }

TEST(RadixSort, SortsAsAStableSortDoes) {
  std::mt19937_64 random(1);
  for (const uint64_t mask : {~uint64_t{0}, uint64_t{0xff}, uint64_t{0x3000000000000001}}) {
    for (const int count : {0, 1, 2, 300, 5000, 200000}) {
      std::vector<Numbered> values;
      for (int i = 0; i < count; ++i) values.push_back({random() & mask, i});
      std::vector<Numbered> expected = values;
      std::stable_sort(expected.begin(), expected.end(),
                       [](const Numbered& a, const Numbered& b) { return a.key < b.key; });
      RadixSort(values, KeyOf);
      EXPECT_EQ(values, expected) << "mask " << mask << ", " << count << " values";
    }
  }
}

}  // namespace
}  // namespace curvefusion
