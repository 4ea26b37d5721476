#include "kernel/cancellation.h"

#include <gtest/gtest.h>

#include <atomic>

#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {
namespace {

struct CancellationTest : testing::Test {
  void TearDown() override { ResetCancellation(); }
};

TEST_F(CancellationTest, WithoutARequestNothingHappens) { EXPECT_NO_THROW(ThrowIfCancelled()); }

TEST_F(CancellationTest, ARequestThrowsUntilItIsTakenBack) {
  RequestCancellation();
  EXPECT_THROW(ThrowIfCancelled(), Error);
  ResetCancellation();
  EXPECT_NO_THROW(ThrowIfCancelled());
}

// Nested loops on any number of threads: what is thrown inside reaches the outer caller.
TEST_F(CancellationTest, ParallelLoopsEndBetweenTheirChunks) {
  constexpr int kItems = 10'000;
  for (const int threads : {1, 2, 0}) {
    const ThreadLimit limit(threads);
    std::atomic<int> begun{0};
    const auto loop = [&] {
      ParallelFor(0, kItems, 1, [&](int64_t) {
        if (++begun == 10) RequestCancellation();
        ParallelFor(0, 4, 1, [](int64_t) {});
      });
    };
    try {
      loop();
      ADD_FAILURE() << "ran to its end";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInterrupted);
    }
    EXPECT_LT(begun, 100);  // each thread ends after the item it is in
    ResetCancellation();
  }
}

}  // namespace
}  // namespace curvefusion
