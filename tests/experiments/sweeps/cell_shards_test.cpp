#include "experiments/sweeps/cell_shards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/studies/run_files.h"
#include "experiments/sweeps/cell_measurement.h"
#include "experiments/sweeps/sweep_plan.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A scan of nine frames, which are three bundles.
constexpr const char* kStudy =
    "objects = [\"valence6\"]\nseeds = 1\nframes = 9\nsensors = [\"ideal\"]\nposes = [\"true\"]\n"
    "[[points]]\nbundle.frames = 3\n";

class CellInShards : public testing::Test {
 protected:
  void SetUp() override {
    plan_ = Plan("sweep", "shards = 2\n");
    cell_ = plan_.cells.at(1);  // the first is the default
    scan_ = folder_ / "sweep" / "scans" / cell_.scan;
    MakeSweepScan(scan_.string() + ".json", scan_, NoProgress);
  }
  SweepPlan Plan(const std::string& name, const std::string& more) const {
    std::ofstream(folder_ / "study.toml") << more << kStudy;
    return WriteSweepPlan(folder_ / "study.toml", folder_ / name, {}, "curvefusion");
  }

  fs::path Result(const char* name) const {
    fs::create_directories(folder_ / name);
    return folder_ / name / "result";
  }

  std::string Shard(const fs::path& result, ShardNumber shard) const {
    return MeasureCellShard(cell_, scan_, result, shard, NoProgress);
  }

  const TemporaryFolder folder_{"cell_shards"};
  SweepPlan plan_;
  SweepCell cell_;
  fs::path scan_;
};

TEST_F(CellInShards, HasTheResultOfAWholeOne) {
  EXPECT_EQ(plan_.shards, 2);
  EXPECT_EQ(ReadSweepPlan(plan_.folder).shards, 2);
  EXPECT_EQ(Plan("whole", "").cells.at(1).key, cell_.key) << "shards change no key";
  EXPECT_EQ(Plan("whole", "").shards, 1);
  EXPECT_EQ(MeasureCell(cell_, scan_, Result("whole"), NoProgress).outcome, "done");

  const fs::path result = Result("split");
  EXPECT_EQ(Shard(result, {2, 2}), "");
  const fs::path file = CellShards(result) / ShardName({2, 2});
  const auto written = fs::last_write_time(file);
  EXPECT_EQ(Shard(result, {2, 2}), "");
  EXPECT_EQ(fs::last_write_time(file), written) << "a finished shard is made again";
  std::ofstream(file, std::ios::app) << "more";
  EXPECT_EQ(Shard(result, {2, 2}), "");
  EXPECT_NE(fs::last_write_time(file), written) << "a damaged shard stays";
  EXPECT_EQ(Shard(result, {1, 2}), "");
  EXPECT_EQ(MeasureCell(cell_, scan_, result, NoProgress, 2).outcome, "done");
  EXPECT_FALSE(fs::exists(CellShards(result)));
  for (const char* name : {"skeleton.json", "evaluation.json", "config.toml"}) {
    EXPECT_EQ(FileText(result / name), FileText(Result("whole") / name)) << name;
  }
  EXPECT_EQ(Shard(result, {1, 2}), "");
  EXPECT_FALSE(fs::exists(CellShards(result))) << "a shard of a finished cell is made";
}

TEST_F(CellInShards, CostsWhatAllOfItsJobsCost) {
  const fs::path result = Result("split");
  for (const int number : {1, 2}) {
    EXPECT_EQ(Shard(result, {number, 2}), "");
    std::ofstream((CellShards(result) / ShardName({number, 2})).replace_extension(".json"))
        << R"({"seconds": )" << 1000 * number << R"(, "cpu_seconds": 5000, "peak_memory": 5e12})";
  }
  MeasureCell(cell_, scan_, result, NoProgress, 2);
  const Figures figures = ReadRunFile(result)->run.figures;
  EXPECT_NEAR(figures.at("seconds"), 2000, 500) << "of the longest shard";
  EXPECT_NEAR(figures.at("cpu_seconds"), 10000, 500) << "of all";
  EXPECT_EQ(figures.at("peak_memory_mb"), 5e6);
}

TEST_F(CellInShards, IsMeasuredWholeWhereItCannotBeSplit) {
  const fs::path result = Result("split");
  EXPECT_THAT(Shard(result, {1, 4}), HasSubstr("N can be at most 3"));
  EXPECT_EQ(MeasureCell(cell_, scan_, result, NoProgress, 4).outcome, "done");
}

}  // namespace
}  // namespace curvefusion
