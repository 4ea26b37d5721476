#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "capture/check.h"
#include "capture/content/repair.h"
#include "capture/sequence.h"
#include "kernel/error.h"
#include "kernel/progress.h"
#include "tests/capture/content/room_scan.h"
#include "tests/capture/readers/sens_sample.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/error_message.h"

namespace curvefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

const RoomScan& Room() {
  static const RoomScan scan = MakeRoomScan();
  return scan;
}

class Sens : public testing::Test {
 protected:
  Sens() : sample(RoomAsSens(Room())) {}

  fs::path path() const { return folder_.path() / "room.sens"; }
  fs::path folder() const { return folder_.path(); }
  void Write() const { WriteBytes(path(), sample.Bytes()); }

  Sequence Opened(PoseUse use = PoseUse::kNeeded) const {
    Write();
    return OpenSequence(path(), use);
  }

  std::string OpenError() const {
    return MessageOf(ErrorKind::kBadInput, [&] { OpenSequence(path()); });
  }

  std::string ErrorOfSample() const {
    Write();
    return OpenError();
  }

  SensSample sample;

 private:
  TemporaryFolder folder_;
};

void ExpectDepthOfRoom(const Sequence& sequence, int frame) {
  const DepthImage depth = LoadDepth(sequence, frame);
  const Image<uint16_t>& raw = Room().thumbnails.depth[static_cast<size_t>(frame)];
  ASSERT_EQ(depth.width(), raw.width());
  for (size_t i = 0; i < depth.size(); ++i) {
    EXPECT_FLOAT_EQ(depth.data()[i], static_cast<float>(raw.data()[i] / 5000.0));
  }
}

void ExpectColorOfRoom(const Sequence& sequence, int frame) {
  const ColorImage color = LoadColor(sequence, frame);
  const Image<uint8_t>& grey = Room().thumbnails.grey[static_cast<size_t>(frame)];
  ASSERT_EQ(color.height(), grey.height());
  for (size_t i = 0; i < color.size(); ++i) {
    const uint8_t value = grey.data()[i];
    EXPECT_EQ(color.data()[i], (Rgb{value, value, value}));
  }
}

TEST_F(Sens, HasCamerasPosesTimesAndImages) {
  const Sequence sequence = Opened();
  EXPECT_EQ(sequence.format, "sens");
  EXPECT_EQ(sequence.folder, path());
  EXPECT_EQ(sequence.depth_scale, 5000);
  EXPECT_EQ(sequence.depth_camera.fx, Room().sequence.depth_camera.fx);
  EXPECT_EQ(sequence.depth_camera.cy, Room().sequence.depth_camera.cy);
  ASSERT_EQ(sequence.frame_count(), kRoomFrames);
  EXPECT_EQ(sequence.frames[30].name, "000030");
  EXPECT_NEAR(sequence.frames[30].timestamp, 8, 1e-9);
  EXPECT_NEAR(sequence.frames[30].color_delay, 0.004, 1e-9);
  const RigidTransform& pose = Room().sequence.frames[30].T_world_camera;
  // Poses are stored as float.
  EXPECT_LT((sequence.frames[30].T_world_camera.matrix() - pose.matrix()).norm(), 1e-6);
  for (const int frame : {0, 30, kRoomFrames - 1}) {
    ExpectDepthOfRoom(sequence, frame);
    ExpectColorOfRoom(sequence, frame);
  }
}

TEST_F(Sens, CheckNamesTheFormatAndFindsNothingWrong) {
  Write();
  const CheckReport report = CheckSequence(path(), NoProgress);
  EXPECT_EQ(report.format, "sens");
  EXPECT_TRUE(report.geometry.is_judged);
  EXPECT_TRUE(report.geometry.fits);
  EXPECT_EQ(report.image_sizes.depth_width, 80);
  EXPECT_FALSE(report.has_errors());
}

TEST_F(Sens, ReadsBarePixels) {
  sample.color_compression = 0;
  sample.depth_compression = 0;
  for (int i = 0; i < kRoomFrames; ++i) {
    const auto k = static_cast<size_t>(i);
    const Image<uint16_t>& depth = Room().thumbnails.depth[k];
    const Image<uint8_t>& grey = Room().thumbnails.grey[k];
    sample.frames[k].depth.assign(reinterpret_cast<const char*>(depth.data()), 2 * depth.size());
    sample.frames[k].color.clear();
    for (size_t p = 0; p < grey.size(); ++p) {  // red, green and blue differ
      for (const int shift : {0, 1, 2}) {
        sample.frames[k].color += static_cast<char>(grey.data()[p] + shift);
      }
    }
  }
  const Sequence sequence = Opened();
  ExpectDepthOfRoom(sequence, 7);
  const uint8_t value = Room().thumbnails.grey[7](3, 2);
  EXPECT_EQ(LoadColor(sequence, 7)(3, 2)[0], value);
  EXPECT_EQ(LoadColor(sequence, 7)(3, 2)[2], static_cast<uint8_t>(value + 2));
}

// Of depth and colour, in the base frame: T_color_depth leads from one to the other.
TEST_F(Sens, ComposesExtrinsics) {
  sample.extrinsic_depth[3] = 0.03f;
  sample.extrinsic_color[3] = 0.005f;
  const Sequence sequence = Opened();
  EXPECT_NEAR(sequence.T_color_depth.translation().x(), 0.025, 1e-7);
}

TEST_F(Sens, FramesThatWereLostHaveNoPose) {
  const float lost = -std::numeric_limits<float>::infinity();
  sample.frames[3].camera_to_world.fill(lost);
  sample.frames[4].camera_to_world.fill(0);
  const Sequence sequence = Opened();
  EXPECT_EQ(sequence.frame_count(), kRoomFrames - 2);
  EXPECT_EQ(sequence.frames_without_pose, 2);
  EXPECT_EQ(sequence.frames[3].name, "000005");
  for (SensSample::Frame& frame : sample.frames) frame.camera_to_world.fill(lost);
  const Sequence images = Opened(PoseUse::kIfGiven);
  EXPECT_FALSE(images.has_poses);
  EXPECT_EQ(images.frame_count(), kRoomFrames);
  EXPECT_THAT(OpenError(), HasSubstr("0 of 60 frames have a pose"));
}

TEST_F(Sens, IdentityEverywhereIsNoTrajectory) {
  for (SensSample::Frame& frame : sample.frames) frame.camera_to_world = sample.extrinsic_depth;
  EXPECT_FALSE(Opened(PoseUse::kIfGiven).has_poses);
}

TEST_F(Sens, StampsThatDoNotRiseAreNumbers) {
  for (SensSample::Frame& frame : sample.frames) frame.depth_stamp = frame.color_stamp = 0;
  const Sequence sequence = Opened();
  EXPECT_EQ(sequence.frames[5].timestamp, 5);
  EXPECT_EQ(sequence.frames[5].color_delay, 0);
}

TEST_F(Sens, FramesWithoutAnImageAreCounted) {
  sample.frames[2].color.clear();
  sample.frames[9].depth.clear();
  const Sequence sequence = Opened();
  EXPECT_EQ(sequence.frame_count(), kRoomFrames - 2);
  EXPECT_EQ(sequence.frames_without_partner, 2);
}

TEST_F(Sens, RefusesWhatItDoesNotDecode) {
  const SensSample good = sample;
  sample.depth_compression = 2;
  EXPECT_THAT(ErrorOfSample(), AllOf(HasSubstr("room.sens"), HasSubstr("Occipital")));
  sample = good;
  sample.depth_compression = 9;
  EXPECT_THAT(ErrorOfSample(), HasSubstr("depth has compression 9"));
  sample = good;
  sample.color_compression = -1;
  EXPECT_THAT(ErrorOfSample(), HasSubstr("colour has compression -1"));
  sample = good;
  sample.version = 3;
  EXPECT_THAT(ErrorOfSample(), HasSubstr("version 3"));
  sample = good;
  sample.sensor.assign(5000, 'x');
  EXPECT_THAT(ErrorOfSample(), HasSubstr("has 5000 bytes"));
  sample = good;
  sample.depth_shift = 0;
  EXPECT_THAT(ErrorOfSample(), HasSubstr("depth shift is 0"));
  sample = good;
  sample.depth_size = {100'000, 3};
  EXPECT_THAT(ErrorOfSample(), HasSubstr("100000x3"));
  sample = good;
  sample.intrinsic_color[0] = 0;
  EXPECT_THAT(ErrorOfSample(), HasSubstr("colour camera"));
  sample = good;
  sample.extrinsic_depth[5] = 2;
  EXPECT_THAT(ErrorOfSample(), HasSubstr("extrinsics of depth"));
}

TEST_F(Sens, NamesTheFrameThatIsDamaged) {
  const SensSample good = sample;
  sample.frames[17].depth = Deflated(std::string(80 * 60 * 2 - 2, 'x'));
  Write();
  const Sequence sequence = OpenSequence(path());
  EXPECT_THAT(MessageOf([&] { LoadDepth(sequence, 17); }),
              AllOf(HasSubstr("room.sens: depth image of frame 17"),
                    HasSubstr("2 bytes of pixels too few")));
  sample.frames[17].depth = Deflated(std::string(80 * 60 * 2 + 2, 'x'));
  Write();
  EXPECT_THROW(LoadDepth(OpenSequence(path()), 17), Error);
  sample.frames[17].depth = "no zlib stream, but long enough to hold an image of 80x60 pixels";
  Write();
  const CheckReport report = CheckSequence(path(), NoProgress);
  ASSERT_TRUE(report.has_errors());
  EXPECT_THAT(report.findings[0].message, HasSubstr("depth image of frame 17"));
  sample = good;
  sample.frames[17].color.resize(100);
  EXPECT_THAT(ErrorOfSample(),
              AllOf(HasSubstr("colour image of frame 17"), HasSubstr("is truncated")));
}

TEST_F(Sens, NamesTheFrameInWhichItEnds) {
  Write();
  const std::string bytes = sample.Bytes();
  size_t tail = 8;  // the list of IMU frames, which is not read
  for (size_t i = 50; i < sample.frames.size(); ++i) {
    tail += 96 + sample.frames[i].color.size() + sample.frames[i].depth.size();
  }
  WriteBytes(path(), bytes.substr(0, bytes.size() - tail + 40));
  EXPECT_THAT(OpenError(), HasSubstr("ends within frame 50 of 60"));
  EXPECT_EQ(CheckSequence(path(), NoProgress).frames, 50);
  for (const size_t size : {0, 3, 11, 20, 100, 300, 318}) {
    WriteBytes(path(), bytes.substr(0, size));
    EXPECT_THAT(OpenError(), HasSubstr("ends too early")) << size;
  }
}

TEST_F(Sens, AFolderThatHoldsOneNamesIt) {
  Write();
  EXPECT_THAT(MessageOf([&] { OpenSequence(folder()); }),
              AllOf(HasSubstr("did you mean"), HasSubstr("room.sens")));
}

TEST_F(Sens, RepairWritesAFolder) {
  for (SensSample::Frame& frame : sample.frames) {
    for (const size_t i : {3, 7, 11}) frame.camera_to_world[i] *= 1000;  // millimetres
  }
  Write();
  const CheckReport report = CheckSequence(path(), NoProgress);
  ASSERT_TRUE(report.geometry.correction.has_value());
  WriteRepairedSequence(*report.geometry.correction, folder() / "repaired");
  const Sequence repaired = OpenSequence(folder() / "repaired");
  EXPECT_EQ(repaired.format, "per-frame poses");
  ASSERT_EQ(repaired.frame_count(), kRoomFrames);
  ExpectDepthOfRoom(repaired, 12);
  ExpectColorOfRoom(repaired, 12);
}

}  // namespace
}  // namespace curvefusion
