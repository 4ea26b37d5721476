// What no command may do: write into what it reads, or over what is not its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kSkeleton =
    R"({"format": "curvefusion-skeleton", "version": 1, "units": "m",
        "nodes": [{"position": [0, 0, 0]}, {"position": [0.1, 0, 0]}],
        "edges": [{"nodes": [0, 1], "points": [[0, 0, 0], [0.1, 0, 0]], "radius": 0.003}]})";

class OutputGuard : public CommandLine {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }

  // All files below a folder with their content.
  std::map<std::string, std::string> Content(const std::string& folder) const {
    std::map<std::string, std::string> content;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      const std::string name = fs::relative(entry.path(), folder_);
      if (entry.is_regular_file()) content[name] = Text(name);
    }
    return content;
  }

  // A command that must be refused as wrong usage, without a change of any file in folder `in`.
  void ExpectRefused(const std::string& arguments, const std::string& message) const {
    const auto before = Content("in");
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments << ": " << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(message)) << arguments;
    EXPECT_EQ(Content("in"), before) << arguments;
  }
};

TEST_F(OutputGuard, NoCommandWritesOverAFileThatItReads) {
  Write("in/a.json", kSkeleton);
  Write("in/c.xyz", "0 0 0\n0.1 0 0\n0.2 0 0\n");
  fs::create_symlink("a.json", folder_ / "in/link.json");
  fs::create_hard_link(folder_ / "in/a.json", folder_ / "in/hard.json");
  const std::string refusal = "is read by this command and would be overwritten";
  ASSERT_EQ(Run("graph in/a.json --convert in/l.ply").exit_code, 0);
  ExpectRefused("mesh in/l.ply -o in/l.ply", refusal);
  ExpectRefused("contract in/c.xyz -o in/../in/c.xyz", refusal);
  ExpectRefused("graph in/a.json --convert in/a.json", refusal);
  ExpectRefused("graph in/a.json --smooth 60 -o in/a.json", refusal);
  ExpectRefused("graph in/a.json --smooth 60 -o in/link.json", refusal);
  ExpectRefused("graph in/link.json --smooth 60 -o in/hard.json", refusal);
  ExpectRefused("graph in/a.json --smooth 60 -o in/b.json --convert in/b.json", refusal);
  ExpectRefused("evaluate in/a.json --truth in/link.json --json in/a.json", refusal);
  ExpectRefused("evaluate in/a.json --truth in/link.json --csv in/hard.json", refusal);
}

TEST_F(OutputGuard, ScoresMayLieInTheResultButNotReplaceIt) {
  Write("in/skeleton.json", kSkeleton);
  Write("in/report.json", "{}");
  Write("truth.json", kSkeleton);
  ExpectRefused("evaluate in --truth truth.json --json in/report.json", "is read by");
  EXPECT_EQ(Run("evaluate in --truth truth.json --json in/scores.json").exit_code, 0);
}

TEST_F(OutputGuard, RepairsAreNotWrittenIntoTheScan) {
  ASSERT_EQ(SimulateCube(2).exit_code, 0);
  const Outcome outcome = Run("check scan --repair scan/repaired");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "scan/repaired"));
}

TEST_F(OutputGuard, ReconstructWritesNothingIntoItsScan) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  fs::rename(folder_ / "scan", folder_ / "in");
  fs::create_symlink("in", folder_ / "link");
  const std::string refusal = "lies in the input";
  ExpectRefused("reconstruct in -o in --force", refusal);
  ExpectRefused("reconstruct in -o in/new/result", refusal);
  ExpectRefused("reconstruct link -o in", refusal);
  ExpectRefused("reconstruct in -o link", refusal);
  ExpectRefused("reconstruct in -o out --save-stages in/stages", refusal);
  ExpectRefused("reconstruct in -o out --save-volume in/volume.ply", refusal);
  ExpectRefused("reconstruct in -o .", "and no result of an earlier run");
  Write("in2/config.toml", "profile = \"best\"\n");
  ExpectRefused("reconstruct in -o in2 --config in2/config.toml", "is read by");
  EXPECT_FALSE(fs::exists(folder_ / "out"));
}

TEST_F(OutputGuard, SimulateReplacesNothing) {
  Write("in/notes.txt", "mine");
  Write("in/a.json", kSkeleton);
  ExpectRefused("simulate cage --frames 1 -o in", "is there already");
  ExpectRefused("simulate in/a.json --frames 1 -o in/a.json", "is there already");
}

TEST_F(OutputGuard, AFolderThatHoldsOtherThingsNeedsForceAndKeepsThem) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  Write("in/notes.txt", "mine");
  const std::string nothing = " --quiet --set ridge_skeleton.min_component=10";
  ExpectRefused("reconstruct scan -o in" + nothing, "holds notes.txt");
  EXPECT_EQ(Run("reconstruct scan -o in --force" + nothing).exit_code, 4);
  EXPECT_EQ(Text("in/notes.txt"), "mine");
  EXPECT_EQ(Run("reconstruct scan -o in" + nothing).exit_code, 4);  // ours by its report now
  Write("in3/trajectory.txt", "of another scan");
  EXPECT_EQ(Run("reconstruct scan -o in3 --force" + nothing).exit_code, 2);
  EXPECT_EQ(Text("in3/trajectory.txt"), "of another scan");
}

TEST_F(OutputGuard, NothingThinKeepsTheEarlierResultWhole) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  for (const char* name : {"skeleton.json", "mesh.ply", "config.toml"}) {
    Write(std::string("out/") + name, "earlier");
  }
  const std::string report = R"({"format": "curvefusion-report"})";
  Write("out/report.json", report);
  const Outcome outcome = Run("reconstruct scan -o out --set ridge_skeleton.min_component=10");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.output, HasSubstr("the result of an earlier run stays in out"));
  EXPECT_EQ(Text("out/skeleton.json"), "earlier");
  EXPECT_EQ(Text("out/config.toml"), "earlier");
  EXPECT_EQ(Text("out/report.json"), report);
  EXPECT_THAT(Text("out/report_nothing_found.json"), HasSubstr("curvefusion-report"));
  EXPECT_THAT(Text("out/config_nothing_found.toml"), HasSubstr("min_component = 10"));
  // The page is that of this run and leads to its own files.
  EXPECT_THAT(Text("out/report_nothing_found.html"),
              HasSubstr(R"("files":["report_nothing_found.json","config_nothing_found.toml"])"));
  EXPECT_EQ(CountFiles("out", ""), 7);
}

}  // namespace
}  // namespace curvefusion
