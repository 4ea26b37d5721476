#include <gtest/gtest.h>

#include <fstream>

#include "experiments/studies/run_files.h"
#include "experiments/studies/study_runner.h"
#include "experiments/sweeps/cell_measurement.h"
#include "experiments/sweeps/sweep_plan.h"
#include "tests/experiments/studies/tiny_objects.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

// A sweep and a study that measure the same: one scan of six frames, which takes seconds.
class StudyCells : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "shared");
    std::ofstream(folder_ / "study.toml")
        << "objects = [\"valence6\"]\nsensors = [\"ideal\"]\nposes = [\"true\"]\n"
           "frames = 6\nseeds = 1\n";
  }
  SweepPlan Plan(const char* name) {
    return WriteSweepPlan(folder_ / "study.toml", folder_ / name, {folder_ / "shared"}, "none");
  }

  StudyRun RunOnly(const char* name, const std::vector<fs::path>& caches) {
    const StudyRequest request{.profiles = {Profile::kBest}, .seeds = 1, .objects = {"valence6"}};
    RunnerOptions options;
    options.caches = caches;
    if (!caches.empty()) options.reconstruct = MeasurementByCells({folder_ / name, caches});
    return RunStudy(TinyObjects(), request, folder_ / name, options, NoProgress).runs.at(0);
  }

  const TemporaryFolder folder_{"study_cells"};
};

TEST_F(StudyCells, AreMeasuredOnceBySweepsAndStudies) {
  const StudyRun first = RunOnly("first", {folder_ / "shared"});
  EXPECT_EQ(first.outcome, "done") << first.message;
  const SweepPlan plan = Plan("sweep");
  ASSERT_EQ(plan.cells.size(), 1u);
  const fs::path result = FinishedResult(plan, plan.cells[0]);
  ASSERT_FALSE(result.empty());
  EXPECT_FALSE(FinishedScan(plan, plan.cells[0].scan).empty());
  EXPECT_EQ(ReadParams(result.parent_path() / "params.toml").key, plan.cells[0].key);
  EXPECT_EQ(ReadRunFile(result)->run.figures, first.figures);  // its seconds, too

  const StudyRun second = RunOnly("second", {folder_ / "shared"});
  EXPECT_EQ(second.figures, first.figures);
  EXPECT_TRUE(fs::exists(second.folder / "skeleton.json"));
  EXPECT_FALSE(fs::exists(folder_ / "second" / "scans"));

  const StudyRun alone = RunOnly("alone", {});
  EXPECT_NE(alone.figures.at("seconds"), first.figures.at("seconds"));
  EXPECT_EQ(alone.figures.at("aligned.curves.2mm.f"), first.figures.at("aligned.curves.2mm.f"));
}

TEST_F(StudyCells, FailedCellIsFailedRun) {
  RunOnly("first", {folder_ / "shared"});
  const SweepPlan plan = Plan("sweep");
  const fs::path result = FinishedResult(plan, plan.cells.at(0));
  RunFile file = ReadRunFile(result).value();
  file.run.outcome = "failed";
  file.run.message = "for good";
  WriteRunFile(result, file);
  const StudyRun second = RunOnly("second", {folder_ / "shared"});
  EXPECT_EQ(second.outcome, "failed");
  EXPECT_EQ(second.message, "for good");
}

TEST_F(StudyCells, ResultThatCannotBeReadIsNamed) {
  RunOnly("first", {folder_ / "shared"});
  const SweepPlan plan = Plan("sweep");
  std::ofstream(FinishedResult(plan, plan.cells.at(0)) / "run.json") << "{";
  const StudyRun second = RunOnly("second", {folder_ / "shared"});
  EXPECT_EQ(second.outcome, "failed");
  EXPECT_NE(second.message.find("run.json: cannot be read"), std::string::npos) << second.message;
}

}  // namespace
}  // namespace curvefusion
