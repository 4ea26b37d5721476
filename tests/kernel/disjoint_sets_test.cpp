#include "kernel/disjoint_sets.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

TEST(DisjointSets, TheLowestMemberIsTheRootInAnyOrder) {
  for (const bool reversed : {false, true}) {
    DisjointSets sets(6);
    sets.Unite(reversed ? 5 : 2, reversed ? 2 : 4);
    sets.Unite(reversed ? 4 : 5, reversed ? 2 : 4);
    for (const int i : {2, 4, 5}) EXPECT_EQ(sets.Root(i), 2);
    for (const int i : {0, 1, 3}) EXPECT_EQ(sets.Root(i), i);
  }
}

}  // namespace
}  // namespace curvefusion
