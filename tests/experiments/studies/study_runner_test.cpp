#include "experiments/studies/study_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <limits>

#include "experiments/studies/studies.h"
#include "kernel/error.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Studies without scans, whose runs cost nothing and count themselves.
class StudyRunner : public testing::Test {
 protected:
  // Cases a, b and c; the figure is the seed.
  Study Counting() {
    Study study;
    study.name = "counting";
    study.cases = [](const StudyRequest& request) {
      std::vector<StudyCase> cases;
      for (const char* name : {"a", "b", "c"}) {
        for (const uint64_t seed : SeedsOf(request)) {
          cases.push_back(
              {{{"case", name}}, seed, std::nullopt, CaseConfig(request, Profile::kBest)});
        }
      }
      return cases;
    };
    study.run = [this](const RunInput& input) {
      ++calls_;
      std::ofstream(input.folder / "kept.txt") << "kept";
      return RunOutcome{true, {{"seed figure", static_cast<double>(input.study_case.seed)}}};
    };
    return study;
  }

  StudyResults Run(const Study& study, const StudyRequest& request = {},
                   const RunnerOptions& options = {}) {
    return RunStudy(study, request, folder_, options, NoProgress);
  }

  const TemporaryFolder folder_{"study_runner"};
  std::atomic<int> calls_ = 0;
};

TEST_F(StudyRunner, SecondCallMeasuresNothingAgain) {
  const StudyResults first = Run(Counting());
  EXPECT_EQ(calls_, 9);  // three cases, three seeds
  EXPECT_TRUE(fs::exists(folder_ / "runs/counting_train/b_s2/kept.txt"));
  const StudyResults second = Run(Counting());
  EXPECT_EQ(calls_, 9);
  ASSERT_EQ(second.runs.size(), 9u);
  for (size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(second.runs[i].labels, first.runs[i].labels);
    EXPECT_EQ(second.runs[i].figures, first.runs[i].figures);
    EXPECT_EQ(second.runs[i].outcome, "done");
  }
}

TEST_F(StudyRunner, ChangedSettingsAreMeasuredAgain) {
  Run(Counting(), {.seeds = 1});
  StudyRequest changed{.seeds = 1, .assignments = {"volume.voxel_size=0.02"}};
  const StudyPlan plan = PlanStudy(Counting(), changed, folder_);
  EXPECT_EQ(plan.finished, 0);
  EXPECT_EQ(plan.other_settings, 3);
  Run(Counting(), changed);
  EXPECT_EQ(calls_, 6);
  EXPECT_EQ(PlanStudy(Counting(), changed, folder_).finished, 3);
}

TEST_F(StudyRunner, FailedRunIsRecordedAndTriedAgain) {
  Study study = Counting();
  bool broken = true;
  study.run = [&](const RunInput& input) -> RunOutcome {
    ++calls_;
    if (broken && LabelOf(input.study_case.labels, "case") == "b") {
      throw Error(ErrorKind::kBadInput, "b, is broken");
    }
    return {true, {}};
  };
  const StudyResults results = Run(study, {.seeds = 1});
  EXPECT_EQ(results.runs[0].outcome, "done");
  EXPECT_EQ(results.runs[1].outcome, "failed");
  EXPECT_EQ(results.runs[1].message, "b, is broken");
  EXPECT_EQ(results.runs[2].outcome, "done");
  EXPECT_THAT(FileText(folder_ / "counting_train.csv"), HasSubstr("b,1,failed,\"b, is broken\","));
  broken = false;
  EXPECT_EQ(Run(study, {.seeds = 1}).runs[1].outcome, "done");
  EXPECT_EQ(calls_, 4);  // only the failed one once more
}

TEST_F(StudyRunner, NothingFoundIsAnOutcome) {
  Study study = Counting();
  study.run = [](const RunInput&) { return RunOutcome{false, {{"recall", 0}}}; };
  EXPECT_EQ(Run(study, {.seeds = 1}).runs[0].outcome, "nothing found");
  EXPECT_EQ(PlanStudy(study, {.seeds = 1}, folder_).finished, 3);
}

TEST_F(StudyRunner, FigureThatIsNoNumberHasNoValue) {
  Study study = Counting();
  study.run = [](const RunInput&) {
    return RunOutcome{true, {{"bad", std::numeric_limits<double>::quiet_NaN()}, {"good", 1}}};
  };
  EXPECT_EQ(Run(study, {.seeds = 1}).runs[0].figures, (Figures{{"good", 1}}));
  EXPECT_EQ(PlanStudy(study, {.seeds = 1}, folder_).finished, 3);
}

TEST_F(StudyRunner, InterruptedRunLeavesNothingAndTheRestStays) {
  Study study = Counting();
  study.run = [&](const RunInput& input) {
    if (LabelOf(input.study_case.labels, "case") == "b") input.progress("within", 0, 1);
    return RunOutcome{true, {}};
  };
  int calls_of_progress = 0;
  const Progress interrupt_second = [&](std::string_view, int64_t, int64_t) {
    if (++calls_of_progress == 2) throw Error(ErrorKind::kInterrupted, "");
  };
  EXPECT_THROW(RunStudy(study, {.seeds = 1}, folder_, {}, interrupt_second), Error);
  std::vector<std::string> left;
  for (const auto& entry : fs::directory_iterator(folder_ / "runs/counting_train")) {
    left.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(left, testing::ElementsAre("a_s1"));
  EXPECT_EQ(PlanStudy(study, {.seeds = 1}, folder_).finished, 1);
}

TEST_F(StudyRunner, ProgressCountsFramesWhileScansAreSimulated) {
  Study study = Counting();
  study.cases = [cases = study.cases](const StudyRequest& request) {
    std::vector<StudyCase> with_scan = cases(request);
    with_scan.resize(2);
    for (StudyCase& study_case : with_scan) {
      study_case.scan = SimulationOptions{.object = "triangles", .sensor = "ideal", .frames = 2};
    }
    return with_scan;
  };
  std::vector<int64_t> counted;
  const Progress count = [&](std::string_view stage, int64_t done, int64_t total) {
    EXPECT_EQ(stage, "counting, frames");
    EXPECT_EQ(total, 6);  // two frames simulated once and measured twice
    counted.push_back(done);
  };
  RunStudy(study, {.seeds = 1}, folder_, {}, count);
  EXPECT_THAT(counted, testing::ElementsAre(1, 2, 4, 6));
}

TEST_F(StudyRunner, RemeasuresWhatAnotherRevisionMeasured) {
  Run(Counting(), {.seeds = 1});
  const fs::path file = folder_ / "runs/counting_train/a_s1/run.json";
  std::string text = FileText(file);
  const size_t place = text.find("\"revision\": \"") + 13;
  text.insert(place, "older-");
  std::ofstream(file) << text;
  EXPECT_EQ(PlanStudy(Counting(), {.seeds = 1}, folder_).other_revision, 1);
  Run(Counting(), {.seeds = 1});
  EXPECT_EQ(calls_, 3);
  Run(Counting(), {.seeds = 1}, {.remeasure = true});
  EXPECT_EQ(calls_, 4);
  EXPECT_EQ(PlanStudy(Counting(), {.seeds = 1}, folder_).other_revision, 0);
}

TEST_F(StudyRunner, SameRunsForAnyNumberOfJobs) {
  Run(Counting());
  const std::string one_job = FileText(folder_ / "counting_train.csv");
  fs::remove_all(folder_);
  Run(Counting(), {}, {.jobs = 3});
  EXPECT_EQ(FileText(folder_ / "counting_train.csv"), one_job);
  EXPECT_EQ(calls_, 18);
}

TEST_F(StudyRunner, SplitsAndQuickOnesAreKeptApart) {
  EXPECT_THAT(SeedsOf({}), testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(SeedsOf({.seeds = 2, .split = Split::kTest}), testing::ElementsAre(101, 102));
  EXPECT_THAT(SeedsOf({.seeds = 2, .split = Split::kValidation}), testing::ElementsAre(201, 202));
  for (const std::string& name : SplitNames()) EXPECT_EQ(SplitName(SplitNamed(name)), name);
  EXPECT_THROW(SplitNamed("tests"), Error);
  EXPECT_THAT(SeedsOf({.quick = true}), testing::ElementsAre(1));
  EXPECT_EQ(StudyStem(Counting(), {}), "counting_train");
  EXPECT_EQ(StudyStem(Counting(), {.quick = true, .split = Split::kTest}), "counting_test_quick");
}

TEST_F(StudyRunner, TwoCasesOfOneNameAreRefused) {
  Study study = Counting();
  study.cases = [](const StudyRequest&) {
    return std::vector<StudyCase>{{{{"case", "a b"}}, 1, {}, {}}, {{{"case", "a/b"}}, 1, {}, {}}};
  };
  EXPECT_THROW(Run(study), Error);
}

TEST_F(StudyRunner, EveryStudyHasCasesThatCanBeTold) {
  for (const Study& study : AllStudies()) {
    for (const bool quick : {true, false}) {
      EXPECT_FALSE(PlanStudy(study, {.quick = quick}, folder_).cases.empty()) << study.name;
    }
    EXPECT_FALSE(study.summary.empty()) << study.name;
  }
  EXPECT_THROW(StudyNamed("objekts"), Error);
}

// The whole way, small: a scan without noise, simulated once for both profiles.
TEST_F(StudyRunner, ReconstructsAndEvaluatesSimulatedScans) {
  Study study;
  study.name = "smoke";
  study.cases = [](const StudyRequest& request) {
    std::vector<StudyCase> cases;
    for (const Profile profile : request.profiles) {
      SimulationOptions scan;
      scan.object = "valence6";
      scan.sensor = "ideal";
      scan.pose_source = "true";
      scan.frames = 6;
      cases.push_back({{{"profile", ProfileName(profile)}}, 1, scan, CaseConfig(request, profile)});
    }
    return cases;
  };
  const StudyResults results = Run(study);
  ASSERT_EQ(results.runs.size(), 2u);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "scans"), {}), 1);
  for (const StudyRun& run : results.runs) {
    EXPECT_EQ(run.outcome, "done") << run.message;
    // Six clean frames from nearly one side: what is seen must be found, axes within 5 mm.
    EXPECT_GT(run.figures.at("raw.curves.5mm.recall"), 0.7);
    EXPECT_GT(run.figures.at("cpu_seconds"), 0);
    EXPECT_GT(run.figures.at("peak_memory_mb"), 1);
    for (const char* file : {"config.toml", "evaluation.json", "run.json", "skeleton.json"}) {
      EXPECT_TRUE(fs::exists(run.folder / file)) << file;
    }
  }
  EXPECT_THAT(FileText(results.runs[0].folder / "run.json"), HasSubstr("\"processor\""));
}

}  // namespace
}  // namespace curvefusion
