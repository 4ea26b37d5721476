#include "fusion/best/best_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fusion/pipeline.h"

namespace curvefusion {
namespace {

Sequence Scan(int frames, int width, int height) {
  Sequence sequence;
  sequence.frames.resize(frames);
  sequence.depth_camera =
      sequence.color_camera = {width, height, 580, 580, 0.5 * width - 0.5, 0.5 * height - 0.5};
  return sequence;
}

std::vector<PlannedStage> Plan(const Sequence& sequence, const RunSize& size) {
  return PlanBest(sequence, std::get<BestOptions>(ProfileOptions(Profile::kBest)), size);
}

double Seconds(const std::vector<PlannedStage>& plan) {
  return std::accumulate(plan.begin(), plan.end(), 0.0,
                         [](double sum, const PlannedStage& stage) { return sum + stage.cost; });
}

int StagesThatTakeTime(const std::vector<PlannedStage>& plan, const std::string& name) {
  return static_cast<int>(std::count_if(plan.begin(), plan.end(), [&](const PlannedStage& stage) {
    return stage.name == name && stage.cost > 0;
  }));
}

const Sequence kScan = Scan(60, 640, 480);

TEST(BestPlan, StagesAreTheSameWhateverIsKnown) {
  const auto names = [](const RunSize& size) {
    std::vector<std::string> all;
    for (const PlannedStage& stage : Plan(kScan, size)) all.push_back(stage.name);
    return all;
  };
  const std::vector<std::string> known = names({.points = 3e4, .length = 2, .free_ends = 5});
  EXPECT_EQ(names({}), known);
  EXPECT_EQ(names({.by_colour = true}), known);
  EXPECT_EQ(names({.rounds = 3, .has_last_round = true}), known);
}

TEST(BestPlan, MoreAndLargerImagesTakeLonger) {
  EXPECT_GT(Seconds(Plan(Scan(120, 640, 480), {})), 1.2 * Seconds(Plan(kScan, {})));
  EXPECT_GT(Seconds(Plan(Scan(60, 848, 480), {})), 1.1 * Seconds(Plan(kScan, {})));
}

TEST(BestPlan, MoreRoundsAreExpectedWhereMoreCurvesEndFreely) {
  const double none = Seconds(Plan(kScan, {.points = 3e4, .length = 2, .free_ends = 0}));
  const double some = Seconds(Plan(kScan, {.points = 3e4, .length = 2, .free_ends = 5}));
  const double many = Seconds(Plan(kScan, {.points = 3e4, .length = 2, .free_ends = 15}));
  EXPECT_LT(none, some);
  EXPECT_LT(some, many);
}

TEST(BestPlan, RoundsThatAreKnownToComeAreCertainAndAfterTheLastNoneIsExpected) {
  RunSize size = {.points = 3e4, .length = 2, .free_ends = 5};
  const std::vector<PlannedStage> before = Plan(kScan, size);
  size.has_last_round = true;
  const std::vector<PlannedStage> one = Plan(kScan, size);
  EXPECT_EQ(StagesThatTakeTime(one, "strips"), 1);
  EXPECT_EQ(StagesThatTakeTime(one, "wires from colour"), 1);
  size.rounds = 2;
  const std::vector<PlannedStage> three = Plan(kScan, size);
  EXPECT_EQ(StagesThatTakeTime(three, "strips"), 3);
  EXPECT_EQ(StagesThatTakeTime(three, "wires from colour"), 3);
  EXPECT_LT(Seconds(one), Seconds(before));
  EXPECT_LT(Seconds(before), Seconds(three));
}

}  // namespace
}  // namespace curvefusion
