#include "kernel/buckets.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

TEST(SortIntoBuckets, KeepsTheOrderOfItems) {
  const Buckets buckets = SortIntoBuckets({2, 0, 2, -1, 0}, 3);
  EXPECT_EQ(buckets.first, (std::vector<int>{0, 2, 2, 4}));
  EXPECT_EQ(buckets.members, (std::vector<int>{1, 4, 0, 2}));
}

TEST(SortIntoBuckets, TakesNothing) {
  EXPECT_EQ(SortIntoBuckets({}, 2).first, (std::vector<int>{0, 0, 0}));
  EXPECT_TRUE(SortIntoBuckets({-1}, 0).members.empty());
}

}  // namespace
}  // namespace curvefusion
