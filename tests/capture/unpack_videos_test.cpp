#include "capture/unpack_videos.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "capture/image_file.h"
#include "capture/png.h"
#include "capture/sequence.h"
#include "kernel/atomic_file.h"
#include "kernel/child_program.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

constexpr int kWidth = 64;
constexpr int kHeight = 48;
constexpr int kFrames = 12;

uint16_t DepthAt(int frame, int u, int v) {
  return static_cast<uint16_t>(500 + 257 * frame + 3 * u + v);  // both bytes change
}

// Grey that tells which frame it is; coarse, as videos lose fine differences.
uint8_t BrightnessOf(int frame) { return static_cast<uint8_t>(40 + 15 * frame); }

// Scans that are made of images and videos by the programs of FFmpeg.
class Videos : public testing::Test {
 protected:
  void SetUp() override {
    if (!RunProgram("ffmpeg", {"-version"}, ".").succeeded) GTEST_SKIP() << "ffmpeg is missing";
    for (int frame = 0; frame < kFrames; ++frame) {
      Image<uint16_t> depth(kWidth, kHeight);
      for (int v = 0; v < kHeight; ++v) {
        for (int u = 0; u < kWidth; ++u) depth(u, v) = DepthAt(frame, u, v);
      }
      const uint8_t grey = BrightnessOf(frame);
      Write(frame, "depth", EncodePng(depth));
      Write(frame, "rgb", EncodePng(ColorImage(kWidth, kHeight, {grey, grey, grey})));
    }
  }

  void Write(int frame, const std::string& images, const std::string& bytes) const {
    fs::create_directories(scan_ / images);
    WriteBytesAtomically(scan_ / images / fmt::format("{:06}.png", frame), bytes);
  }

  // Turns a folder of images into a video and removes it.
  void MakeVideo(const std::string& images, const std::string& video,
                 const std::vector<std::string>& coding, int rate = 30) const {
    std::vector<std::string> line = {
        "-v", "error", "-framerate", std::to_string(rate), "-i", images + "/%06d.png"};
    line.insert(line.end(), coding.begin(), coding.end());
    line.push_back(video);
    const ProgramResult result = RunProgram("ffmpeg", line, scan_);
    ASSERT_TRUE(result.succeeded) << result.messages;
    fs::remove_all(scan_ / images);
  }
  void MakeHevc() const {
    MakeVideo("rgb", "rgb.mp4", {"-c:v", "libx265", "-pix_fmt", "yuv420p", "-loglevel", "error"});
  }
  void MakeLosslessDepth(int rate = 30) const {
    MakeVideo("depth", "depth.mkv", {"-pix_fmt", "gray16le", "-c:v", "ffv1"}, rate);
  }

  fs::path Unpacked(const std::string& images, int frame, const std::string& extension) const {
    return folder_ / images / fmt::format("{:06}{}", frame, extension);
  }
  std::string UnpackError(ErrorKind kind) const {
    return MessageOf(kind, [&] { UnpackVideos(scan_, folder_, NoProgress); });
  }

  const TemporaryFolder parent_{"videos'"};  // a name that a shell would stumble over
  const fs::path scan_ = parent_.path() / "sc an: 1";
  const fs::path folder_ = parent_.path() / "images";
};

TEST_F(Videos, OfAPhoneBecomeImagesWithoutWhatItDoesNotTrust) {
  Write(3, "confidence", EncodePng(ColorImage(kWidth, kHeight, {0, 0, 0})));
  Write(4, "confidence", EncodePng(ColorImage(kWidth, kHeight, {1, 1, 1})));
  WriteText(scan_ / "odometry.csv", "timestamp, frame, x, y, z, qx, qy, qz, qw\n" +
                                        std::string("7, 3, 0, 0, 0, 0, 0, 0, 1\n") +
                                        "8, 4, 0, 0, 0, 0, 0, 0, 1\n");
  WriteText(scan_ / "camera_matrix.csv", "60, 0, 31.5\n0, 60, 23.5\n0, 0, 1\n");
  MakeHevc();
  EXPECT_THAT(VideoRemedy(scan_), AllOf(HasSubstr("rgb.mp4"), HasSubstr("curvefusion unpack")));

  const UnpackedVideos unpacked = UnpackVideos(scan_, folder_, NoProgress);
  EXPECT_EQ(unpacked.images.at("rgb"), kFrames);
  EXPECT_DOUBLE_EQ(unpacked.untrusted_share, 0.5);
  EXPECT_FALSE(fs::exists(folder_ / "rgb.mp4"));
  EXPECT_EQ(VideoRemedy(folder_), "");
  for (int frame = 0; frame < kFrames; ++frame) {
    const ColorImage image = DecodeColorImage(Unpacked("rgb", frame, ".jpg"));
    EXPECT_NEAR(image(kWidth / 2, kHeight / 2)[0], BrightnessOf(frame), 4) << frame;
    const Image<uint16_t> depth = DecodeDepthImage(Unpacked("depth", frame, ".png"));
    EXPECT_EQ(depth(9, 7), frame == 3 ? 0 : DepthAt(frame, 9, 7)) << frame;
  }
  EXPECT_EQ(OpenSequence(folder_).format, "stray scanner");
}

TEST_F(Videos, AsAPairKeepEveryBitOfDepth) {
  WriteText(scan_ / "intrinsics.json",
            R"({"width": 64, "height": 48, "fx": 60, "fy": 60, "cx": 31.5, "cy": 23.5})");
  MakeVideo("rgb", "color.mov", {"-c:v", "mjpeg"});
  MakeLosslessDepth();
  EXPECT_THAT(MessageOf(ErrorKind::kBadInput, [&] { OpenSequence(scan_, PoseUse::kIfGiven); }),
              HasSubstr("curvefusion unpack"));

  const UnpackedVideos unpacked = UnpackVideos(scan_, folder_, NoProgress);
  EXPECT_EQ(unpacked.images.at("depth"), kFrames);
  for (int frame = 0; frame < kFrames; ++frame) {
    const Image<uint16_t> depth = DecodeDepthImage(Unpacked("depth", frame, ".png"));
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) ASSERT_EQ(depth(u, v), DepthAt(frame, u, v)) << frame;
    }
  }
  EXPECT_EQ(OpenSequence(folder_, PoseUse::kIfGiven).frame_count(), kFrames);
}

TEST_F(Videos, ThatLoseDepthAreRefused) {
  MakeVideo("depth", "depth.mp4", {"-c:v", "libx265", "-pix_fmt", "gray10le"});
  EXPECT_THAT(UnpackError(ErrorKind::kBadInput),
              AllOf(HasSubstr("depth.mp4"), HasSubstr("gray10le by hevc"), HasSubstr("ffv1")));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(Videos, OfDifferentRatesAreRefused) {
  MakeVideo("rgb", "rgb.mp4", {"-c:v", "mjpeg"}, 60);
  MakeLosslessDepth(30);
  EXPECT_THAT(UnpackError(ErrorKind::kBadInput), AllOf(HasSubstr("60/1"), HasSubstr("30/1")));
}

TEST_F(Videos, ThatAreNoneAreNamed) {
  fs::remove_all(scan_ / "rgb");
  WriteText(scan_ / "rgb.mp4", "no video");
  EXPECT_THAT(UnpackError(ErrorKind::kBadInput), HasSubstr("rgb.mp4"));
  fs::remove(scan_ / "rgb.mp4");
  EXPECT_THAT(UnpackError(ErrorKind::kBadInput), HasSubstr("nothing to unpack"));
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(Videos, LeaveNothingWhereTheyAreInterrupted) {
  MakeHevc();
  const auto interrupt = [](std::string_view, int64_t, int64_t) {
    throw Error(ErrorKind::kInterrupted, "enough");
  };
  EXPECT_EQ(MessageOf(ErrorKind::kInterrupted, [&] { UnpackVideos(scan_, folder_, interrupt); }),
            "enough");
  const auto is_scan = [&](const fs::directory_entry& entry) { return entry.path() == scan_; };
  EXPECT_TRUE(std::all_of(fs::directory_iterator(parent_.path()), {}, is_scan));
}

}  // namespace
}  // namespace curvefusion
