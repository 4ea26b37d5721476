#include "experiments/studies/headline_figures.h"

#include <gtest/gtest.h>

#include <string>

namespace curvefusion {
namespace {

StudyRun RunOf(const std::string& object, uint64_t seed, const Figures& figures,
               const std::string& outcome = "done") {
  return {{{"object", object}, {"setting", "x"}}, seed, outcome, "", "", {}, figures};
}

std::optional<double> Value(const std::vector<StudyRun>& runs, const std::string& name) {
  return HeadlineValues(GroupRuns(runs, {"setting"}).front())[HeadlineIndex(name)];
}

TEST(HeadlineFigures, MedianOverSeedsThenMeanOverObjects) {
  const std::string f = "aligned.curves.2mm.f";
  const std::vector<StudyRun> runs = {RunOf("a", 1, {{f, 0.9}}), RunOf("a", 2, {{f, 0.1}}),
                                      RunOf("a", 3, {{f, 0.8}}), RunOf("b", 1, {{f, 0.4}})};
  EXPECT_NEAR(*Value(runs, "F2 aligned"), 0.6, 1e-12);
  EXPECT_EQ(Value(runs, "F2 raw"), std::nullopt);
}

TEST(HeadlineFigures, JunctionsArePooledAsCounts) {
  const std::string junctions = "aligned.junctions_10mm.";
  const auto counts = [&](double truth, double found, double matched) {
    return Figures{{junctions + "truth", truth},
                   {junctions + "found", found},
                   {junctions + "matched", matched}};
  };
  const std::vector<StudyRun> runs = {RunOf("a", 1, counts(30, 15, 15)),
                                      RunOf("b", 1, counts(10, 25, 5))};
  EXPECT_EQ(*Value(runs, "junction recall"), 0.5);
  EXPECT_EQ(*Value(runs, "junction precision"), 0.5);
  EXPECT_EQ(Value({RunOf("a", 1, counts(0, 0, 0))}, "junction recall"), std::nullopt);
}

TEST(HeadlineFigures, CyclesAreRightOrNot) {
  const std::vector<StudyRun> runs = {RunOf("a", 1, {{"cycles", 4}, {"true_cycles", 4}}),
                                      RunOf("a", 2, {{"cycles", 3}, {"true_cycles", 4}}),
                                      RunOf("b", 1, {}, "failed")};
  EXPECT_EQ(*Value(runs, "cycles exact"), 0.5);
}

TEST(HeadlineFigures, NothingFoundIsWorthNothingButFailedRunsAreLeftOut) {
  const Figures half = {{"aligned.curves.5mm.f", 0.5}};
  EXPECT_EQ(*Value({RunOf("a", 1, half), RunOf("b", 1, {}, "nothing found")}, "F5 aligned"), 0.25);
  EXPECT_EQ(*Value({RunOf("a", 1, half), RunOf("b", 1, {}, "failed")}, "F5 aligned"), 0.5);
}

TEST(HeadlineFigures, NothingIsWhatIsWantedOfARoomWithoutWires) {
  const Figures wires = {{"true_length", 2}, {"aligned.curves.5mm.f", 0.5}};
  const std::vector<StudyRun> runs = {RunOf("a", 1, wires),
                                      RunOf("room", 1, {{"true_length", 0}}, "nothing found")};
  EXPECT_EQ(*Value(runs, "F5 aligned"), 0.5);
}

TEST(HeadlineFigures, FalseLengthIsThatOfRoomsToo) {
  const std::string length = "aligned.curves.false_length";
  const std::vector<StudyRun> runs = {RunOf("a", 1, {{length, 0.3}}),
                                      RunOf("room", 1, {{"true_length", 0}}, "nothing found"),
                                      RunOf("chair", 1, {}, "failed")};
  EXPECT_NEAR(*Value(runs, "false length (m)"), 0.15, 1e-12);
}

TEST(HeadlineFigures, ChangesNeedBothSides) {
  const auto changes = ChangesOf({1, 2, std::nullopt}, {3, std::nullopt, 4});
  EXPECT_EQ(changes, (std::vector<std::optional<double>>{2, std::nullopt, std::nullopt}));
}

}  // namespace
}  // namespace curvefusion
