// Runs the program as a user does and looks at exit codes and files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct Outcome {
  int exit_code = 0;
  std::string output;  // both streams
};

class CommandLine : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs `curvefusion ARGUMENTS` inside folder_.
  Outcome Run(const std::string& arguments) const {
    return RunShell("'" CURVEFUSION_PROGRAM "' " + arguments + " >output.txt 2>&1");
  }

  // The same, with SIGINT sent as soon as the folder `awaited` is there (or after 20 s).
  Outcome RunAndInterrupt(const std::string& arguments, const std::string& awaited) const {
    return RunShell("'" CURVEFUSION_PROGRAM "' " + arguments +
                    " >output.txt 2>&1 & i=0; while [ ! -d " + awaited +
                    " ] && [ $i -lt 2000 ]; do i=$((i+1)); sleep 0.01; done; "
                    "kill -INT $!; wait $!");
  }

  Outcome RunShell(const std::string& command) const {
    const int status = std::system(("cd '" + folder_.string() + "' || exit; " + command).c_str());
    std::stringstream output;
    output << std::ifstream(folder_ / "output.txt").rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output.str()};
  }

  // Files below a folder whose name ends so.
  int CountFiles(const std::string& folder, const std::string& name_part) const {
    int count = 0;
    if (!fs::exists(folder_ / folder)) return 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / folder)) {
      count += entry.path().filename().string().find(name_part) != std::string::npos ? 1 : 0;
    }
    return count;
  }

  const fs::path folder_ =
      fs::temp_directory_path() / (std::string("curvefusion_command_line_") +
                                   testing::UnitTest::GetInstance()->current_test_info()->name() +
                                   "_" + std::to_string(getpid()));
};

TEST_F(CommandLine, HelpAndVersionAreDone) {
  EXPECT_EQ(Run("--help").exit_code, 0);
  EXPECT_EQ(Run("--version").exit_code, 0);
  for (const char* command : {"reconstruct", "check", "contract", "mesh", "graph", "config"}) {
    const Outcome help = Run(std::string(command) + " --help");
    EXPECT_EQ(help.exit_code, 0) << command;
    EXPECT_THAT(help.output, HasSubstr(std::string("Example:\n  curvefusion ") + command));
  }
}

TEST_F(CommandLine, WrongUsageIsTwo) {
  EXPECT_EQ(Run("").exit_code, 2);
  EXPECT_EQ(Run("reconstruct").exit_code, 2);
  EXPECT_EQ(Run("reconstruct scan -o out --no-such-option").exit_code, 2);
  EXPECT_EQ(Run("config --set volume.voxel_size=99").exit_code, 2);
  EXPECT_EQ(Run("config --profile papper").exit_code, 2);
  const Outcome mistyped = Run("reconstrut scan -o out");
  EXPECT_EQ(mistyped.exit_code, 2);
  EXPECT_THAT(mistyped.output, HasSubstr("did you mean reconstruct?"));
}

TEST_F(CommandLine, BadInputIsThree) {
  fs::create_directories(folder_ / "empty");
  EXPECT_EQ(Run("check empty").exit_code, 3);
  EXPECT_EQ(Run("reconstruct empty -o out").exit_code, 3);
  EXPECT_EQ(CountFiles("out", "."), 0);
  std::ofstream(folder_ / "bad.json") << "{";
  EXPECT_EQ(Run("graph bad.json").exit_code, 3);
  EXPECT_EQ(Run("mesh bad.json -o a.ply").exit_code, 3);
  EXPECT_EQ(Run("contract none.ply -o a.json").exit_code, 3);
}

TEST_F(CommandLine, NothingThinIsFourAndLeavesNoEarlierResult) {
  ASSERT_EQ(Run("demo-scan -o scan --frames 3 --quiet").exit_code, 0);
  fs::create_directories(folder_ / "out");
  std::ofstream(folder_ / "out/skeleton.json") << "of an earlier run";
  // The object has less than 10 m of curve.
  const Outcome outcome = Run("reconstruct scan -o out --set ridge_skeleton.min_component=10");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.output, HasSubstr("nothing thin"));
  EXPECT_TRUE(fs::exists(folder_ / "out/report.json"));
  EXPECT_TRUE(fs::exists(folder_ / "out/config.toml"));
  EXPECT_EQ(CountFiles("out", "skeleton"), 0);
}

TEST_F(CommandLine, TheDemoGivesAllFilesAndItsTwelveJunctions) {
  ASSERT_EQ(Run("demo-scan -o scan --quiet").exit_code, 0);
  const Outcome outcome = Run("reconstruct scan -o out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, HasSubstr("12 junctions, 0 free ends"));
  for (const char* name : {"skeleton.json", "trajectory.txt", "mesh.ply", "preview.png",
                           "report.json", "config.toml"}) {
    EXPECT_EQ(CountFiles("out", name), 1) << name;
  }
  EXPECT_EQ(CountFiles("out", ""), 6);  // and nothing half-written beside them
}

TEST_F(CommandLine, AFolderThatCannotBeWrittenIsFive) {
  ASSERT_EQ(Run("demo-scan -o scan --frames 1 --quiet").exit_code, 0);
  std::ofstream(folder_ / "file") << "not a folder";
  const Outcome outcome = Run("reconstruct scan -o file/out");
  EXPECT_EQ(outcome.exit_code, 5);
  EXPECT_THAT(outcome.output, HasSubstr("file/out"));
}

TEST_F(CommandLine, AnInterruptedRunIs130AndLeavesNoResult) {
  ASSERT_EQ(Run("demo-scan -o scan --frames 25 --quiet").exit_code, 0);
  // The folder for stages is made right before the first frame is read.
  const Outcome outcome = RunAndInterrupt("reconstruct scan -o out --save-stages stages", "stages");
  EXPECT_EQ(outcome.exit_code, 130);
  EXPECT_THAT(outcome.output, HasSubstr("interrupted"));
  EXPECT_EQ(CountFiles("out", "."), 0);
}

TEST_F(CommandLine, TheConfigItPrintsIsTheConfigItReads) {
  ASSERT_EQ(Run("config --profile paper --set volume.voxel_size=0.006").exit_code, 0);
  fs::rename(folder_ / "output.txt", folder_ / "a.toml");
  const Outcome again = Run("config --config a.toml");
  std::stringstream first;
  first << std::ifstream(folder_ / "a.toml").rdbuf();
  EXPECT_EQ(again.output, first.str());
  EXPECT_THAT(again.output, HasSubstr("voxel_size = 0.006"));
}

TEST_F(CommandLine, QuietPrintsNothing) {
  EXPECT_EQ(Run("demo-scan -o scan --frames 1 --quiet").output, "");
}

}  // namespace
