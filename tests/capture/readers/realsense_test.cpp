#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "capture/check.h"
#include "capture/content/repair.h"
#include "capture/sequence.h"
#include "kernel/error.h"
#include "kernel/progress.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"
#include "tests/file_contents.h"
#include "tests/source_folder.h"

// The bags are written by ROS itself: write_realsense_bag.py, beside this file, has their values.

namespace curvefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int kFrames = 5;
constexpr int kLostColor = 3;

fs::path BagPath(const std::string& name) {
  return SourceFolder() / "tests/fuzz/corpus/bag" / (name + ".bag");
}

// The bag without compression, to be spoiled.
class SpoiledBag : public testing::Test {
 protected:
  SpoiledBag() : bytes(FileText(BagPath("none"))) {}

  // Replaces all occurrences; both texts must have one length, so that all sizes stay right.
  void Replace(const std::string& text, const std::string& other) {
    ASSERT_EQ(text.size(), other.size());
    size_t count = 0;
    for (size_t at = bytes.find(text); at != std::string::npos; at = bytes.find(text, at + 1)) {
      bytes.replace(at, text.size(), other);
      ++count;
    }
    ASSERT_GT(count, 0u) << text;
  }

  fs::path Written() const {
    std::ofstream(folder_.path() / "scan.bag", std::ios::binary) << bytes;
    return folder_.path() / "scan.bag";
  }

  std::string OpenError() const {
    try {
      OpenSequence(Written(), PoseUse::kIfGiven);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      return error.what();
    }
    return "no error";
  }

  std::string bytes;

 private:
  TemporaryFolder folder_;
};

class Compressions : public testing::TestWithParam<const char*> {};

TEST_P(Compressions, CamerasFramesAndPixelsAreThoseRecorded) {
  const Sequence sequence = OpenSequence(BagPath(GetParam()), PoseUse::kIfGiven);
  EXPECT_EQ(sequence.format, "realsense bag");
  EXPECT_FALSE(sequence.has_poses);
  EXPECT_EQ(sequence.depth_camera.width, 16);
  EXPECT_EQ(sequence.depth_camera.fx, 15);
  EXPECT_EQ(sequence.depth_camera.fy, 16);
  EXPECT_EQ(sequence.depth_camera.cx, 7.5);
  EXPECT_EQ(sequence.color_camera.height, 15);
  EXPECT_EQ(sequence.color_camera.cy, 7);
  EXPECT_TRUE(sequence.depth_distortion.IsZero());
  EXPECT_EQ(sequence.color_distortion.k1, -0.05);
  EXPECT_EQ(sequence.color_distortion.p2, -0.002);
  EXPECT_EQ(sequence.color_distortion.k3, -0.01);
  EXPECT_NEAR((sequence.T_color_depth.translation() - Vec3(0.015, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((sequence.T_color_depth.linear() - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
  EXPECT_EQ(sequence.depth_scale, 4000);  // that of the images, not of the option
  EXPECT_EQ(sequence.frames_without_partner, 1);
  ASSERT_EQ(sequence.frame_count(), kFrames - 1);
  for (int k = 0; k < sequence.frame_count(); ++k) {
    const int i = k < kLostColor ? k : k + 1;
    const SequenceFrame& frame = sequence.frames[static_cast<size_t>(k)];
    EXPECT_EQ(frame.name, fmt::format("{:06}", i));
    EXPECT_NEAR(frame.timestamp, 1000 + i / 30.0, 1e-6);
    EXPECT_NEAR(frame.color_delay, 0.002, 1e-6);
    const DepthImage depth = LoadDepth(sequence, k);
    EXPECT_NEAR(depth(5, 7), (2000 + 100 * i + 10 * 7 + 5) * 0.00025, 1e-6);
    EXPECT_NEAR(depth(15, 11), (2000 + 100 * i + 10 * 11 + 15) * 0.00025, 1e-6);
    Sequence undistorted = sequence;
    undistorted.color_distortion = {};
    const auto red = static_cast<uint8_t>(10 * i + 19);
    EXPECT_EQ(LoadColorAsStored(undistorted, k)(19, 14), (Rgb{red, 114, 200}));
  }
}

INSTANTIATE_TEST_SUITE_P(RealSense, Compressions, testing::Values("none", "lz4", "bz2"));

TEST(RealSense, CheckNamesTheFormatAndTheMissingPoses) {
  const CheckReport report = CheckSequence(BagPath("lz4"), NoProgress);
  EXPECT_EQ(report.format, "realsense bag");
  EXPECT_FALSE(report.has_errors());
  ASSERT_FALSE(report.findings.empty());
  EXPECT_THAT(report.findings[0].message, HasSubstr("has no camera poses"));
  EXPECT_THAT(MessageOf([] { OpenSequence(BagPath("lz4")); }),
              AllOf(HasSubstr("lz4.bag"), HasSubstr("curvefusion track")));
}

TEST(RealSense, ACopyInAFolderHasTheSameImages) {
  TemporaryFolder folder;
  SequenceCorrection copy;
  copy.sequence = OpenSequence(BagPath("bz2"), PoseUse::kIfGiven);
  WriteRepairedSequence(copy, folder.path() / "copy");
  const Sequence sequence = OpenSequence(folder.path() / "copy", PoseUse::kIgnored);
  EXPECT_EQ(sequence.format, "per-frame poses");
  EXPECT_EQ(sequence.color_distortion.k1, copy.sequence.color_distortion.k1);
  ASSERT_EQ(sequence.frame_count(), copy.sequence.frame_count());
  for (int k = 0; k < sequence.frame_count(); ++k) {
    EXPECT_EQ(LoadDepth(sequence, k)(3, 3), LoadDepth(copy.sequence, k)(3, 3));
    EXPECT_EQ(LoadColor(sequence, k)(9, 9), LoadColor(copy.sequence, k)(9, 9));
  }
}

TEST_F(SpoiledBag, OtherTopicsAreNamed) {
  Replace("Depth_0", "depth_0");
  EXPECT_THAT(OpenError(), AllOf(HasSubstr("no Depth images"), HasSubstr("/depth_0/image/data")));
}

TEST_F(SpoiledBag, OtherPixelsAreRefused) {
  Replace("rgb8", "YUYV");
  EXPECT_THAT(OpenError(), AllOf(HasSubstr("Color_0 image 0"), HasSubstr("'YUYV'")));
}

TEST_F(SpoiledBag, OtherLensesAreRefused) {
  Replace("Inverse Brown Conrady", "Kannala Brandt4 model");
  EXPECT_THAT(OpenError(), AllOf(HasSubstr("Color_0/info/camera_info"), HasSubstr("Kannala")));
}

TEST_F(SpoiledBag, WithoutACameraIsRefused) {
  Replace("Color_0/info/camera_info", "Color_0/info/camera_xxxx");
  EXPECT_THAT(OpenError(), HasSubstr("camera_info is missing"));
}

TEST_F(SpoiledBag, WithoutExtrinsicsIsReadWithAWarning) {
  Replace("Color_0/tf/0", "Color_0/tf/1");
  const Sequence sequence = OpenSequence(Written(), PoseUse::kIfGiven);
  EXPECT_TRUE(sequence.T_color_depth.isApprox(RigidTransform::Identity()));
  ASSERT_FALSE(sequence.warnings.empty());
  EXPECT_THAT(sequence.warnings[0], HasSubstr("holds no extrinsics"));
}

TEST_F(SpoiledBag, UnknownCompressionIsRefused) {
  Replace("compression=none", "compression=zstd");
  EXPECT_THAT(OpenError(), AllOf(HasSubstr("'zstd'"), HasSubstr("none, lz4 and bz2")));
}

TEST_F(SpoiledBag, IsReadUpToItsCut) {
  const size_t chunk = bytes.rfind("op=\x05");  // the last one, with the last two frames
  ASSERT_NE(chunk, std::string::npos);
  bytes.resize(chunk + 100);
  EXPECT_THAT(OpenError(), AllOf(HasSubstr("scan.bag"), HasSubstr("is cut off")));
  const CheckReport report = CheckSequence(Written(), NoProgress);
  EXPECT_EQ(report.frames, kFrames - 2);
}

TEST_F(SpoiledBag, AnyCutAndAnyByteHasAnAnswer) {
  const std::string good = bytes;
  for (size_t size = 0; size < good.size(); size += 997) {
    bytes = good.substr(0, size);
    EXPECT_NE(OpenError(), "no error") << size;
  }
  for (size_t at = 4110; at < good.size(); at += 211) {  // behind the bag's own header
    bytes = good;
    bytes[at] = static_cast<char>(~bytes[at]);
    OpenError();  // pixels may change; nothing else comes out of it than Error
  }
}

TEST_F(SpoiledBag, IsNoBag) {
  bytes = "#ROSBAG V1.2\n";
  EXPECT_THAT(OpenError(), HasSubstr("format 2.0"));
}

TEST(RealSense, PackedDamageNamesTheChunk) {
  TemporaryFolder folder;
  for (const char* name : {"lz4", "bz2"}) {
    std::string bytes = FileText(BagPath(name));
    const size_t chunk = bytes.find("op=\x05");
    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(chunk) + 120, 40, '\x55');
    std::ofstream(folder.path() / "scan.bag", std::ios::binary) << bytes;
    const auto open = [&] { OpenSequence(folder.path() / "scan.bag", PoseUse::kIfGiven); };
    EXPECT_THAT(MessageOf(open), HasSubstr("is damaged")) << name;
  }
}

}  // namespace
}  // namespace curvefusion
