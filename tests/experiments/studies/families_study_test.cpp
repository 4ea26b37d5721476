#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "experiments/simulation/families/scan_draw.h"
#include "experiments/studies/families_report.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"
#include "kernel/error.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

TEST(SummaryOf, GivesMedianMeanAndTheWorstTenth) {
  std::vector<double> values;
  for (int i = 1; i <= 20; ++i) values.push_back(i);
  const auto summary = SummaryOf(values, true);
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->median, 10.5);
  EXPECT_EQ(summary->mean, 10.5);
  EXPECT_EQ(summary->worst_tenth, 1.5);
  EXPECT_EQ(SummaryOf(values, false)->worst_tenth, 19.5);
  EXPECT_EQ(SummaryOf({3, 1, 2}, true)->worst_tenth, 1);
  EXPECT_FALSE(SummaryOf({}, true));
}

TEST(TrustTable, CountsWhatIsDoubtedByHowGoodItIs) {
  const auto result = [](double f5, double precision, std::optional<bool> doubted) {
    StudyRun run;
    run.figures["aligned.curves.5mm.f"] = f5;
    run.figures["aligned.curves.5mm.precision"] = precision;
    if (doubted) run.figures["doubted"] = *doubted ? 1 : 0;
    return run;
  };
  const std::vector<StudyRun> runs = {result(1, 1, false),      result(0.95, 1, true),
                                      result(0.9, 0.95, false), result(0, 0, true),
                                      result(0.3, 0.9, true),   result(0.4, 0.5, {})};
  const std::vector<std::vector<std::string>> rows = TrustTable(runs).rows;
  ASSERT_EQ(rows.size(), 5u);
  const auto counts = [&](size_t row) { return rows[row][1] + " " + rows[row][2]; };
  EXPECT_EQ(counts(0), "2 1");
  EXPECT_EQ(counts(1), "1 0");
  EXPECT_EQ(counts(2), "0 0");
  EXPECT_EQ(counts(3), "2 2");
  EXPECT_EQ(counts(4), "1 1");  // what is false
}

TEST(FamiliesStudy, HasEveryFamilyInEverySplitOnOtherSeeds) {
  std::set<uint64_t> scans;
  for (const Split split : {Split::kTrain, Split::kValidation, Split::kTest}) {
    const auto cases = FamiliesStudy().cases(
        {.profiles = {Profile::kBest}, .seeds = 2, .split = split, .objects = {"cage", "room"}});
    ASSERT_EQ(cases.size(), 4u);
    for (const StudyCase& study_case : cases) {
      EXPECT_TRUE(scans.insert(study_case.scan->seed).second);
    }
    EXPECT_EQ(LabelOf(cases.back().labels, "contrast"), "none");
  }
  EXPECT_THROW(FamiliesStudy().cases({.objects = {"cages"}}), Error);
}

TEST(FamiliesStudy, TakesRecordingsAlong) {
  const TemporaryFolder data("families_study");
  std::filesystem::create_directories(data / "sim" / "basket");
  std::filesystem::create_directories(data / "sim" / "basket.truth");
  std::filesystem::create_directories(data / "real" / "kitchen");
  const auto cases = FamiliesStudy().cases(
      {.profiles = {Profile::kBest}, .seeds = 1, .objects = {"room"}, .data = data});
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[1].recording, data / "real" / "kitchen");
  EXPECT_EQ(LabelOf(cases[2].labels, "family"), "recording basket");
  EXPECT_FALSE(cases[2].scan);
}

}  // namespace
}  // namespace curvefusion
