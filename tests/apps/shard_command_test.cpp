// One reconstruction by several runs of the program: the result must be that of one.
#include <gmock/gmock.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// Bundles of 3 frames of a wire cube: four of them.
constexpr const char* kBundles = " --quiet --set bundle.frames=3 ";

class ShardCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    ASSERT_EQ(SimulateCube(12).exit_code, 0);
  }

  Outcome Shard(const std::string& shard, const std::string& more = "") const {
    return Run("reconstruct scan -o shards --shard " + shard + kBundles + more);
  }

  Outcome Merge(const std::string& more = "") const {
    return Run("reconstruct scan -o merged --merge shards" + std::string(kBundles) + more);
  }

  // All files of a result but the reports, in which there are seconds.
  std::map<std::string, std::string> Files(const std::string& folder) const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      const std::string name = fs::relative(entry.path(), folder_ / folder).string();
      if (entry.is_regular_file() && name.find("report.") != 0) {
        files[name] = Text(folder + "/" + name);
      }
    }
    return files;
  }

  // report.json without what depends on the machine.
  nlohmann::json Report(const std::string& folder) const {
    nlohmann::json report = nlohmann::json::parse(Text(folder + "/report.json"));
    for (const char* key : {"seconds", "seconds_per_30_frames", "peak_memory_bytes"}) {
      report.erase(key);
    }
    for (nlohmann::json& stage : report["stages"]) {
      stage.erase("seconds");
      stage.erase("peak_memory_bytes");
    }
    for (const char* mesh : {"mesh", "hybrid"}) {
      if (report[mesh].is_object()) report[mesh].erase("seconds");
    }
    return report;
  }

  void ExpectTheSameResult(const std::string& more) const {
    const std::map<std::string, std::string> whole = Files("whole"), merged = Files("merged");
    ASSERT_GT(whole.size(), 4u);
    for (const auto& [name, bytes] : whole) {
      ASSERT_TRUE(merged.contains(name)) << name << more;
      EXPECT_TRUE(merged.at(name) == bytes) << name << " has other bytes" << more;
    }
    EXPECT_EQ(merged.size(), whole.size()) << more;
    EXPECT_EQ(Report("merged"), Report("whole")) << more;
  }
};

TEST_F(ShardCommand, MakesTheSameFilesAsOneRun) {
  ASSERT_EQ(Run(std::string("reconstruct scan -o whole") + kBundles).exit_code, 0);
  for (const int count : {2, 3, 4}) {
    fs::remove_all(folder_ / "shards");
    fs::remove_all(folder_ / "merged");
    for (int number = count; number > 0; --number) {
      const Outcome outcome = Shard(std::to_string(number) + "/" + std::to_string(count),
                                    number == 2 ? "--threads 1" : "--threads 2");
      ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    }
    EXPECT_EQ(CountFiles("shards", ""), count) << "one file each";
    const Outcome outcome = Merge();
    ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
    ExpectTheSameResult(" of " + std::to_string(count));
  }
}

TEST_F(ShardCommand, TheMergeKeepsStagesVolumeAndSolidPartsAsWell) {
  const auto extras = [](const std::string& folder) {
    return " --hybrid --save-stages " + folder + "/stages --save-volume " + folder + "/volume.ply";
  };
  ASSERT_EQ(Run("reconstruct scan -o whole" + std::string(kBundles) + extras("whole")).exit_code,
            0);
  ASSERT_EQ(Shard("1/2").exit_code, 0);
  ASSERT_EQ(Shard("2/2").exit_code, 0);
  const Outcome outcome = Merge(extras("merged"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_GT(CountFiles("merged/stages", "_difference_set.ply"), 3);
  EXPECT_EQ(CountFiles("merged", "volume.ply"), 1);
  EXPECT_EQ(CountFiles("merged", "hybrid.stl"), 1);
  ExpectTheSameResult("");
}

TEST_F(ShardCommand, ShardsMayLieInTheResultsFolder) {
  for (const char* shard : {"1/2", "2/2"}) {
    ASSERT_EQ(Run("reconstruct scan -o merged --shard " + std::string(shard) + kBundles).exit_code,
              0);
  }
  const Outcome outcome =
      Run("reconstruct scan -o merged --quiet --set bundle.frames=3 --merge "
          "merged/shard_2_of_2.cfshard merged/shard_1_of_2.cfshard");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(CountFiles("merged", "skeleton.json"), 1);
}

TEST_F(ShardCommand, AScanWithoutPosesIsTrackedByEveryRun) {
  const auto run = [&](const std::string& rest) {
    return Run("reconstruct scan --track" + std::string(kBundles) + rest);
  };
  ASSERT_EQ(run("-o whole").exit_code, 0) << Text("output.txt");
  ASSERT_EQ(run("-o shards --shard 1/2").exit_code, 0);
  ASSERT_EQ(run("-o shards --shard 2/2").exit_code, 0);
  EXPECT_THAT(Merge().output, HasSubstr("--track = given, here it is not given"));
  ASSERT_EQ(run("-o merged --merge shards").exit_code, 0) << Text("output.txt");
  ExpectTheSameResult("");
}

TEST_F(ShardCommand, AFinishedShardIsNotMadeAgain) {
  ASSERT_EQ(Shard("1/2").exit_code, 0);
  const fs::path file = folder_ / "shards" / "shard_1_of_2.cfshard";
  const auto written = fs::last_write_time(file);
  const std::string again = "reconstruct scan -o shards --shard 1/2 --set bundle.frames=3";
  const Outcome outcome = Run(again);
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("shard_1_of_2.cfshard is finished; --force"));
  EXPECT_EQ(fs::last_write_time(file), written);
  EXPECT_EQ(Run(again + " --force --quiet").exit_code, 0);
  EXPECT_NE(fs::last_write_time(file), written);

  const Outcome other = Shard("1/2", "--set volume.voxel_size=0.02");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.output, AllOf(HasSubstr("volume.voxel_size = 0.01, here it is 0.02"),
                                  HasSubstr("--force replaces it")));
  std::ofstream(file, std::ios::app) << "more";
  const Outcome damaged = Shard("1/2");
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.output, HasSubstr("--force replaces it"));
}

TEST_F(ShardCommand, WhatCannotBeIsRefusedBeforeWork) {
  for (const auto& [options, message] : std::map<std::string, std::string>{
           {"--shard 5/4", "write i/N"},
           {"--shard 0/4", "write i/N"},
           {"--shard 2", "write i/N"},
           {"--shard 1/5", "N can be at most 4"},
           {"--shard 1/2 --profile paper", "--profile best"},
           {"--merge scan --profile paper", "--profile best"},
           {"--shard 1/2 --depth none", "depth.use=none"},
           {"--merge scan --depth none", "depth.use=none"},
           {"--shard 1/2 --hybrid", "give --hybrid to the run that merges"},
           {"--shard 1/2 --save-stages stages", "give --save-stages to the run that merges"},
           {"--shard 1/2 --save-volume a.ply", "give --save-volume to the run that merges"},
           {"--merge scan --shard 1/2", "give --merge to the run that merges"}}) {
    const Outcome outcome = Run("reconstruct scan -o out " + options + kBundles);
    EXPECT_EQ(outcome.exit_code, 2) << options;
    EXPECT_THAT(outcome.output, HasSubstr(message)) << options;
    EXPECT_EQ(CountFiles("out", ""), 0) << options;
  }
  EXPECT_EQ(Run("reconstruct scan -o scan/shards --shard 1/2" + std::string(kBundles)).exit_code,
            2);
  EXPECT_EQ(Run("reconstruct scan -o out --merge scan").exit_code, 3);
}

TEST_F(ShardCommand, ShardsThatDoNotBelongTogetherAreRefused) {
  const auto refused = [&](const std::string& options, const std::string& message) {
    const Outcome outcome = Merge(options);
    EXPECT_EQ(outcome.exit_code, 3) << message;
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_FALSE(fs::exists(folder_ / "merged"));
  };
  ASSERT_EQ(Shard("1/2").exit_code, 0);
  refused("", "1 of 2 shards are missing: 2/2");
  ASSERT_EQ(Shard("2/2").exit_code, 0);
  refused("--set volume.voxel_size=0.02", "volume.voxel_size = 0.01, here it is 0.02");
  refused("--colour-camera given", "--colour-camera = auto, here it is given");
  fs::copy_file(folder_ / "shards/shard_2_of_2.cfshard", folder_ / "shards/more.cfshard");
  refused("", "are both shard 2 of 2");
  fs::remove(folder_ / "shards/more.cfshard");
  fs::rename(folder_ / "scan", folder_ / "first");
  ASSERT_EQ(SimulateCube(11).exit_code, 0);
  refused("", "was made of another scan: frames = 12, here it is 11");
}

}  // namespace
}  // namespace curvefusion
