// The page of claims, from made-up runs in a folder: nothing is simulated or reconstructed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/reproduction/reproduction_page.h"
#include "experiments/studies/case_settings.h"
#include "experiments/studies/run_files.h"
#include "experiments/studies/studies.h"
#include "experiments/studies/study_runner.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReproductionOf : public testing::Test {
 protected:
  // Every case of a study as finished, with these figures.
  void Finish(const std::string& name, const Figures& figures) {
    const Study study = StudyNamed(name);
    for (const StudyCase& study_case : study.cases(request_)) {
      const fs::path run_folder = RunFolder(study, request_, folder_, study_case);
      fs::create_directories(run_folder);
      const StudyRun run{study_case.labels, study_case.seed, "done", "", "abc",
                         run_folder,        figures};
      WriteRunFile(run_folder, {run, CaseSettings(study_case)});
    }
  }

  std::string Page() {
    WriteReproduction(request_, folder_);
    return FileText(folder_ / "reproduction.md");
  }

  const TemporaryFolder folder_{"reproduction"};
  StudyRequest request_{.quick = true};
};

TEST(Claims, NameStudiesThatThereAreAndSayWhatIsMeasured) {
  std::set<std::string> studies;
  for (const Study& study : AllStudies()) studies.insert(study.name);
  std::set<std::string> seen;
  for (const Claim& claim : Claims()) {
    EXPECT_EQ(claim.study.empty(), !claim.measure) << claim.words;
    EXPECT_TRUE(claim.study.empty() || studies.count(claim.study) == 1) << claim.study;
    EXPECT_FALSE(claim.figure.empty()) << claim.words;
    EXPECT_FALSE(claim.place.empty()) << claim.words;
    EXPECT_EQ(claim.origin.empty(), !claim.measure) << claim.words;
    EXPECT_TRUE(seen.insert(claim.words).second) << claim.words;
    // "Exceeded" of what the paper says works needs a bound beyond the claim, never below it.
    EXPECT_TRUE(claim.bound.Holds(claim.bound.beyond.value_or(claim.bound.value))) << claim.words;
  }
  EXPECT_GT(Claims().size(), 35u);
}

// A label or figure that no case has would leave a claim unmeasured for ever.
TEST(Claims, AreMeasuredByTheFullSizeOfTheirStudies) {
  Figures figures;
  for (const char* name :
       {"F2", "F5", "recall", "wires.resolved", "contraction_share", "global_diameter_mm",
        "surface.F2", "surface.recall", "normal_error_deg", "spurious_junctions", "reconstructed",
        "trajectory_error_mm", "candidate_precision", "seconds_per_30_frames",
        "seconds_per_30_frames_without_contraction"}) {
    figures[name] = 1;
  }
  for (const char* kind :
       {"aligned.curves.2mm.f", "aligned.curves.5mm.f", "aligned.junctions_10mm.matched",
        "aligned.junctions_10mm.truth", "aligned.junctions_10mm.valence_right",
        "aligned.diameter.relative_error"}) {
    figures[kind] = 1;
  }
  for (const int mm : {1, 2, 4}) figures["recall_of_" + std::to_string(mm) + "mm"] = 1;
  for (const char* place : {"1.5", "2.5", "55"}) figures[std::string("recall_at.") + place] = 1;
  figures["whole_at.6"] = 1;
  for (const Claim& claim : Claims()) {
    if (claim.study.empty()) continue;
    std::vector<StudyRun> runs;
    for (const StudyCase& study_case : StudyNamed(claim.study).cases({})) {
      runs.push_back({study_case.labels, study_case.seed, "done", "", "", "", figures});
    }
    for (const ClaimResult& result : Judge(claim, runs)) {
      EXPECT_NE(result.verdict, Verdict::kNotMeasured) << claim.words << " " << result.subject;
    }
  }
}

TEST_F(ReproductionOf, AnEmptyFolderHasNoVerdict) {
  const std::string page = Page();
  EXPECT_THAT(page, HasSubstr("curvefusion experiment all -o DIR --quick"));
  EXPECT_THAT(page, HasSubstr("0 of 2 runs finished"));  // table1: one object, both profiles
  for (const JudgedClaim& judged : JudgeClaims(request_, folder_).claims) {
    for (const ClaimResult& result : judged.results) {
      EXPECT_EQ(result.verdict, Verdict::kNotMeasured) << judged.claim->words;
    }
  }
}

TEST_F(ReproductionOf, FinishedRunsGiveFigureVerdictPictureAndCommand) {
  Finish("table1", {{"aligned.junctions_10mm.matched", 98},
                    {"aligned.junctions_10mm.truth", 100},
                    {"aligned.junctions_10mm.valence_right", 50}});
  std::ofstream(folder_ / "table1_train_quick.png") << "picture";
  std::ofstream(folder_ / "table1_train.png") << "of the full size";
  const std::string page = Page();
  EXPECT_THAT(page, HasSubstr("paper: 0.980: exceeded<br>best: 0.980: exceeded"));
  EXPECT_THAT(page, HasSubstr("paper: 0.500: not reproduced"));
  EXPECT_THAT(page, HasSubstr("`curvefusion experiment table1 -o DIR --quick`: 2 of 2 runs"));
  EXPECT_THAT(page, HasSubstr("(images/reproduction/table1_train_quick.png)"));
  EXPECT_THAT(page, Not(HasSubstr("table1_train.png")));
  EXPECT_EQ(FileText(folder_ / "images/reproduction/table1_train_quick.png"), "picture");
}

TEST_F(ReproductionOf, VerdictsOfAnUnfinishedStudySaySo) {
  Finish("poses", {{"aligned.curves.2mm.f", 1}, {"aligned.curves.5mm.f", 1}});
  EXPECT_THAT(Page(), Not(HasSubstr("<br>from ")));
  fs::remove_all(folder_ / "runs/poses_train_quick/true_registered_paper_s1");
  EXPECT_THAT(Page(), HasSubstr("best: 0.00: reproduced<br>from 15 of 16 runs"));
}

TEST_F(ReproductionOf, QuickRunsStandInForAStudyWithoutFullOnes) {
  Finish("poses", {{"aligned.curves.2mm.f", 1}, {"aligned.curves.5mm.f", 1}});
  request_.quick = false;
  const std::string page = Page();
  EXPECT_THAT(page, HasSubstr("`curvefusion experiment poses -o DIR --quick`: 16 of 16 runs"));
  EXPECT_THAT(page, HasSubstr("`curvefusion experiment table1 -o DIR`: 0 of"));
  EXPECT_THAT(page, HasSubstr("Commands with `--quick`"));
}

TEST_F(ReproductionOf, RunsWithOtherSettingsDoNotCount) {
  Finish("poses", {{"aligned.curves.2mm.f", 1}, {"aligned.curves.5mm.f", 1}});
  StudyRequest other = request_;
  other.assignments = {"volume.voxel_size=0.02"};
  EXPECT_EQ(FinishedRuns(PosesStudy(), request_, folder_).runs.size(), 16u);
  EXPECT_TRUE(FinishedRuns(PosesStudy(), other, folder_).runs.empty());
}

TEST_F(ReproductionOf, DataHoldTheSameVerdicts) {
  Finish("poses", {{"aligned.curves.2mm.f", 1}, {"aligned.curves.5mm.f", 1}});
  Page();
  const auto json = nlohmann::json::parse(FileText(folder_ / "reproduction_claims.json"));
  ASSERT_EQ(json.at("claims").size(), Claims().size());
  int measured = 0;
  for (const auto& claim : json.at("claims")) {
    for (const auto& result : claim.at("results")) {
      measured += result.at("verdict") == "not measured" ? 0 : 1;
    }
  }
  EXPECT_EQ(measured, 8);  // three claims on poses, one on raw colour, two profiles
  EXPECT_THAT(FileText(folder_ / "reproduction_claims.csv"), HasSubstr("PTAM"));
  EXPECT_THAT(FileText(folder_ / "reproduction_claims.tex"), HasSubstr("\\toprule"));
}

}  // namespace
}  // namespace curvefusion
