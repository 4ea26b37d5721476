// Runs `curvefusion evaluate` and `curvefusion simulate` as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Evaluate : public CommandLine {};

TEST_F(Evaluate, ASimulatedTruthIsPerfect) {
  ASSERT_EQ(Run("simulate cat -o scan --sensor ideal --frames 1 --quiet").exit_code, 0);
  ASSERT_EQ(Run("mesh scan/truth/skeleton.json -o tubes.ply --quiet").exit_code, 0);
  const Outcome outcome =
      Run("evaluate scan/truth --truth scan/truth --mesh tubes.ply --json a.json --csv all.csv");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("aligned"));
  EXPECT_THAT(outcome.output, HasSubstr("22 of 22 (22)"));
  const nlohmann::json json = nlohmann::json::parse(Text("a.json"));
  EXPECT_EQ(json["aligned"]["curves"]["1mm"]["f"], 1.0);
  EXPECT_EQ(json["aligned"]["surface"]["1mm"]["f"], 1.0);
  EXPECT_EQ(json["mesh"]["boundary_edges"], 0);
  EXPECT_EQ(Run("evaluate scan/truth/skeleton.json --truth scan/truth/curves.json --csv all.csv "
                "--quiet")
                .output,
            "");
  const std::string csv = Text("all.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

// A scan of a room without wires.
TEST_F(Evaluate, AnEmptyTruthAndAnEmptyResult) {
  ASSERT_EQ(Run("simulate cat -o scan --sensor ideal --frames 1 --quiet").exit_code, 0);
  std::ofstream(folder_ / "none.json") << "[]";
  const Outcome all_false = Run("evaluate scan/truth --truth none.json --json a.json");
  EXPECT_EQ(all_false.exit_code, 0) << all_false.output;
  const nlohmann::json json = nlohmann::json::parse(Text("a.json"));
  EXPECT_EQ(json["true_length"], 0);
  EXPECT_NEAR(json["raw"]["curves"]["false_length"], json["length"], 1e-9);  // rounding
  EXPECT_TRUE(json["raw"]["curves"]["10mm"]["recall"].is_null());
  std::ofstream(folder_ / "nothing.json")
      << R"({"format":"curvefusion-skeleton","version":1,"units":"m","nodes":[],"edges":[]})";
  for (const char* truth : {"none.json", "scan/truth"}) {
    const Outcome empty = Run(std::string("evaluate nothing.json --truth ") + truth);
    EXPECT_EQ(empty.exit_code, 0) << empty.output;
    EXPECT_THAT(empty.output, HasSubstr("main piece"));
  }
}

TEST_F(Evaluate, ABareMeshNeedsNoSkeleton) {
  ASSERT_EQ(Run("simulate cat -o scan --sensor ideal --frames 1 --quiet").exit_code, 0);
  ASSERT_EQ(Run("mesh scan/truth/skeleton.json -o tubes.ply --quiet").exit_code, 0);
  const Outcome outcome =
      Run("evaluate --truth scan/truth --mesh tubes.ply --json a.json --csv all.csv");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("of the true tubes'"));
  const nlohmann::json json = nlohmann::json::parse(Text("a.json"));
  EXPECT_EQ(json["result"], "tubes.ply");
  EXPECT_EQ(json["aligned"]["surface"]["1mm"]["f"], 1.0);
  EXPECT_TRUE(json["aligned"]["curves"]["1mm"]["f"].is_null());
  EXPECT_TRUE(json["length"].is_null());
  EXPECT_NEAR(json["mesh"]["volume_ratio"], 1, 0.01);
  // Rows of results with and without curves share a table.
  EXPECT_EQ(Run("evaluate scan/truth --truth scan/truth --csv all.csv --quiet").exit_code, 0);
}

TEST_F(Evaluate, ExitCodes) {
  EXPECT_EQ(Run("evaluate").exit_code, 2);
  EXPECT_EQ(Run("evaluate out").exit_code, 2);
  EXPECT_EQ(Run("evaluate --truth scan/truth").exit_code, 2);
  EXPECT_EQ(Run("evaluate --help").exit_code, 0);
  ASSERT_EQ(Run("simulate cat -o scan --sensor ideal --frames 1 --quiet").exit_code, 0);
  const Outcome bad_truth = Run("evaluate scan/truth --truth nowhere --json a.json");
  EXPECT_EQ(bad_truth.exit_code, 3);
  EXPECT_THAT(bad_truth.output, HasSubstr("nowhere"));
  EXPECT_FALSE(fs::exists(folder_ / "a.json"));
  EXPECT_EQ(Run("evaluate scan/truth --truth scan").exit_code, 3);
  EXPECT_EQ(Run("evaluate nowhere --truth scan/truth").exit_code, 3);
  EXPECT_EQ(Run("evaluate scan/truth --truth scan/truth --mesh nowhere.ply").exit_code, 3);
}

TEST_F(Evaluate, SimulateRefusesWhatCannotBe) {
  EXPECT_EQ(Run("simulate --help").exit_code, 0);
  EXPECT_EQ(Run("simulate cat").exit_code, 2);
  EXPECT_EQ(Run("simulate cat -o scan --sensor lidar").exit_code, 2);
  EXPECT_EQ(Run("simulate cat -o scan --frames 0").exit_code, 2);
  EXPECT_EQ(Run("simulate random -o scan").exit_code, 2);
  EXPECT_EQ(Run("simulate random --family tre -o scan").exit_code, 2);
  EXPECT_EQ(Run("simulate cat --family tree -o scan").exit_code, 2);
  EXPECT_EQ(Run("simulate random --family tree --sensor ideal -o scan").exit_code, 2);
  const Outcome unknown = Run("simulate cag -o scan");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("did you mean 'cage'"));
  EXPECT_EQ(Run("simulate nowhere.json -o scan").exit_code, 3);
  EXPECT_EQ(Run("simulate cat -o scan --spacing 12").exit_code, 2);
  EXPECT_EQ(Run("simulate parallel_wires -o scan --spacing 5").exit_code, 2);
  const Outcome too_far = Run("simulate cat -o scan --sensor artec_spider --distance 0.5");
  EXPECT_EQ(too_far.exit_code, 2);
  EXPECT_THAT(too_far.output, HasSubstr("from 0.2 to 0.3 m"));
  EXPECT_FALSE(fs::exists(folder_ / "scan"));
}

TEST_F(Evaluate, SimulateDoesNotOverwrite) {
  fs::create_directories(folder_ / "scan");
  std::ofstream(folder_ / "scan" / "mine.txt") << "mine";
  const Outcome outcome = Run("simulate cat -o scan --sensor ideal --frames 1");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("name another folder"));
  EXPECT_EQ(Text("scan/mine.txt"), "mine");
}

TEST_F(Evaluate, SimulatesASkeletonOfTheUsers) {
  std::ofstream(folder_ / "mine.json")
      << R"({"format":"curvefusion-skeleton","version":1,"units":"m","nodes":[)"
      << R"({"position":[0,0,0]},{"position":[0.2,0,0]},{"position":[0,0,0.2]},)"
      << R"({"position":[-0.2,0,0]}],"edges":[)"
      << R"({"nodes":[0,1],"points":[[0,0,0],[0.2,0,0]],"radius":0.002},)"
      << R"({"nodes":[0,2],"points":[[0,0,0],[0,0,0.2]],"radius":0.003},)"
      << R"({"nodes":[0,3],"points":[[0,0,0],[-0.2,0,0]],"radius":0.002}]})";
  const Outcome outcome =
      Run("simulate mine.json -o scan --sensor ideal --poses true --frames 1 --distance 0.8");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json truth = nlohmann::json::parse(Text("scan/truth/skeleton.json"));
  EXPECT_EQ(truth["nodes"].size(), 4u);
  EXPECT_EQ(truth["edges"].size(), 3u);
}

TEST_F(Evaluate, SimulateRandomHasTheSameScanAgainFromItsDraw) {
  ASSERT_EQ(Run("simulate random --family knot --seed 2 --frames 1 -o scan --quiet").exit_code, 0);
  ASSERT_EQ(Run("simulate random --draw scan/truth/settings.json -o again --quiet").exit_code, 0);
  for (const char* file : {"truth/skeleton.json", "truth/settings.json", "trajectory.txt"}) {
    EXPECT_EQ(Text(std::string("scan/") + file), Text(std::string("again/") + file)) << file;
  }
}

}  // namespace
}  // namespace curvefusion
