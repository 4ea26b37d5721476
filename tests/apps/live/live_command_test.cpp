// Runs `curvefusion live` as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/command_line_fixture.h"
#include "tests/source_folder.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class LiveCommand : public CommandLine {
 protected:
  json State() const { return json::parse(Text("out/state.json")); }

  // What writes the scan as the folder `cam` with one pose a frame.
  static std::string WriteLikeACamera(const std::string& seconds) {
    return "python3 '" + (SourceFolder() / "tests/apps/live/write_like_a_camera.py").string() +
           "' scan cam " + seconds;
  }
};

// Whatever was dropped, the result is that of all frames.
TEST_F(LiveCommand, EndsWithTheBytesOfTheBatchAndTellsHowItWent) {
  ASSERT_EQ(SimulateCube(70).exit_code, 0);
  ASSERT_EQ(Run("reconstruct scan -o batch --quiet").exit_code, 0);
  const Outcome live = Run("live scan -o out --rate 20 --serve --port 0");
  ASSERT_EQ(live.exit_code, 0) << live.output;
  EXPECT_THAT(live.output, HasSubstr("Open http://127.0.0.1:"));
  EXPECT_THAT(live.output, HasSubstr("70 frames"));
  EXPECT_EQ(Text("out/skeleton.json"), Text("batch/skeleton.json"));
  EXPECT_EQ(Text("out/mesh.ply"), Text("batch/mesh.ply"));
  for (const char* name : {"report.html", "report.json", "snapshot.json"}) {
    EXPECT_TRUE(fs::exists(folder_ / "out" / name)) << name;
  }
  const json state = State();
  EXPECT_EQ(state["phase"], "done");
  EXPECT_EQ(state["frames"]["arrived"], 70);
  EXPECT_EQ(state["frames"]["used"].get<int>() + state["frames"]["dropped"].get<int>(), 70);
  ASSERT_GE(state["snapshot"]["number"], 1);
  EXPECT_EQ(state["curves"].size(), json::parse(Text("out/snapshot.json"))["edges"].size());
  EXPECT_EQ(Run("graph out/snapshot.json --validate").exit_code, 0);
  // Its own files do not keep the next run from the folder.
  EXPECT_EQ(Run("live scan -o out --rate 200 --quiet").exit_code, 0);
}

TEST_F(LiveCommand, AFirstInterruptEndsTheCaptureAndStillReconstructs) {
  ASSERT_EQ(SimulateCube(70).exit_code, 0);
  // At 4 frames a second most of the scan is still to come.
  const Outcome live = RunShell(
      "\"$CURVEFUSION\" live scan -o out --rate 4 >output.txt 2>&1 & "
      "sleep 6; kill -INT $!; wait $!");
  ASSERT_EQ(live.exit_code, 0) << live.output;
  const int arrived = State()["frames"]["arrived"];
  EXPECT_GT(arrived, 10);
  EXPECT_LT(arrived, 40);
  EXPECT_EQ(json::parse(Text("out/report.json"))["sequence"]["frames"], arrived);
}

TEST_F(LiveCommand, TwoInterruptsEndTheProgram) {
  ASSERT_EQ(SimulateCube(10).exit_code, 0);
  const Outcome live = RunShell(
      "\"$CURVEFUSION\" live scan -o out --rate 0.2 >output.txt 2>&1 & "
      "sleep 2; kill -INT $!; kill -INT $!; sleep 0.05; kill -INT $!; wait $!");
  EXPECT_NE(live.exit_code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out/skeleton.json"));
}

TEST_F(LiveCommand, FollowsAFolderThatGrows) {
  ASSERT_EQ(SimulateCube(40).exit_code, 0);
  const Outcome live = RunShell(
      "mkdir -p cam/color cam/depth cam/pose; "
      "\"$CURVEFUSION\" live cam -o out --follow --idle 60 --quiet >output.txt 2>&1 & " +
      WriteLikeACamera("0.02") + "; wait $!");
  ASSERT_EQ(live.exit_code, 0) << live.output;
  EXPECT_EQ(State()["frames"]["arrived"], 40);
  ASSERT_EQ(Run("reconstruct cam -o batch --quiet").exit_code, 0);
  EXPECT_EQ(Text("out/skeleton.json"), Text("batch/skeleton.json"));
}

class StreamedLiveCommand : public LiveCommand {
 protected:
  // A folder `cam` with one pose a frame.
  void RecordCube(int frames) {
    ASSERT_EQ(SimulateCube(frames).exit_code, 0);
    const Outcome written = RunShell("mkdir -p cam/color cam/depth cam/pose && " +
                                     WriteLikeACamera("0") + " && rm cam/end");
    ASSERT_EQ(written.exit_code, 0) << written.output;
  }

  Outcome Send(const std::string& archive, const std::string& output) {
    return RunShell(archive + " | \"$CURVEFUSION\" live - -o " + output +
                    " --quiet >output.txt 2>&1");
  }
};

TEST_F(StreamedLiveCommand, TakesFramesFromStandardInput) {
  RecordCube(40);
  const Outcome live = Send("tar -C cam -c --sort=name intrinsics.json pose color depth", "out");
  ASSERT_EQ(live.exit_code, 0) << live.output;
  EXPECT_EQ(State()["frames"]["arrived"], 40);
  ASSERT_EQ(Run("reconstruct cam -o batch --quiet").exit_code, 0);
  EXPECT_EQ(Text("out/skeleton.json"), Text("batch/skeleton.json"));
  // The frames are kept, and no other run is written among them.
  EXPECT_EQ(Send("tar -C cam -c .", "out").exit_code, 2);
}

TEST_F(StreamedLiveCommand, StreamsThatAreNoneAreTold) {
  RecordCube(3);
  const Outcome cut = Send("tar -C cam -c . | head -c 100000", "cut");
  EXPECT_EQ(cut.exit_code, 3);
  EXPECT_THAT(cut.output, AllOf(HasSubstr("Truncated"), HasSubstr("cut/scan")));
  EXPECT_EQ(Send("echo no archive at all", "text").exit_code, 3);
  EXPECT_EQ(Send("true", "empty").exit_code, 3);
  EXPECT_EQ(Send("tar -c cam --transform 's,^cam,../elsewhere,' -P", "outside").exit_code, 3);
  EXPECT_FALSE(fs::exists(folder_ / "outside/elsewhere"));
  // Nothing that a camera would send.
  const Outcome other = Send("tar -C scan -c rgb", "other");
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_THAT(other.output, HasSubstr("no frame has come"));
  EXPECT_EQ(
      RunShell("\"$CURVEFUSION\" live - -o rate --rate 3 </dev/null >output.txt 2>&1").exit_code,
      2);
}

TEST_F(LiveCommand, WhatCannotBeIsToldBeforeAnyFrame) {
  ASSERT_EQ(SimulateCube(2).exit_code, 0);
  EXPECT_EQ(Run("live scan -o out --profile paper").exit_code, 2);
  EXPECT_EQ(Run("live scan -o out --set depth.use=none").exit_code, 2);
  EXPECT_EQ(Run("live scan -o out --rate 0").exit_code, 2);
  EXPECT_EQ(Run("live scan -o out --follow --rate 5").exit_code, 2);
  EXPECT_EQ(Run("live scan -o out --idle 5").exit_code, 2);
  EXPECT_EQ(Run("live scan -o scan/out").exit_code, 2);
  EXPECT_EQ(Run("live nowhere -o out --follow").exit_code, 3);
  EXPECT_EQ(Run("live nowhere -o out").exit_code, 3);
}

}  // namespace
}  // namespace curvefusion
