#include "capture/growing_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "kernel/error.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

// A camera's folder: files come from a sequence that is complete elsewhere.
class GrowingFolderTest : public testing::Test {
 protected:
  void SetUp() override {
    WritePerFrameSequence(camera_.path());
    for (const char* name : {"color", "depth", "pose"}) fs::create_directory(folder() / name);
  }

  fs::path folder() const { return folder_.path(); }
  void Write(const std::string& file) {
    fs::copy_file(camera_.path() / file, folder() / file, fs::copy_options::overwrite_existing);
  }
  void WriteFrame(int number) {
    const std::string name = "00000" + std::to_string(number);
    Write("depth/" + name + ".png");
    Write("color/" + name + ".jpg");
    Write("pose/" + name + ".txt");
  }
  static std::vector<std::string> Names(const std::vector<SequenceFrame>& frames) {
    std::vector<std::string> names;
    for (const SequenceFrame& frame : frames) names.push_back(frame.name);
    return names;
  }

  TemporaryFolder camera_;
  TemporaryFolder folder_;
};

TEST_F(GrowingFolderTest, CamerasAreKnownOnceTheirFileIsThere) {
  const GrowingFolder growing(folder(), true);
  EXPECT_FALSE(growing.Cameras());
  Write("intrinsics.json");
  const std::optional<Sequence> cameras = growing.Cameras();
  ASSERT_TRUE(cameras);
  EXPECT_EQ(cameras->depth_camera.width, 32);
  EXPECT_EQ(cameras->depth_scale, 1000);
  EXPECT_TRUE(cameras->has_poses);
  WriteText(folder() / "intrinsics.json", R"({"width":32})");
  EXPECT_THROW(growing.Cameras(), Error);
}

TEST_F(GrowingFolderTest, CamerasThatAreBeingWrittenAreWaitedFor) {
  const GrowingFolder growing(folder(), true);
  const fs::path intrinsics = folder() / "intrinsics.json";
  for (const double share : {0.0, 0.5}) {
    Write("intrinsics.json");
    Truncate(intrinsics, share);
    EXPECT_FALSE(growing.Cameras()) << share;
  }
  fs::last_write_time(intrinsics, fs::file_time_type::clock::now() - std::chrono::seconds(3));
  EXPECT_THROW(growing.Cameras(), Error);
  Write("intrinsics.json");
  EXPECT_TRUE(growing.Cameras());
}

TEST_F(GrowingFolderTest, FramesComeOnceAndInOrder) {
  GrowingFolder growing(folder(), true);
  EXPECT_THAT(growing.NewFrames(), IsEmpty());
  WriteFrame(1);
  WriteFrame(0);
  const std::vector<SequenceFrame> frames = growing.NewFrames();
  EXPECT_THAT(Names(frames), ElementsAre("000000", "000001"));
  EXPECT_DOUBLE_EQ(frames[1].T_world_camera.translation().x(), 0.01);
  EXPECT_EQ(frames[1].color_path, folder() / "color/000001.jpg");
  EXPECT_THAT(growing.NewFrames(), IsEmpty());
  WriteFrame(2);
  EXPECT_THAT(Names(growing.NewFrames()), ElementsAre("000002"));
}

TEST_F(GrowingFolderTest, WhatIsHalfThereIsWaitedFor) {
  GrowingFolder growing(folder(), true);
  WriteFrame(0);
  for (const char* file : {"depth/000000.png", "color/000000.jpg", "pose/000000.txt"}) {
    Truncate(folder() / file, 0.4);
    EXPECT_THAT(growing.NewFrames(), IsEmpty()) << file;
    fs::remove(folder() / file);
    EXPECT_THAT(growing.NewFrames(), IsEmpty()) << file;
    Write(file);
  }
  EXPECT_THAT(Names(growing.NewFrames()), ElementsAre("000000"));
}

TEST_F(GrowingFolderTest, WhatStaysIncompleteIsPassedOver) {
  GrowingFolder growing(folder(), true);
  Write("depth/000000.png");
  WriteFrame(1);
  EXPECT_THAT(Names(growing.NewFrames()), ElementsAre("000001"));
  WriteFrame(0);
  EXPECT_THAT(growing.NewFrames(), IsEmpty());
}

TEST_F(GrowingFolderTest, PosesAreNotNeededWhereTheyAreNotAskedFor) {
  GrowingFolder growing(folder(), false);
  Write("depth/000000.png");
  Write("color/000000.jpg");
  const std::vector<SequenceFrame> frames = growing.NewFrames();
  ASSERT_THAT(Names(frames), ElementsAre("000000"));
  EXPECT_TRUE(frames[0].T_world_camera.isApprox(RigidTransform::Identity()));
}

TEST_F(GrowingFolderTest, EndsWithTheFileOfThatName) {
  const GrowingFolder growing(folder(), true);
  EXPECT_FALSE(growing.HasEnded());
  WriteText(folder() / "end", "");
  EXPECT_TRUE(growing.HasEnded());
}

TEST_F(GrowingFolderTest, AFolderThatIsGoneHasNoFrames) {
  GrowingFolder growing(folder() / "nowhere", true);
  EXPECT_FALSE(growing.Cameras());
  EXPECT_THAT(growing.NewFrames(), IsEmpty());
  EXPECT_FALSE(growing.HasEnded());
}

}  // namespace
}  // namespace curvefusion
