#include "apps/run_estimate.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

TEST(RunEstimate, NothingIsKnownWithoutAPlanOrAtTheVeryBeginning) {
  RunEstimate unplanned;
  unplanned.Report("a", 5, 10, 0);
  unplanned.Report("a", 6, 10, 20);
  EXPECT_FALSE(unplanned.SecondsLeft(20));
  RunEstimate run;
  run.Plan({{"a", 1}, {"b", 1}});
  run.Report("a", 0, 10, 0);
  run.Report("a", 1, 10, 0.2);
  EXPECT_FALSE(run.SecondsLeft(0.2));
}

TEST(RunEstimate, AStageWithoutStepsCountsDownByTheClock) {
  RunEstimate run;
  run.Plan({{"a", 10}, {"b", 4}, {"c", 6}});
  run.Report("a", 0, 1, 0);
  run.Report("b", 0, 1, 10);
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(10), 10);
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(13), 7);
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(20), 6);  // longer than planned, and nobody knows how long
}

TEST(RunEstimate, StagesOfTheSameNameComeOneAfterTheOther) {
  RunEstimate run;
  run.Plan({{"radius", 10}, {"other", 5}, {"radius", 20}, {"last", 7}});
  run.Report("radius", 0, 1, 0);
  run.Report("other", 0, 1, 10);
  run.Report("radius", 0, 1, 15);
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(15), 27);
}

TEST(RunEstimate, ABetterKnownPlanReplacesCosts) {
  RunEstimate run;
  run.Plan({{"a", 10}, {"b", 10}});
  run.Report("a", 0, 2, 0);
  run.Report("a", 1, 2, 5);
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(5), 15);
  run.Plan({{"a", 10}, {"b", 100}});
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(5), 105);
}

// Rounds of the same stages: what a scan has made slow in the first is slow in the next.
TEST(RunEstimate, AStageTakesAsLongAsTheOneOfItsNameDid) {
  RunEstimate run;
  run.Plan({{"a", 10}, {"b", 10}, {"a", 0}, {"b", 10}});
  run.Report("a", 0, 1, 0);
  run.Report("b", 0, 1, 10);
  run.Report("a", 0, 1, 40);  // "b" has taken three times as long as planned, both together twice
  EXPECT_NEAR(*run.SecondsLeft(40), 30, 0.5);
}

TEST(RunEstimate, WorkBeforeTheFirstStepOfAStageIsNotTakenForSteps) {
  RunEstimate run;
  run.Plan({{"a", 10}, {"b", 10}});
  run.Report("a", 0, 1, 0);
  run.Report("b", 0, 1, 10);
  run.Report("b", 0, 10, 15);  // five seconds of preparation
  run.Report("b", 1, 10, 16);
  EXPECT_DOUBLE_EQ(*run.SecondsLeft(16), 9);
}

// A stage of twice its expected cost: the surer, the more of it is done.
TEST(RunEstimate, AStageIsKnownTheBetterTheMoreOfItIsDone) {
  RunEstimate run;
  run.Plan({{"a", 10}, {"b", 10}, {"c", 0}});
  run.Report("a", 0, 1, 0);
  run.Report("b", 0, 10, 10);
  for (int i = 1; i <= 9; ++i) run.Report("b", i, 10, 10 + 2 * i);
  EXPECT_NEAR(*run.SecondsLeft(28), 2, 0.1);
}

}  // namespace
}  // namespace curvefusion
