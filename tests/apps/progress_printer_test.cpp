#include "apps/progress_printer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace curvefusion {
namespace {

using testing::HasSubstr;
using testing::Not;

struct FakeRun {
  double now = 0;
  std::ostringstream stream;
  ProgressPrinter printer;

  explicit FakeRun(ProgressPrinter::Style style) : printer(stream, style, [this] { return now; }) {}
};

TEST(ProgressPrinter, ATerminalShowsShareAndTimeLeftOnOneLine) {
  FakeRun run(ProgressPrinter::Style::kTerminal);
  run.printer.Report("volume", 0, 100);
  run.now = 5;
  run.printer.Report("volume", 25, 100);
  EXPECT_THAT(run.stream.str(), HasSubstr("25 %  25 of 100, 15 s left"));
  EXPECT_THAT(run.stream.str(), Not(HasSubstr("\n")));
  run.printer.Finish();
  EXPECT_THAT(run.stream.str(), HasSubstr("5.0 s\n"));
}

TEST(ProgressPrinter, LongTimesLeftAreInMinutes) {
  FakeRun run(ProgressPrinter::Style::kTerminal);
  run.printer.Report("volume", 0, 100);
  run.now = 125;
  run.printer.Report("volume", 50, 100);
  EXPECT_THAT(run.stream.str(), HasSubstr("2 min 05 s left"));
}

TEST(ProgressPrinter, ALogGetsALinePerStageAndEveryTenSeconds) {
  FakeRun run(ProgressPrinter::Style::kLines);
  for (int i = 0; i <= 21; ++i) {
    run.now = i;
    run.printer.Report("volume", i, 100);
  }
  run.printer.Report("skeleton", 0, 1);
  run.printer.Finish();
  const std::string text = run.stream.str();
  // At 10 s, at 20 s, at the end of the first and of the second stage.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);
  EXPECT_THAT(text, Not(HasSubstr("\033")));
}

TEST(ProgressPrinter, AStageThatReportsOnlyItsBeginningLastsUntilTheNext) {
  FakeRun run(ProgressPrinter::Style::kTerminal);
  run.printer.Report("volume", 0, 1);
  EXPECT_THAT(run.stream.str(), HasSubstr("volume"));  // shown while it runs
  run.now = 2;
  run.printer.Report("segmentation", 0, 2);
  EXPECT_THAT(run.stream.str(), HasSubstr("segmentation"));
  run.now = 8;
  run.printer.Finish();
  EXPECT_THAT(run.stream.str(), HasSubstr("2.0 s"));
  EXPECT_THAT(run.stream.str(), HasSubstr("6.0 s"));
}

TEST(ProgressPrinter, WithAPlanTheTimeLeftIsThatOfTheRun) {
  FakeRun run(ProgressPrinter::Style::kTerminal);
  run.printer.Plan({{"volume", 10}, {"segmentation", 30}, {"contraction", 10}});
  run.printer.Report("volume", 0, 100);
  run.now = 10;
  run.printer.Report("volume", 50, 100);
  // Twice as slow as planned: 10 s of the volume, 60 and 20 s of what follows.
  EXPECT_THAT(run.stream.str(), HasSubstr("50 of 100"));
  EXPECT_THAT(run.stream.str(), HasSubstr("10 % of the run, 1 min 30 s left"));
  run.now = 20;
  run.printer.Report("contraction", 0, 1);  // the segmentation was left out
  EXPECT_THAT(run.stream.str(), HasSubstr("50 % of the run, 20 s left"));
}

TEST(ProgressPrinter, QuietPrintsNothing) {
  FakeRun run(ProgressPrinter::Style::kQuiet);
  run.printer.Report("volume", 0, 2);
  run.now = 100;
  run.printer.Report("volume", 2, 2);
  run.printer.Finish();
  EXPECT_EQ(run.stream.str(), "");
}

TEST(ProgressPrinter, AStageOfNoStepsIsNoDivisionByZero) {
  FakeRun run(ProgressPrinter::Style::kTerminal);
  run.printer.Report("nothing", 0, 0);
  EXPECT_THAT(run.stream.str(), HasSubstr("0 of 0"));
}

}  // namespace
}  // namespace curvefusion
