#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/sweeps/paired_comparison.h"
#include "experiments/sweeps/pareto_front.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

CellResult Result(const std::string& scan, const std::string& setting, double f2, double seconds) {
  SweepCell cell;
  cell.object = "cage";
  cell.scan = scan;
  if (setting != kDefaultSetting) cell.settings = {setting};
  cell.key = scan + setting;
  CellResult result{cell, {}};
  result.run.labels = {{"object", "cage"}, {"setting", setting}};
  result.run.outcome = "done";
  result.run.figures = {{"aligned.curves.2mm.f", f2}, {"cpu_seconds_per_30_frames", seconds}};
  return result;
}

const FigureComparison& Figure(const SweepComparison& comparison, const std::string& name) {
  for (const FigureComparison& figure : comparison.figures) {
    if (figure.figure == name) return figure;
  }
  throw std::out_of_range(name);
}

TEST(PairedComparison, PairsCellsAndNamesThoseThatAreWorse) {
  std::vector<CellResult> before, after;
  const double changes[] = {0.03, 0.05, -0.1, 0.04, 0.01};
  for (int i = 0; i < 5; ++i) {
    before.push_back(Result("scan" + std::to_string(i), "default", 0.1 * i + 0.3, 2));
    after.push_back(Result("scan" + std::to_string(i), "default", 0.1 * i + 0.3 + changes[i], 2.2));
  }
  before.push_back(Result("alone", "default", 0.5, 2));
  after.push_back(Result("failed", "default", 0.5, 2));
  after.back().run.outcome = "failed";
  const SweepComparison comparison = CompareSweeps(before, after, 0.02);
  EXPECT_EQ(comparison.unpaired, 2);
  const FigureComparison& f2 = Figure(comparison, "F2 aligned");
  EXPECT_EQ(f2.pairs, 5);
  EXPECT_NEAR(f2.difference, 0.03, 1e-12);  // the median of the changes, up to rounding
  EXPECT_EQ(f2.better, 3);
  EXPECT_EQ(f2.worse, 1);
  EXPECT_LE(f2.interval.low, 0.03);
  EXPECT_GE(f2.interval.high, 0.03);
  // A median of five is never beyond all five.
  EXPECT_GE(f2.interval.low, -0.1 - 1e-12);
  EXPECT_LE(f2.interval.high, 0.05 + 1e-12);
  EXPECT_EQ(Figure(comparison, "CPU s per 30 frames").worse, 5);  // 10 % is more than 2 %
  EXPECT_THAT(WorseCellText(comparison.worse[0]), testing::HasSubstr("F2 aligned -0.1000"));
  EXPECT_EQ(Figure(CompareSweeps(before, before, 0.02), "F2 aligned").interval.high, 0);
}

TEST(PairedComparison, ASettingIsComparedWithTheDefault) {
  const std::vector<CellResult> sweep = {
      Result("a", "default", 0.5, 2), Result("a", "x.y=1", 0.6, 2), Result("b", "default", 0.7, 2),
      Result("b", "x.y=1", 0.9, 2)};
  const SweepComparison comparison = CompareSweeps(sweep, sweep, 0.02, "x.y=1");
  EXPECT_EQ(Figure(comparison, "F2 aligned").pairs, 2);
  EXPECT_NEAR(Figure(comparison, "F2 aligned").difference, 0.15, 1e-12);
  EXPECT_EQ(comparison.unpaired, 0);
  EXPECT_TRUE(CompareSweeps(sweep, sweep, 0.02, "x.y=2").figures.empty());
}

// The interval of a median of many normal differences has the width of theory: 1.96 standard
// errors of sqrt(pi / 2) sigma / sqrt(n) to either side. A sample of n knows the density at its
// median to a share of n^(-1/4), 22 % here: two of these are allowed.
TEST(PairedComparison, IntervalsHaveTheWidthOfTheory) {
  std::vector<CellResult> before, after;
  uint64_t state = 1;
  constexpr int kPairs = 400;
  for (int i = 0; i < kPairs; ++i) {
    double sum = -6;  // of twelve uniform numbers: normal with a standard deviation of 1
    for (int k = 0; k < 12; ++k) {
      state = state * 6364136223846793005ull + 1442695040888963407ull;
      sum += static_cast<double>(state >> 11) * 0x1p-53;
    }
    before.push_back(Result(std::to_string(i), "default", 0, 1));
    after.push_back(Result(std::to_string(i), "default", sum, 1));
  }
  const FigureComparison f2 = Figure(CompareSweeps(before, after, 0.02), "F2 aligned");
  const double width = 2 * 1.96 * 1.2533 / 20;
  EXPECT_NEAR(f2.interval.high - f2.interval.low, width, 0.45 * width);
}

TEST(ParetoFront, HasThePointsThatNoOtherBeats) {
  std::vector<CellResult> results;
  const auto add = [&](const std::string& setting, double f2, double seconds) {
    for (const char* scan : {"a", "b", "c"}) {
      results.push_back(Result(scan, setting, f2, seconds));
    }
  };
  add("default", 0.8, 3);
  add("fast=1", 0.6, 1);
  add("slow=1", 0.7, 4);
  add("best=1", 0.9, 5);
  results.push_back(Result("a", "half=1", 1, 0.1));  // not on every scan
  const ParetoFront front = FindParetoFront(results, AccuracyFigure("F2 aligned"));
  EXPECT_EQ(front.scans, 3);
  EXPECT_THAT(front.left_out, testing::ElementsAre("best half=1"));
  ASSERT_EQ(front.points.size(), 4u);
  for (const ParetoPoint& point : front.points) {
    EXPECT_EQ(point.on_front, point.setting != "slow=1") << point.setting;
    EXPECT_NEAR(point.front_probability, point.setting == "slow=1" ? 0 : 1, 1e-9);
    EXPECT_NEAR(point.figure_interval.low, point.figure, 1e-12);  // scans do not differ
  }
  EXPECT_EQ(front.points[0].setting, "best=1");
  EXPECT_THROW(AccuracyFigure("F3"), Error);
  EXPECT_THROW(AccuracyFigure("CPU s per 30 frames"), Error);
}

// Where one setting is better on half of the scans and worse on the others, neither is sure.
TEST(ParetoFront, ProbabilityTellsWhatScansLeaveOpen) {
  std::vector<CellResult> results;
  for (int i = 0; i < 10; ++i) {
    const double sign = i % 2 == 0 ? 1 : -1;
    results.push_back(Result(std::to_string(i), "default", 0.5, 1));
    results.push_back(Result(std::to_string(i), "x.y=1", 0.5 + 0.1 * sign, 1.5));
  }
  for (const ParetoPoint& point : FindParetoFront(results, AccuracyFigure("F2 aligned")).points) {
    if (point.setting == "default") {
      EXPECT_NEAR(point.front_probability, 1, 1e-9);
      continue;
    }
    EXPECT_GT(point.front_probability, 0.1);
    EXPECT_LT(point.front_probability, 0.9);
  }
  EXPECT_THROW(FindParetoFront({}, AccuracyFigure("F2 aligned")), Error);
}

}  // namespace
}  // namespace curvefusion
