#include "capture/sequence.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "kernel/error.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string OpenError(const std::filesystem::path& folder) {
  return MessageOf(ErrorKind::kBadInput, [&] { OpenSequence(folder); });
}

class SequenceTest : public testing::Test {
 protected:
  std::filesystem::path folder() const { return folder_.path(); }

  TemporaryFolder folder_;
};

TEST_F(SequenceTest, Tum) {
  WriteTumSequence(folder());
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "tum");
  ASSERT_EQ(sequence.frame_count(), kFixtureFrames);
  EXPECT_EQ(sequence.depth_scale, 5000);
  EXPECT_EQ(sequence.frames[2].name, "10.200");
  EXPECT_EQ(sequence.frames[2].timestamp, 10.2);
  EXPECT_EQ(sequence.frames[2].T_world_camera.translation(), Vec3(0.02, 0, 0));
  EXPECT_EQ(sequence.frames[2].color_path.filename(), "2.jpg");
  const DepthImage depth = LoadDepth(sequence, 1);
  EXPECT_FLOAT_EQ(depth(0, 0), 1.0f);
  EXPECT_FLOAT_EQ(depth(5, 7), 5005.0f / 5000);
  EXPECT_NEAR(LoadColor(sequence, 1)(3, 3)[0], 200, 3);  // JPEG is lossy
}

// The stamps of colour image 1 are moved out of reach, pose 3 is missing.
TEST_F(SequenceTest, TumAssociatesWithinTwentyMilliseconds) {
  WriteTumSequence(folder());
  WriteText(folder() / "rgb.txt",
            "10.019 rgb/0.jpg\n10.121 rgb/1.jpg\n10.19 rgb/2.jpg\n10.205 rgb/2b.jpg\n"
            "10.3 rgb/3.jpg\n");
  WriteColor(folder() / "rgb/2b.jpg", 32, 24);
  WriteText(folder() / "trajectory.txt",
            "10 0 0 0 0 0 0 1\n10.1 0 0 0 0 0 0 1\n10.2 0 0 0 0 0 0 1\n10.4 0 0 0 0 0 0 1\n");
  const Sequence sequence = OpenSequence(folder());
  ASSERT_EQ(sequence.frame_count(), 2);
  EXPECT_EQ(sequence.frames[0].color_path.filename(), "0.jpg");
  EXPECT_EQ(sequence.frames[1].color_path.filename(), "2b.jpg");
  EXPECT_EQ(sequence.frames_without_pose, 1);
  EXPECT_EQ(sequence.frames_without_partner, 3);  // rgb/1, rgb/2 and depth/1
}

TEST_F(SequenceTest, TumAssociationsInEitherOrder) {
  for (const bool depth_first : {false, true}) {
    TemporaryFolder other;
    WriteTumSequence(other.path());
    std::string text;
    for (int i = 0; i < kFixtureFrames; ++i) {
      const std::string color = fmt::format("{} rgb/{}.jpg", 10 + 0.1 * i + 0.004, i);
      const std::string depth = fmt::format("{} depth/{}.png", 10 + 0.1 * i, i);
      text += depth_first ? depth + " " + color + "\n" : color + " " + depth + "\n";
    }
    WriteText(other.path() / "associations.txt", text);
    std::filesystem::remove(other.path() / "rgb.txt");
    std::filesystem::remove(other.path() / "depth.txt");
    const Sequence sequence = OpenSequence(other.path());
    ASSERT_EQ(sequence.frame_count(), kFixtureFrames);
    EXPECT_EQ(sequence.frames[3].depth_path.filename(), "3.png");
    EXPECT_EQ(sequence.frames[3].color_path.filename(), "3.jpg");
  }
}

TEST_F(SequenceTest, PerFramePosesDropFramesWithoutPoseOrPartner) {
  WritePerFrameSequence(folder());
  std::filesystem::remove(folder() / "pose/000001.txt");
  std::filesystem::remove(folder() / "color/000002.jpg");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "per-frame poses");
  EXPECT_EQ(sequence.depth_scale, 1000);
  ASSERT_EQ(sequence.frame_count(), 2);
  EXPECT_EQ(sequence.frames[1].name, "000003");
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation(), Vec3(0.03, 0, 0));
  EXPECT_EQ(sequence.frames_without_pose, 1);
  EXPECT_EQ(sequence.frames_without_partner, 1);
}

TEST_F(SequenceTest, ColourFoldersHaveSeveralNames) {
  for (const char* name : {"image", "images", "rgb", "colour"}) {
    TemporaryFolder other;
    WritePerFrameSequence(other.path());
    std::filesystem::rename(other.path() / "color", other.path() / name);
    EXPECT_EQ(OpenSequence(other.path()).frame_count(), kFixtureFrames) << name;
  }
}

TEST_F(SequenceTest, ImagesOfFormatsThatAreNotReadAreNamed) {
  WritePerFrameSequence(folder());
  std::filesystem::remove(folder() / "color/000000.jpg");
  std::filesystem::copy(folder() / "color/000001.jpg", folder() / "color/000000.TIFF");
  EXPECT_EQ(OpenSequence(folder()).frame_count(), kFixtureFrames - 1);
  for (int i = 1; i < kFixtureFrames; ++i) {
    std::filesystem::remove(folder() / "color" / fmt::format("{:06}.jpg", i));
  }
  EXPECT_THAT(OpenError(folder()),
              HasSubstr("000000.TIFF: is not read; convert the images to PNG"));
}

TEST_F(SequenceTest, SevenScenesMayHaveJpegColour) {
  WritePerFrameSequence(folder());
  for (int i = 0; i < kFixtureFrames; ++i) {
    const std::string old = fmt::format("{:06}", i), frame = "frame-" + old;
    std::filesystem::rename(folder() / "depth" / (old + ".png"), folder() / (frame + ".depth.png"));
    std::filesystem::rename(folder() / "color" / (old + ".jpg"), folder() / (frame + ".color.jpg"));
    std::filesystem::rename(folder() / "pose" / (old + ".txt"), folder() / (frame + ".pose.txt"));
  }
  std::filesystem::remove(folder() / "pose");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "7-scenes");
  EXPECT_EQ(sequence.frame_count(), kFixtureFrames);
}

TEST_F(SequenceTest, AScanInsideTheFolderIsProposed) {
  WritePerFrameSequence(folder() / "recordings/second");
  WritePerFrameSequence(folder() / "recordings/first");
  EXPECT_THAT(OpenError(folder() / "recordings"),
              AllOf(HasSubstr("holds some; did you mean"), HasSubstr("recordings/first or "),
                    HasSubstr("recordings/second?")));
}

TEST_F(SequenceTest, Redwood) {
  WritePerFrameSequence(folder());
  std::filesystem::remove_all(folder() / "pose");
  std::filesystem::remove(folder() / "intrinsics.json");
  std::filesystem::rename(folder() / "color/000002.jpg", folder() / "color/000002-0000066.jpg");
  WriteText(folder() / "intrinsic.json",
            R"({"width":32,"height":24,"intrinsic_matrix":[30,0,0,0,31,0,15,11,1]})");
  WriteText(folder() / "trajectory.log",
            "0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n"
            "2 2 3\n1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "redwood");
  ASSERT_EQ(sequence.frame_count(), 2);
  EXPECT_EQ(sequence.frames_without_pose, 2);
  EXPECT_EQ(sequence.frames[1].name, "000002");
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation(), Vec3(5, 6, 7));
  EXPECT_EQ(sequence.depth_camera.fy, 31);
  WriteText(folder() / "trajectory.log", "nan 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_THAT(OpenError(folder()), HasSubstr("trajectory.log:1: nan is no frame number"));
}

TEST_F(SequenceTest, SevenScenes) {
  for (int i = 0; i < 3; ++i) {
    const std::string stem = fmt::format("frame-{:06}", i);
    WriteColor(folder() / (stem + ".color.png"), 640, 480);
    WriteDepthPng(folder() / (stem + ".depth.png"), 640, 480, 65535 - 639);
    WriteText(folder() / (stem + ".pose.txt"), "1 0 0 0\n0 1 0 0\n0 0 1 0.5\n0 0 0 1\n");
  }
  WriteText(
      folder() / "intrinsics.json",
      R"({"width":640,"height":480,"fx":585,"fy":585,"cx":320,"cy":240,"depth_scale":65000})");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.format, "7-scenes");
  ASSERT_EQ(sequence.frame_count(), 3);
  EXPECT_EQ(sequence.frames[1].T_world_camera.translation().z(), 0.5);
  const DepthImage depth = LoadDepth(sequence, 0);
  EXPECT_EQ(depth(639, 100), 0);  // 65535 = invalid
  EXPECT_GT(depth(638, 100), 0);
  EXPECT_TRUE(sequence.warnings.empty());
}

TEST_F(SequenceTest, SevenScenesWithoutIntrinsicsUsesThePublishedOnesAndSaysSo) {
  WriteColor(folder() / "frame-000000.color.png", 640, 480);
  WriteDepthPng(folder() / "frame-000000.depth.png", 640, 480, 1000);
  WriteText(folder() / "frame-000000.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  const Sequence sequence = OpenSequence(folder());
  EXPECT_EQ(sequence.depth_camera.fx, 585);
  ASSERT_EQ(sequence.warnings.size(), 1u);
  EXPECT_THAT(sequence.warnings[0], HasSubstr("intrinsics.json: is missing"));
}

TEST_F(SequenceTest, UnknownFoldersAreExplained) {
  EXPECT_THAT(OpenError(folder() / "none"), HasSubstr("there is no such folder"));
  EXPECT_THAT(OpenError(folder()), HasSubstr("the folder is empty"));
  WriteText(folder() / "notes.txt", "x");
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("format"), HasSubstr("trajectory.log")));
}

TEST_F(SequenceTest, ImagesWithoutCamerasAreExplained) {
  WritePerFrameSequence(folder());
  std::filesystem::remove_all(folder() / "pose");
  std::filesystem::remove(folder() / "intrinsics.json");
  EXPECT_THAT(OpenError(folder()), HasSubstr("but not intrinsics.json"));
  WriteText(folder() / "camera_intrinsic.json", "{}");  // as Open3D's recorders write it
  EXPECT_THAT(OpenError(folder()), HasSubstr("rename camera_intrinsic.json"));
}

TEST_F(SequenceTest, MissingFilesAreNamed) {
  WriteTumSequence(folder());
  std::filesystem::remove(folder() / "trajectory.txt");
  EXPECT_THAT(OpenError(folder()), HasSubstr("neither trajectory.txt nor groundtruth.txt"));
}

TEST_F(SequenceTest, ASequenceWithoutPosesOpensWhereNoneAreNeeded) {
  WriteTumSequence(folder());
  EXPECT_TRUE(OpenSequence(folder(), PoseUse::kIfGiven).has_poses);
  std::filesystem::remove(folder() / "trajectory.txt");
  const Sequence tum = OpenSequence(folder(), PoseUse::kIfGiven);
  EXPECT_FALSE(tum.has_poses);
  EXPECT_EQ(tum.frame_count(), kFixtureFrames);

  const TemporaryFolder other;
  WritePerFrameSequence(other.path());
  std::filesystem::remove(other.path() / "pose/000001.txt");
  EXPECT_EQ(OpenSequence(other.path()).frame_count(), kFixtureFrames - 1);
  EXPECT_EQ(OpenSequence(other.path(), PoseUse::kIgnored).frame_count(), kFixtureFrames);
  std::filesystem::remove_all(other.path() / "pose");
  const Sequence images = OpenSequence(other.path(), PoseUse::kIfGiven);
  EXPECT_FALSE(images.has_poses);
  EXPECT_EQ(images.frame_count(), kFixtureFrames);
}

// The fixture's colour comes 4 ms after its depth.
TEST_F(SequenceTest, TheDelayOfColourIsKept) {
  WriteTumSequence(folder());
  for (const SequenceFrame& frame : OpenSequence(folder()).frames) {
    EXPECT_NEAR(frame.color_delay, 0.004, 1e-9);
  }
}

TEST_F(SequenceTest, LoadingAnImageOfAnotherSizeThrows) {
  WriteTumSequence(folder());
  const Sequence sequence = OpenSequence(folder());
  WriteDepthPng(folder() / "depth/1.png", 16, 12, 5000);
  WriteColor(folder() / "rgb/1.jpg", 16, 12);
  EXPECT_THROW(LoadDepth(sequence, 1), Error);
  EXPECT_THROW(LoadColor(sequence, 1), Error);
}

TEST_F(SequenceTest, OpeningFailsWhereAReconstructionWould) {
  WriteTumSequence(folder());
  Truncate(folder() / "rgb/2.jpg", 0.5);
  EXPECT_THAT(OpenError(folder()), AllOf(HasSubstr("rgb/2.jpg"), HasSubstr("is truncated")));
}

// Figures from the data's README.
TEST(IsVideo, TellsAMovingCameraFromViewsFarApart) {
  const auto is_video = [](int frames, double step, int jumps) {
    Sequence sequence;
    sequence.frames.resize(frames);
    for (int i = 0; i < frames; ++i) {
      const double x = i * step + std::min(i, jumps) * 0.5;  // the first steps are longer
      sequence.frames[i].T_world_camera = RigidTransform(Eigen::Translation3d(x, 0, 0));
    }
    return IsVideo(sequence);
  };
  EXPECT_TRUE(is_video(20, 0.015, 0));
  EXPECT_TRUE(is_video(20, 0.015, 4));
  EXPECT_FALSE(is_video(20, 0.015, 10));
  EXPECT_FALSE(is_video(20, 0.025, 0));
  EXPECT_FALSE(is_video(1, 0, 0));
}

TEST(RealSequence, Cable) {
  const auto path = SharedData("real/cable_d435i");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Sequence sequence = OpenSequence(path);
  EXPECT_EQ(sequence.format, "per-frame poses");
  EXPECT_EQ(sequence.frame_count(), 48);
  EXPECT_EQ(sequence.depth_scale, 1000);
  EXPECT_EQ(LoadDepth(sequence, 47).width(), 1280);
  EXPECT_EQ(LoadColor(sequence, 47).height(), 720);
}

TEST(RealSequence, Cubeframe) {
  const auto path = SharedData("sim/cubeframe");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Sequence sequence = OpenSequence(path);
  EXPECT_EQ(sequence.format, "tum");
  EXPECT_EQ(sequence.frame_count(), 150);
  EXPECT_EQ(sequence.frames_without_pose + sequence.frames_without_partner, 0);
  const DepthImage depth = LoadDepth(sequence, 0);
  EXPECT_GT(depth(320, 300), 0.2);  // wires at 0.5 to 0.9 m, background nearer than 2.4 m
  EXPECT_LT(depth(320, 300), 2.4);
}

}  // namespace
}  // namespace curvefusion
