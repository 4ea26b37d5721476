#include "fusion/stage_progress.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace curvefusion {
namespace {

struct Recorder : PipelineObserver {
  void OnProgress(const std::string& stage, int64_t step, int64_t of) override {
    EXPECT_EQ(stage, "segmentation");
    EXPECT_EQ(of, 30);
    EXPECT_EQ(std::this_thread::get_id(), own);
    done.push_back(step);
  }
  std::thread::id own = std::this_thread::get_id();
  std::vector<int64_t> done;
};

TEST(StageProgress, CountsTheStepsOfAllThreadsAndTellsThemFromItsOwn) {
  Recorder recorder;
  StageProgress progress(recorder, "segmentation", 30);
  EXPECT_EQ(recorder.done, std::vector<int64_t>{0});
  progress.Advance();
  std::thread([&] {
    for (int i = 0; i < 20; ++i) progress.Advance();
  }).join();
  progress.Advance();
  EXPECT_EQ(recorder.done, (std::vector<int64_t>{0, 1, 22}));
}

}  // namespace
}  // namespace curvefusion
