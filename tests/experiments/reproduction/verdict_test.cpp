#include "experiments/reproduction/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "experiments/reproduction/measures.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::Field;

StudyRun MadeUp(const Labels& labels, const Figures& figures, uint64_t seed = 1,
                const std::string& outcome = "done") {
  return {labels, seed, outcome, "", "", "", figures};
}

Claim AtLeast(ClaimKind kind, double bound, std::optional<double> beyond = {}) {
  return {.topic = "",
          .words = "",
          .place = "",
          .kind = kind,
          .measure = MedianOf("f"),
          .bound = {.value = bound, .beyond = beyond}};
}

TEST(VerdictOn, WhatWorksIsReproducedOrExceeded) {
  const Claim claim = AtLeast(ClaimKind::kWorks, 0.945, 0.955);
  EXPECT_EQ(VerdictOn(claim, 0.94), Verdict::kNotReproduced);
  EXPECT_EQ(VerdictOn(claim, 0.945), Verdict::kReproduced);
  EXPECT_EQ(VerdictOn(claim, 0.955), Verdict::kExceeded);
}

TEST(VerdictOn, AFailureOfTheMethodIsReproducedByFailing) {
  const Claim claim = AtLeast(ClaimKind::kFails, 0.9);
  EXPECT_EQ(VerdictOn(claim, 0.5), Verdict::kReproduced);
  EXPECT_EQ(VerdictOn(claim, 0.95), Verdict::kExceeded);
}

TEST(VerdictOn, AnotherMethodThatDoesNotFailRefutesTheClaim) {
  const Claim claim = AtLeast(ClaimKind::kOthersFail, 0.9);
  EXPECT_EQ(VerdictOn(claim, 0.5), Verdict::kReproduced);
  EXPECT_EQ(VerdictOn(claim, 0.95), Verdict::kNotReproduced);
}

TEST(VerdictOn, BoundsMayBeUpperOnes) {
  Claim claim = AtLeast(ClaimKind::kWorks, 18, 16);
  claim.bound.at_most = true;
  EXPECT_EQ(VerdictOn(claim, 20), Verdict::kNotReproduced);
  EXPECT_EQ(VerdictOn(claim, 17), Verdict::kReproduced);
  EXPECT_EQ(VerdictOn(claim, 8), Verdict::kExceeded);
}

TEST(Judge, GivesAResultForEachProfileFromItsRunsAlone) {
  const std::vector<StudyRun> runs = {MadeUp({{"profile", "paper"}}, {{"f", 0.2}}),
                                      MadeUp({{"profile", "best"}}, {{"f", 0.99}})};
  EXPECT_THAT(Judge(AtLeast(ClaimKind::kWorks, 0.9), runs),
              ElementsAre(Field(&ClaimResult::verdict, Verdict::kNotReproduced),
                          Field(&ClaimResult::verdict, Verdict::kReproduced)));
}

TEST(Judge, TheMedianOverSeedsDecidesAndDissentIsSaid) {
  std::vector<StudyRun> runs;
  for (const double f : {0.95, 0.92, 0.5}) {
    runs.push_back(MadeUp({{"profile", "paper"}}, {{"f", f}}, runs.size() + 1));
  }
  const ClaimResult result = Judge(AtLeast(ClaimKind::kWorks, 0.9), runs).front();
  EXPECT_EQ(result.verdict, Verdict::kReproduced);
  EXPECT_EQ(result.seeds, 3);
  EXPECT_FALSE(result.on_every_seed);
  EXPECT_EQ(result.figure->median, 0.92);
}

TEST(Judge, WithoutRunsNothingIsMeasured) {
  const Claim claim = AtLeast(ClaimKind::kOthersFail, 0.9);
  const std::vector<StudyRun> failed = {MadeUp({{"profile", "paper"}}, {}, 1, "failed"),
                                        MadeUp({{"profile", "best"}}, {}, 1, "failed")};
  for (const auto& runs : {std::vector<StudyRun>(), failed}) {
    for (const ClaimResult& result : Judge(claim, runs)) {
      EXPECT_EQ(result.verdict, Verdict::kNotMeasured);
    }
  }
}

RunGroup GroupOf(const std::vector<StudyRun>& runs) {
  RunGroup group;
  for (const StudyRun& run : runs) group.runs.push_back(&run);
  return group;
}

TEST(Measures, AResultWithoutCurvesCountsAsZero) {
  const std::vector<StudyRun> runs = {MadeUp({}, {}, 1, "nothing found")};
  EXPECT_EQ(MedianOf("f")(GroupOf(runs)), 0);
  const std::vector<StudyRun> done = {MadeUp({}, {})};
  EXPECT_EQ(MedianOf("f")(GroupOf(done)), std::nullopt);
}

TEST(Measures, RatiosPoolCounts) {
  const std::vector<StudyRun> runs = {MadeUp({{"o", "a"}}, {{"found", 1}, {"all", 2}}),
                                      MadeUp({{"o", "b"}}, {{"found", 9}, {"all", 10}})};
  EXPECT_DOUBLE_EQ(*RatioOf("found", "all")(GroupOf(runs)), 10.0 / 12);
  EXPECT_DOUBLE_EQ(*RatioOf("found", "all", {{"o", "a"}})(GroupOf(runs)), 0.5);
  EXPECT_EQ(RatioOf("found", "all", {{"o", "c"}})(GroupOf(runs)), std::nullopt);
}

TEST(Measures, DifferencesNeedBothSides) {
  const std::vector<StudyRun> runs = {MadeUp({{"s", "a"}}, {{"f", 0.5}}),
                                      MadeUp({{"s", "b"}}, {{"f", 0.8}})};
  const auto difference = DifferenceOf("f", {{"s", "a"}}, {{"s", "b"}});
  EXPECT_DOUBLE_EQ(*difference(GroupOf(runs)), -0.3);
  EXPECT_DOUBLE_EQ(*AmountOf(difference)(GroupOf(runs)), 0.3);
  EXPECT_EQ(DifferenceOf("f", {{"s", "a"}}, {{"s", "c"}})(GroupOf(runs)), std::nullopt);
}

TEST(Measures, ALeadIsOverTheMethodBesideEachSubject) {
  Claim claim = AtLeast(ClaimKind::kWorks, 0);
  claim.measure = LeadOver("other", "f");
  claim.beside = "other";
  const std::vector<StudyRun> runs = {
      MadeUp({{"method", "paper"}}, {{"f", 0.5}}), MadeUp({{"method", "best"}}, {{"f", 0.9}}),
      MadeUp({{"method", "other"}}, {{"f", 0.7}}), MadeUp({{"method", "unasked"}}, {{"f", 0}})};
  const std::vector<ClaimResult> results = Judge(claim, runs);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_DOUBLE_EQ(results[0].figure->median, 0.5 - 0.7);
  EXPECT_DOUBLE_EQ(results[1].figure->median, 0.9 - 0.7);
  claim.beside = "missing";
  EXPECT_EQ(Judge(claim, runs)[0].verdict, Verdict::kNotMeasured);
}

TEST(Measures, TheLeastSpacingEndsAtTheFirstThatIsNotResolved) {
  const auto resolved = [](const std::map<int, int>& spacings) {
    std::vector<StudyRun> runs;
    for (const auto& [spacing, is_resolved] : spacings) {
      runs.push_back(MadeUp({{"spacing", std::to_string(spacing)}},
                            {{"r", static_cast<double>(is_resolved)}}));
    }
    return LeastLabelWith("r", "spacing")(GroupOf(runs));
  };
  EXPECT_EQ(resolved({{40, 1}, {20, 1}, {9, 0}, {8, 1}}), 20);  // 100 before 9: numbers, not words
  EXPECT_EQ(resolved({{100, 1}, {9, 1}}), 9);
  EXPECT_EQ(resolved({{40, 0}, {20, 1}}), HUGE_VAL);
  EXPECT_EQ(resolved({}), std::nullopt);
}

TEST(Measures, FallsOfTheLeastLabelAreCountedFromOneGroupToTheNext) {
  const auto falls = [](const std::vector<int>& least) {
    std::vector<StudyRun> runs;
    std::vector<Labels> along;
    for (size_t i = 0; i < least.size(); ++i) {
      along.push_back({{"sensor", std::to_string(i)}});
      for (const int mm : {12, 8, 4}) {
        runs.push_back(MadeUp({{"sensor", std::to_string(i)}, {"mm", std::to_string(mm)}},
                              {{"r", mm >= least[i] ? 1.0 : 0.0}}));
      }
    }
    return FallsOfLeastLabel("r", "mm", along)(GroupOf(runs));
  };
  EXPECT_EQ(falls({100, 8, 4}), 2);  // none, then thinner and thinner
  EXPECT_EQ(falls({8, 8, 4}), 1);
  EXPECT_EQ(falls({4, 8, 4}), 0);
  EXPECT_EQ(falls({8, 12}), -1);
  EXPECT_EQ(FallsOfLeastLabel("r", "mm", {{{"sensor", "none"}}})(GroupOf({})), std::nullopt);
}

TEST(Measures, BelowBestComparesWithEveryOtherValue) {
  const std::vector<StudyRun> runs = {MadeUp({{"k", "4"}}, {{"f", 0.7}}),
                                      MadeUp({{"k", "30"}}, {{"f", 0.8}}),
                                      MadeUp({{"k", "80"}}, {{"f", 0.9}})};
  EXPECT_NEAR(*BelowBestOf("f", "k", "30")(GroupOf(runs)), -0.1, 1e-12);
  EXPECT_EQ(BelowBestOf("f", "k", "240")(GroupOf(runs)), std::nullopt);
}

TEST(Measures, OneDiameterIsHeldAgainstTheNearestOfTableOne) {
  const std::vector<StudyRun> runs = {MadeUp({{"object", "dish"}}, {{"global_diameter_mm", 5.4}}),
                                      MadeUp({{"object", "wine"}}, {{"global_diameter_mm", 5.4}}),
                                      MadeUp({{"object", "knot"}}, {{"global_diameter_mm", 50}})};
  // The paper's own estimates of these two: .4 of 5 mm and .6 of 6 mm; a knot is not in its table.
  EXPECT_NEAR(*TableDiameterError()(GroupOf(runs)), (0.08 + 0.1) / 2, 1e-12);
}

}  // namespace
}  // namespace curvefusion
