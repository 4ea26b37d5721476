#include "kernel/parallel.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace curvefusion {
namespace {

TEST(Parallel, EveryIndexIsVisitedOnce) {
  for (const int threads : {1, 2, 0}) {
    const ThreadLimit limit(threads);
    std::vector<int> visits(1001, 0);
    ParallelFor(0, 1001, 7, [&](int64_t i) { ++visits[static_cast<size_t>(i)]; });
    EXPECT_EQ(visits, std::vector<int>(1001, 1));
  }
}

TEST(Parallel, AnEmptyRangeDoesNothing) {
  ParallelFor(5, 5, 1, [](int64_t) { FAIL(); });
}

TEST(Parallel, ExceptionsReachTheCaller) {
  EXPECT_THROW(ParallelFor(0, 100, 1,
                           [](int64_t i) {
                             if (i == 50) throw std::runtime_error("x");
                           }),
               std::runtime_error);
}

}  // namespace
}  // namespace curvefusion
