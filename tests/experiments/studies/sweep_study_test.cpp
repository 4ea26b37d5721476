#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "experiments/studies/gnuplot.h"
#include "experiments/studies/regression_check.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"
#include "kernel/error.h"
#include "tests/experiments/studies/gnuplot_fixture.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> SettingsOf(const StudyRequest& request) {
  std::vector<std::string> settings;
  for (const StudyCase& study_case : SweepStudy().cases(request)) {
    settings.push_back(LabelOf(study_case.labels, "setting"));
  }
  return settings;
}

StudyRequest RequestFor(const std::vector<std::string>& assignments) {
  return {.seeds = 1, .assignments = assignments, .objects = {"cage"}};
}

TEST(SweepStudy, TriesAllCombinationsAndTheDefault) {
  EXPECT_THAT(SettingsOf(RequestFor({"bundle.min_frames=1,2", "colour_adjustment.enabled=false"})),
              ElementsAre("default", "bundle.min_frames=1 colour_adjustment.enabled=false",
                          "bundle.min_frames=2 colour_adjustment.enabled=false"));
  EXPECT_THAT(SettingsOf(RequestFor({})), ElementsAre("default"));
  const auto cases = SweepStudy().cases(RequestFor({"bundle.min_frames=1,2"}));
  const auto min_frames = [&](size_t i) {
    return std::get<BestOptions>(cases[i].config.pipeline).segmentation.bundle.min_frames;
  };
  EXPECT_EQ(min_frames(0), DefaultBestOptions().segmentation.bundle.min_frames);
  EXPECT_EQ(min_frames(1), 1);
  EXPECT_EQ(min_frames(2), 2);
}

TEST(SweepStudy, RefusesWhatCannotBe) {
  EXPECT_THROW(SettingsOf(RequestFor({"bundle.min_frames=1,0"})), Error);
  EXPECT_THROW(SettingsOf(RequestFor({"bundle.min_frames="})), Error);
  EXPECT_THROW(SettingsOf(RequestFor({"bundle.min_frames"})), Error);
  EXPECT_THROW(SettingsOf(RequestFor({"bundle.min_frame=1"})), Error);
  EXPECT_THROW(SettingsOf({.objects = {"kage"}}), Error);
}

TEST(SweepStudy, ChoosesSettingsSoThatItMustNotSeeTheTestSplit) {
  EXPECT_THROW(PlanStudy(SweepStudy(), {.split = Split::kTest}, "none"), Error);
  EXPECT_THROW(PlanStudy(SweepStudy(), {.split = Split::kValidation}, "none"), Error);
  EXPECT_NO_THROW(PlanStudy(AblationStudy(), {.quick = true, .split = Split::kTest}, "none"));
}

// The sweep on a scan that takes seconds: six frames without noise.
Study TinySweep() {
  Study study = SweepStudy();
  const auto cases = study.cases;
  study.cases = [cases](const StudyRequest& request) {
    std::vector<StudyCase> tiny = cases(request);
    for (StudyCase& study_case : tiny) {
      study_case.scan->sensor = "ideal";
      study_case.scan->pose_source = "true";
      study_case.scan->frames = 6;
    }
    return tiny;
  };
  return study;
}

StudyRun RunWith(const Figures& figures) {
  return {{{"object", "cage"}, {"setting", "default"}}, 1, "done", "", "", {}, figures};
}

class Sweep : public WithGnuplot {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  const fs::path folder_ = TemporaryPath("sweep");
};

// The profile alone, as for a baseline: nothing changes, and gnuplot must bear it.
TEST_F(Sweep, OfNothingIsDrawnToo) {
  fs::create_directories(folder_);
  StudyResults results{folder_, "alone", {RunWith({{"aligned.curves.2mm.f", 0.9}})}};
  EXPECT_NO_THROW(SweepStudy().report(results));
  results.runs.push_back(results.runs[0]);
  results.runs[1].labels[1].second = "bundle.min_frames=3";
  results.runs.push_back(results.runs[0]);
  results.runs[2].labels[1].second = "bundle.min_frames=4";
  EXPECT_NO_THROW(SweepStudy().report(results));
}

TEST_F(Sweep, MeasuresDrawsAndComparesWithABaseline) {
  StudyRequest request = RequestFor({"registration.axis_depth=0,0.4"});
  request.objects = {"valence6"};
  const StudyResults results = RunStudy(TinySweep(), request, folder_, {}, NoProgress);
  ASSERT_EQ(results.runs.size(), 3u);
  for (const StudyRun& run : results.runs) EXPECT_EQ(run.outcome, "done") << run.message;
  // Without it the curves lie before the axes: it must show.
  EXPECT_NE(results.runs[0].figures.at("raw.curves.1mm.f"),
            results.runs[1].figures.at("raw.curves.1mm.f"));
  for (const char* name : {"sweep_train.md", "sweep_train.tex", "sweep_train.csv",
                           "sweep_train.png", "sweep_train_curves.pdf"}) {
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  }
  std::stringstream table;
  table << std::ifstream(folder_ / "sweep_train.md").rdbuf();
  EXPECT_THAT(table.str(), HasSubstr("| default | 1 |"));
  EXPECT_THAT(table.str(), HasSubstr("(1.00)"));

  const auto baseline = ReadBaseline(TinySweep(), request, folder_);
  EXPECT_FALSE(CompareWithBaseline(baseline, results.runs, 0).fell);
  EXPECT_THROW(ReadBaseline(TinySweep(), request, folder_ / "none"), Error);
  request.seeds = 2;  // the second was not measured
  EXPECT_THROW(ReadBaseline(TinySweep(), request, folder_), Error);
  request.seeds = 1;  // but not on the scan of the whole study
  EXPECT_THROW(ReadBaseline(SweepStudy(), request, folder_), Error);
}

TEST(CompareWithBaseline, JudgesEachFigureInItsOwnDirection) {
  const StudyRun before = RunWith({{"aligned.curves.2mm.f", 0.9},
                                   {"raw.diameter.mean_error_mm", 0.2},
                                   {"cpu_seconds_per_30_frames", 1}});
  const auto fell = [&](const std::string& figure, double value) {
    StudyRun now = before;
    now.figures[figure] = value;
    return CompareWithBaseline({before}, {now}, 0.02).fell;
  };
  EXPECT_FALSE(fell("aligned.curves.2mm.f", 0.885));
  EXPECT_TRUE(fell("aligned.curves.2mm.f", 0.875));
  EXPECT_FALSE(fell("aligned.curves.2mm.f", 1));
  EXPECT_TRUE(fell("raw.diameter.mean_error_mm", 0.23));
  EXPECT_FALSE(fell("raw.diameter.mean_error_mm", 0.1));
  EXPECT_FALSE(fell("cpu_seconds_per_30_frames", 9));  // told, not judged
  StudyRun failed = RunWith({});
  failed.outcome = "failed";
  const RegressionCheck check = CompareWithBaseline({before}, {failed}, 0.02);
  EXPECT_TRUE(check.fell);
  EXPECT_THAT(check.table.headings,
              ElementsAre("setting", "figure", "before", "now", "ratio", "judged"));
}

}  // namespace
}  // namespace curvefusion
