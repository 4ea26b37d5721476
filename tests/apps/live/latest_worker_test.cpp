#include "apps/live/latest_worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <future>
#include <stdexcept>
#include <vector>

namespace curvefusion {
namespace {

using testing::ElementsAre;

TEST(LatestWorker, DoesTheLatestJobAndLeavesOutThoseBetween) {
  std::promise<void> begun, may_end;
  std::vector<int> done;
  {
    LatestWorker<int> worker([&](int job) {
      if (job == 1) {
        begun.set_value();
        may_end.get_future().wait();
      }
      done.push_back(job);
    });
    worker.Offer(1);
    begun.get_future().wait();
    for (const int job : {2, 3, 4}) worker.Offer(job);
    may_end.set_value();
    worker.Wait();
  }
  EXPECT_THAT(done, ElementsAre(1, 4));
}

TEST(LatestWorker, ThrowsWhatAJobHasThrown) {
  LatestWorker<int> worker([](int) { throw std::runtime_error("no"); });
  worker.Offer(1);
  EXPECT_THROW(worker.Wait(), std::runtime_error);
  EXPECT_THROW(worker.Offer(2), std::runtime_error);
}

TEST(LatestWorker, EndsWithoutAJob) {
  LatestWorker<int> worker([](int) {});
  worker.Wait();
}

}  // namespace
}  // namespace curvefusion
