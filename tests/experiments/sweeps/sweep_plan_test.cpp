#include "experiments/sweeps/sweep_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "experiments/sweeps/cell_measurement.h"
#include "experiments/sweeps/sweep_results.h"
#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kTiny =
    "objects = [\"valence6\"]\nseeds = 1\nframes = 6\nsensors = [\"ideal\"]\n"
    "poses = [\"true\"]\n";

class SweepPlanTest : public testing::Test {
 protected:
  fs::path Study(const std::string& text) const {
    std::ofstream(folder_ / "study.toml") << text;
    return folder_ / "study.toml";
  }

  SweepCells Cells(const std::string& text) const { return CellsOf(ReadSweepRequest(Study(text))); }

  std::string Refusal(const std::string& text) const {
    return MessageOf([&] { Cells(text); });
  }

  SweepPlan Plan(const std::string& text, const std::string& name,
                 const std::vector<fs::path>& caches = {}) const {
    return WriteSweepPlan(Study(text), folder_ / name, caches, "curvefusion");
  }

  // Measures a planned cell, with its scan, where a run would.
  CellOutcome Measure(const SweepPlan& plan, const SweepCell& cell) const {
    const fs::path scan = StoreOf(plan) / "scans" / cell.scan;
    MakeSweepScan(plan.folder / "scans" / (cell.scan + ".json"), scan, NoProgress);
    return MeasureCell(cell, scan, ResultFolder(StoreOf(plan), cell), NoProgress);
  }

  const TemporaryFolder folder_{"sweep_plan"};
};

TEST_F(SweepPlanTest, MeetsEveryPointOnEveryScanOnce) {
  const SweepCells cells = Cells(
      "objects = [\"cage\", \"cat\"]\nfamilies = [\"tree\"]\nseeds = 2\n"
      "[grid]\nbundle.min_frames = [1, 4]\n"
      "[[points]]\nbundle.min_frames = 4\n"  // the grid has it already
      "[sample]\npoints = 3\n[sample.ranges]\n"
      "ridge_projection.kernel_sigma = { from = 0.003, to = 0.004 }\n");
  EXPECT_EQ(cells.scans.size(), 6u);
  EXPECT_EQ(cells.cells.size(), 6u * (1 + 2 + 3));
  std::set<std::string> keys;
  for (const SweepCell& cell : cells.cells) keys.insert(cell.key);
  EXPECT_EQ(keys.size(), cells.cells.size());
  EXPECT_EQ(SettingName(cells.cells[0]), "default");
}

TEST_F(SweepPlanTest, KeysChangeWithWhatDecidesTheResultAndNothingElse) {
  const std::string key = Cells(kTiny).cells[0].key;
  EXPECT_EQ(Cells(std::string(kTiny) + "threads = 2\nmemory_mb = 5\n").cells[0].key, key);
  const std::string min_frames = std::to_string(
      std::get<BestOptions>(ProfileConfig(Profile::kBest).pipeline).segmentation.bundle.min_frames);
  EXPECT_EQ(
      Cells(std::string(kTiny) + "[grid]\nbundle.min_frames = [" + min_frames + "]\n").cells.size(),
      1u);  // a setting that changes nothing is none
  SweepCell cell = Cells(kTiny).cells[0];
  const auto changed = [&] { return CellKey(cell) != key; };
  cell.profile = Profile::kPaper;
  EXPECT_TRUE(changed());
  cell = Cells(kTiny).cells[0];
  cell.settings = {"bundle.min_frames=9"};
  EXPECT_TRUE(changed());
  cell = Cells(kTiny).cells[0];
  cell.scan += "0";
  EXPECT_TRUE(changed());
}

TEST_F(SweepPlanTest, RefusesWhatCannotBeAndSaysWhatWasMeant) {
  EXPECT_THAT(Refusal("objects = [\"kage\"]\n"), HasSubstr("did you mean cage?"));
  EXPECT_THAT(Refusal("families = [\"tre\"]\n"), HasSubstr("did you mean tree?"));
  EXPECT_THAT(Refusal("object = [\"cage\"]\n"), HasSubstr("names no scans"));
  EXPECT_THAT(Refusal("objects = [\"cage\"]\nseed = 3\n"), HasSubstr("did you mean seeds?"));
  EXPECT_THAT(Refusal("objects = [\"cage\"]\nseeds = 100\n"), HasSubstr("1 to 99"));
  EXPECT_THAT(Refusal("objects = [\"cage\"]\n[grid]\nbundle.min_frame = [1]\n"),
              HasSubstr("bundle.min_frames"));
  EXPECT_THAT(Refusal("objects = [\"cage\"]\n[grid]\nbundle.min_frames = [0]\n"),
              HasSubstr("range"));
  EXPECT_THAT(Refusal("objects = [\"cage\"]\n[sample]\npoints = 3\n"), HasSubstr("ranges"));
  EXPECT_THAT(Refusal("objects = [\"cage\"\n"), HasSubstr("not valid TOML"));
}

TEST_F(SweepPlanTest, SettingsAreNotComparedOnWhatJudgesThem) {
  const std::string grid = "[grid]\nbundle.min_frames = [1]\n";
  for (const char* split : {"validation", "test"}) {
    const std::string scans = "objects = [\"cage\"]\nsplit = \"" + std::string(split) + "\"\n";
    EXPECT_THAT(Refusal(scans + grid), HasSubstr(split));
    EXPECT_NO_THROW(Cells(scans));  // measures the profile as it is
  }
}

TEST_F(SweepPlanTest, ParamsGiveTheSameCellAgain) {
  const SweepPlan plan =
      Plan(std::string(kTiny) +
               "[grid]\nbundle.min_frames = [3]\nridge_projection.kernel_sigma = [0.003]\n",
           "sweep");
  for (const SweepCell& cell : plan.cells) {
    const fs::path path = plan.folder / "cells" / cell.key / "params.toml";
    EXPECT_EQ(ParamsToml(ReadParams(path)), ParamsToml(cell));
  }
  const fs::path path = plan.folder / "cells" / plan.cells[1].key / "params.toml";
  SweepCell other = plan.cells[1];
  other.settings[0] = "bundle.min_frames=5";  // and not the key
  std::ofstream(path) << ParamsToml(other);
  EXPECT_THROW(ReadParams(path), Error);
  EXPECT_EQ(ReadSweepPlan(plan.folder).cells.size(), plan.cells.size());
  EXPECT_THROW(ReadSweepPlan(folder_), Error);
}

TEST_F(SweepPlanTest, AFinishedCellIsNeverMeasuredAgain) {
  const SweepPlan plan = Plan(kTiny, "first");
  EXPECT_EQ(Measure(plan, plan.cells[0]).outcome, "done");
  const fs::path file = ResultFolder(plan.folder, plan.cells[0]) / "run.json";
  const auto written = fs::last_write_time(file);
  EXPECT_EQ(Measure(plan, plan.cells[0]).outcome, "done");
  EXPECT_EQ(fs::last_write_time(file), written);

  // Another sweep with the first as its cache, which cannot be written: what is there counts, what
  // is new goes into its own folder.
  const SweepPlan second =
      Plan(std::string(kTiny) + "[grid]\nbundle.min_frames = [1]\n", "second", {plan.folder});
  EXPECT_EQ(FinishedResult(second, second.cells[0]), ResultFolder(plan.folder, plan.cells[0]));
  EXPECT_EQ(FinishedScan(second, second.cells[1].scan).parent_path(), plan.folder / "scans");
  EXPECT_TRUE(FinishedResult(second, second.cells[1]).empty());
  const SweepStatus status = StatusOf(second, ReadCellResults(second));
  EXPECT_EQ(status.done, 1);
  EXPECT_EQ(status.missing, 1);
  EXPECT_EQ(status.missing_scans, 0);
}

TEST_F(SweepPlanTest, AFailureIsAResult) {
  const SweepPlan plan = Plan(kTiny, "sweep");
  const SweepCell& cell = plan.cells[0];
  const fs::path scan = plan.folder / "scans" / cell.scan;
  fs::create_directories(scan / "truth");
  std::ofstream(scan / "truth" / "settings.json") << "{}";  // a scan that nobody can read
  EXPECT_EQ(MeasureCell(cell, scan, ResultFolder(plan.folder, cell), NoProgress).outcome, "failed");
  const SweepStatus status = StatusOf(plan, ReadCellResults(plan));
  EXPECT_EQ(status.failed, 1);
  EXPECT_THAT(status.failures, testing::ElementsAre(HasSubstr(cell.key)));
  EXPECT_THROW(MeasureCell(cell, folder_, folder_ / "result", NoProgress), Error);
}

TEST_F(SweepPlanTest, AnInterruptedOrHalfWrittenCellLeavesNothing) {
  const SweepPlan plan = Plan(kTiny, "sweep");
  const SweepCell& cell = plan.cells[0];
  const auto interrupt = [](std::string_view, int64_t, int64_t) {
    throw Error(ErrorKind::kInterrupted, "stop");
  };
  const fs::path scan = plan.folder / "scans" / cell.scan;
  MakeSweepScan(plan.folder / "scans" / (cell.scan + ".json"), scan, NoProgress);
  EXPECT_THROW(MeasureCell(cell, scan, ResultFolder(plan.folder, cell), interrupt), Error);
  EXPECT_TRUE(FinishedResult(plan, cell).empty());
  EXPECT_FALSE(fs::exists(ResultFolder(plan.folder, cell)));
  // What a killed process or a full disk may have left of a folder without run.json.
  fs::create_directories(ResultFolder(plan.folder, cell));
  std::ofstream(ResultFolder(plan.folder, cell) / "skeleton.json") << "{";
  EXPECT_TRUE(FinishedResult(plan, cell).empty());
  EXPECT_EQ(Measure(plan, cell).outcome, "done");
}

}  // namespace
}  // namespace curvefusion
