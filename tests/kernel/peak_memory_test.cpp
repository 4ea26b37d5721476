#include "kernel/peak_memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace curvefusion {
namespace {

TEST(PeakMemory, GrowsWithWhatIsUsed) {
  const int64_t before = PeakMemory();
  EXPECT_GT(before, 1'000'000);  // no program with this many libraries is smaller
  const std::vector<char> used(200'000'000, 1);
  EXPECT_GT(PeakMemory(), before + 100'000'000) << used.size();
}

}  // namespace
}  // namespace curvefusion
