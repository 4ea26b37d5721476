#include "capture/check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "capture/sequence.h"
#include "kernel/error.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Matcher;
using testing::SizeIs;

Matcher<CheckFinding> IsError(const std::string& part) {
  return AllOf(Field(&CheckFinding::severity, Severity::kError),
               Field(&CheckFinding::message, HasSubstr(part)));
}

Matcher<CheckFinding> IsWarning(const std::string& part) {
  return AllOf(Field(&CheckFinding::severity, Severity::kWarning),
               Field(&CheckFinding::message, HasSubstr(part)));
}

// Without what makes four frames of 32x24 pixels unfit for wires.
std::vector<CheckFinding> Defects(std::vector<CheckFinding> findings) {
  std::erase_if(findings, [](const CheckFinding& finding) {
    return finding.cause == "too-few-frames" || finding.cause == "path-too-short" ||
           finding.cause == "no-colour";
  });
  return findings;
}

// Broken variants of a healthy TUM sequence, with exactly one finding each.
class CheckTest : public testing::Test {
 protected:
  CheckTest() { WriteTumSequence(folder()); }
  std::filesystem::path folder() const { return folder_.path(); }

  void ExpectOnly(const Matcher<CheckFinding>& expected) {
    const CheckReport report = CheckSequence(folder(), NoProgress);
    EXPECT_THAT(Defects(report.findings), AllOf(SizeIs(1), Each(expected)));
  }
  void ExpectOpeningFails() { EXPECT_THROW(OpenSequence(folder()), Error); }

  TemporaryFolder folder_;
};

TEST_F(CheckTest, AHealthySequenceHasFiguresAndNoFindings) {
  const CheckReport report = CheckSequence(folder(), NoProgress);
  EXPECT_THAT(Defects(report.findings), IsEmpty());
  EXPECT_FALSE(report.has_errors());
  EXPECT_EQ(report.format, "tum");
  EXPECT_EQ(report.frames, 4);
  EXPECT_EQ(report.image_sizes.depth_width, 32);
  EXPECT_EQ(report.image_sizes.color_height, 24);
  EXPECT_NEAR(report.median_depth, 1.003, 0.003);  // raw 5000 to 5031 by column
  EXPECT_EQ(report.depth_validity, 1);
  EXPECT_NEAR(report.trajectory_length, 0.03, 1e-12);
  EXPECT_NEAR(report.duration, 0.3, 1e-9);
}

TEST_F(CheckTest, MissingImage) {
  std::filesystem::remove(folder() / "depth/2.png");
  ExpectOnly(IsError("depth/2.png: is not there"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, TruncatedImages) {
  Truncate(folder() / "rgb/1.jpg", 0.5);
  Truncate(folder() / "rgb/3.jpg", 0.5);
  ExpectOnly(AllOf(IsError("rgb/1.jpg"), IsError("rgb/3.jpg: is truncated")));
  ExpectOpeningFails();
}

TEST_F(CheckTest, ImageBrokenInside) {
  std::fstream stream(folder() / "depth/2.png", std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(50);
  stream << "garbage";
  stream.close();
  ExpectOnly(IsError("depth/2.png: is damaged (wrong checksum"));
}

TEST_F(CheckTest, EightBitDepth) {
  for (int i = 0; i < kFixtureFrames; ++i) {
    WriteGreyPng(folder() / fmt::format("depth/{}.png", i), 32, 24);
  }
  ExpectOnly(IsError("has 8 bits and 1 channels"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, MixedSizes) {
  WriteDepthPng(folder() / "depth/2.png", 16, 12, 5000);
  ExpectOnly(IsError("depth/2.png: is 16x12, the first depth image is 32x24"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, IntrinsicsThatDoNotFit) {
  WriteText(folder() / "intrinsics.json",
            R"({"width":64,"height":48,"fx":60,"fy":60,"cx":31.5,"cy":23.5,)"
            R"("color_camera":{"width":32,"height":24,"fx":30,"fy":30,"cx":15.5,"cy":11.5}})");
  ExpectOnly(IsError("the depth images are 32x24, the intrinsics are for 64x48"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, MissingIntrinsics) {
  std::filesystem::remove(folder() / "intrinsics.json");
  ExpectOnly(IsError("intrinsics.json: is missing"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, NanPose) {
  WriteText(folder() / "trajectory.txt",
            "10 0 0 0 0 0 0 1\n10.1 nan 0 0 0 0 0 1\n10.2 0 0 0 0 0 0 1\n10.3 0 0 0 0 0 0 1\n");
  ExpectOnly(IsError("trajectory.txt:2: the pose at 10.1 holds nan"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, NonRigidPose) {
  TemporaryFolder other;
  WritePerFrameSequence(other.path());
  WriteText(other.path() / "pose/000001.txt", "1.01 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  WriteText(other.path() / "pose/000002.txt", "1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n");
  const CheckReport report = CheckSequence(other.path(), NoProgress);
  EXPECT_THAT(report.findings, Contains(IsError("pose/000001.txt: the pose is not rigid: |R'R - I| "
                                                "= 0.0201 (limit 0.001)")));
  EXPECT_THAT(report.findings, Contains(IsError("pose/000002.txt: the pose is not rigid")));
  EXPECT_THAT(report.findings, SizeIs(2));
  EXPECT_THROW(OpenSequence(other.path()), Error);
}

TEST_F(CheckTest, UnsortedStamps) {
  WriteText(folder() / "depth.txt",
            "10.1 depth/1.png\n10.0 depth/0.png\n10.2 depth/2.png\n10.3 depth/3.png\n");
  ExpectOnly(IsWarning("depth.txt: the stamps are not in order (first at 10.000000)"));
  EXPECT_THAT(OpenSequence(folder()).warnings, SizeIs(1));
}

TEST_F(CheckTest, DuplicateStamps) {
  WriteText(folder() / "depth.txt",
            "10.0 depth/0.png\n10.1 depth/1.png\n10.1 depth/2.png\n10.3 depth/3.png\n"
            "10.2 depth/2.png\n");
  const CheckReport report = CheckSequence(folder(), NoProgress);
  EXPECT_THAT(report.findings,
              Contains(IsWarning("depth.txt: the stamp 10.100000 stands there more than once")));
}

TEST_F(CheckTest, FewFramesAssociated) {
  WriteText(folder() / "trajectory.txt", "10 0 0 0 0 0 0 1\n");
  ExpectOnly(IsWarning("1 of 4 frames have a pose and both images (3 without a pose"));
}

TEST_F(CheckTest, NoFrameAssociated) {
  WriteText(folder() / "trajectory.txt", "99 0 0 0 0 0 0 1\n");
  ExpectOnly(IsError("0 of 4 frames have a pose"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, WrongDepthScale) {
  WriteText(folder() / "intrinsics.json",
            R"({"width":32,"height":24,"fx":30,"fy":30,"cx":15.5,"cy":11.5,"depth_scale":100})");
  ExpectOnly(
      AllOf(IsError("the median depth is 50.1"), IsError("depth_scale 5000 would make it 1.00 m")));
  ExpectOpeningFails();
}

TEST_F(CheckTest, DepthWithoutAnyMeasurement) {
  for (int i = 0; i < kFixtureFrames; ++i) {
    WriteDepthPng(folder() / fmt::format("depth/{}.png", i), 32, 24, -40);  // all negative, so 0
  }
  ExpectOnly(IsError("the depth images have no valid pixel"));
  ExpectOpeningFails();
}

TEST_F(CheckTest, EmptyFolder) {
  TemporaryFolder empty;
  const CheckReport report = CheckSequence(empty.path(), NoProgress);
  EXPECT_THAT(report.findings, AllOf(SizeIs(1), Each(IsError("the folder is empty"))));
  EXPECT_TRUE(report.has_errors());
}

TEST_F(CheckTest, AllDefectsAreCollectedErrorsFirst) {
  WriteText(folder() / "depth.txt",
            "10.1 depth/1.png\n10.0 depth/0.png\n10.2 depth/2.png\n10.3 depth/3.png\n");
  Truncate(folder() / "rgb/1.jpg", 0.5);
  WriteGreyPng(folder() / "depth/3.png", 32, 24);
  WriteText(folder() / "intrinsics.json", "{}");
  const CheckReport report = CheckSequence(folder(), NoProgress);
  EXPECT_THAT(report.findings, SizeIs(4));
  EXPECT_THAT(report.findings, Contains(IsError("'width' is missing")));
  EXPECT_THAT(report.findings, Contains(IsError("rgb/1.jpg: is truncated")));
  EXPECT_THAT(report.findings, Contains(IsError("depth/3.png: has 8 bits")));
  EXPECT_EQ(report.findings.back().severity, Severity::kWarning);
}

TEST_F(CheckTest, ProgressReachesTheEnd) {
  int64_t last = -1;
  CheckSequence(folder(), [&last](std::string_view, int64_t done, int64_t total) {
    EXPECT_EQ(total, kFixtureFrames);
    last = done;
  });
  EXPECT_EQ(last, kFixtureFrames);
}

TEST(CheckSharedData, RealAndSimulatedScansAreSound) {
  for (const char* name : {"real/cable_d435i", "sim/cubeframe"}) {
    const auto path = SharedData(name);
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const CheckReport report = CheckSequence(path, NoProgress);
    for (const CheckFinding& finding : report.findings) ADD_FAILURE() << finding.message;
    EXPECT_GT(report.median_depth, 0.2);
    EXPECT_LT(report.median_depth, 2.4);
    EXPECT_GT(report.depth_validity, 0.5);
  }
}

}  // namespace
}  // namespace curvefusion
