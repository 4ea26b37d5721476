#include "kernel/thinned.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(ThinnedToTest, KeepsEvenlySpreadValues) {
  const std::vector<int> values = {0, 1, 2, 3, 4, 5, 6};
  EXPECT_THAT(ThinnedTo(values, 3), ElementsAre(0, 2, 4));
  EXPECT_THAT(ThinnedTo(values, 1), ElementsAre(0));
  EXPECT_THAT(ThinnedTo(values, 0), IsEmpty());
}

TEST(ThinnedToTest, KeepsAllWhereThereAreNoMore) {
  EXPECT_THAT(ThinnedTo(std::vector<int>{4, 5}, 2), ElementsAre(4, 5));
  EXPECT_THAT(ThinnedTo(std::vector<int>{4, 5}, 3), ElementsAre(4, 5));
  EXPECT_THAT(ThinnedTo(std::vector<int>(), 3), IsEmpty());
}

}  // namespace
}  // namespace curvefusion
