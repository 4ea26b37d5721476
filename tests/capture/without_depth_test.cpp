// Scans of colour images and poses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "capture/check.h"
#include "capture/sequence.h"
#include "kernel/error.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

std::string OpenError(const fs::path& folder, PoseUse poses, DepthUse depth) {
  return MessageOf(ErrorKind::kBadInput, [&] { OpenSequence(folder, poses, depth); });
}

class WithoutDepthTest : public testing::Test {
 protected:
  fs::path folder() const { return folder_.path(); }
  Sequence Open(DepthUse depth = DepthUse::kIfGiven) const {
    return OpenSequence(folder(), PoseUse::kIfGiven, depth);
  }

  TemporaryFolder folder_;
};

void ExpectColorAndPoses(const Sequence& sequence, const char* format) {
  EXPECT_EQ(sequence.format, format);
  EXPECT_FALSE(sequence.has_depth);
  EXPECT_TRUE(sequence.has_poses);
  ASSERT_EQ(sequence.frame_count(), kFixtureFrames);
  for (const SequenceFrame& frame : sequence.frames) EXPECT_TRUE(frame.depth_path.empty());
  EXPECT_EQ(sequence.frames[2].color_path.stem().string().back(), '2');
  EXPECT_EQ(sequence.frames[2].T_world_camera.translation(), Vec3(0.02, 0, 0));
  const DepthImage depth = LoadDepth(sequence, 1);  // nothing is measured
  EXPECT_EQ(depth.width(), 32);
  for (size_t i = 0; i < depth.size(); ++i) EXPECT_EQ(depth.data()[i], 0);
}

TEST_F(WithoutDepthTest, PerFramePoses) {
  WritePerFrameSequence(folder());
  fs::remove_all(folder() / "depth");
  const Sequence sequence = Open();
  ExpectColorAndPoses(sequence, "per-frame poses");
  ASSERT_EQ(sequence.warnings.size(), 1u);
  EXPECT_THAT(sequence.warnings[0], AllOf(HasSubstr("no depth images"), HasSubstr("in metres")));
}

TEST_F(WithoutDepthTest, TumOfColourImagesAlone) {
  WriteTumSequence(folder());
  fs::remove_all(folder() / "depth");
  fs::remove(folder() / "depth.txt");
  const Sequence sequence = Open();
  ExpectColorAndPoses(sequence, "tum");
  EXPECT_EQ(sequence.frames[2].color_delay, 0);
}

TEST_F(WithoutDepthTest, ListsMayNameDepthThatWasNotCopied) {
  WriteTumSequence(folder());
  fs::remove_all(folder() / "depth");
  ExpectColorAndPoses(Open(), "tum");
}

TEST_F(WithoutDepthTest, IgnoredDepthIsNotOpened) {
  WritePerFrameSequence(folder());
  for (const auto& file : fs::directory_iterator(folder() / "depth")) WriteText(file.path(), "?");
  const Sequence sequence = Open(DepthUse::kIgnored);
  ExpectColorAndPoses(sequence, "per-frame poses");
  EXPECT_TRUE(sequence.warnings.empty());  // as it was asked for
}

TEST_F(WithoutDepthTest, OneMissingImageIsAnError) {
  WriteTumSequence(folder());
  fs::remove(folder() / "depth/1.png");
  EXPECT_THAT(OpenError(folder(), PoseUse::kIfGiven, DepthUse::kIfGiven), HasSubstr("1.png"));
}

TEST_F(WithoutDepthTest, NeededDepthIsAskedFor) {
  WritePerFrameSequence(folder());
  fs::remove_all(folder() / "depth");
  EXPECT_THAT(OpenError(folder(), PoseUse::kIfGiven, DepthUse::kNeeded),
              AllOf(HasSubstr("no depth images"), HasSubstr("--depth auto or none")));
}

TEST_F(WithoutDepthTest, NeedsPoses) {
  WritePerFrameSequence(folder());
  fs::remove_all(folder() / "depth");
  EXPECT_THAT(OpenError(folder(), PoseUse::kIgnored, DepthUse::kIfGiven),
              AllOf(HasSubstr("neither depth images nor camera poses"), HasSubstr("COLMAP"),
                    HasSubstr("nerfstudio")));
}

TEST_F(WithoutDepthTest, CheckSaysSoAndFindsNothingElse) {
  WritePerFrameSequence(folder());
  fs::remove_all(folder() / "depth");
  const CheckReport report = CheckSequence(folder(), NoProgress);
  EXPECT_FALSE(report.has_errors());
  EXPECT_FALSE(report.has_depth);
  EXPECT_EQ(report.image_sizes.color_width, 32);
  EXPECT_EQ(report.image_sizes.depth_width, 0);
  EXPECT_FALSE(report.geometry.is_judged);
  int told = 0;
  for (const CheckFinding& finding : report.findings) {
    told += finding.cause == "no-depth";
    EXPECT_NE(finding.cause, "depth-sparse");
  }
  EXPECT_EQ(told, 1);
}

}  // namespace
}  // namespace curvefusion
