#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "capture/check.h"
#include "capture/content/repair.h"
#include "capture/readers/matroska.h"
#include "capture/sequence.h"
#include "kernel/error.h"
#include "kernel/progress.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/file_contents.h"
#include "tests/source_folder.h"

// No real recording is part of the project. The container is tried on a file that FFmpeg wrote,
// whose four letters for depth were put in afterwards, as FFmpeg writes none; recordings of the
// sizes of a camera are written here by RFC 9559 and by what Microsoft publishes of its recorder
// and calibration.

namespace curvefusion {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr int kDepthWidth = 320, kDepthHeight = 288;
constexpr int kColorWidth = 1280, kColorHeight = 720;

std::string Element(std::uint32_t id, const std::string& content, bool sized = true) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    if (id >> shift != 0) bytes += static_cast<char>(id >> shift);
  }
  bytes += '\x01';  // eight bytes of size, all ones where it is unknown
  for (int shift = 48; shift >= 0; shift -= 8) {
    bytes +=
        sized ? static_cast<char>(static_cast<std::uint64_t>(content.size()) >> shift) : '\xff';
  }
  return bytes + content;
}

std::string Number(std::uint32_t id, std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
  return Element(id, bytes);
}

std::string Track(int number, const std::string& name, const std::string& code, int width,
                  int height) {
  std::string header(40, '\0');  // BITMAPINFOHEADER
  header.replace(16, 4, code);
  return Element(0xAE, Number(0xD7, static_cast<std::uint32_t>(number)) + Element(0x536E, name) +
                           Element(0x86, "V_MS/VFW/FOURCC") + Element(0x63A2, header) +
                           Element(0xE0, Number(0xB0, static_cast<std::uint32_t>(width)) +
                                             Number(0xBA, static_cast<std::uint32_t>(height))));
}

std::string Block(int track, int milliseconds, const std::string& frame) {
  return Element(0xA3,
                 std::string{static_cast<char>(0x80 | track), static_cast<char>(milliseconds >> 8),
                             static_cast<char>(milliseconds), '\0'} +
                     frame);
}

json Camera(const char* location, const std::vector<double>& parameters, int width, int height,
            const std::vector<double>& translation) {
  return {{"Intrinsics",
           {{"ModelParameterCount", 14},
            {"ModelParameters", parameters},
            {"ModelType", "CALIBRATION_LensDistortionModelBrownConrady"}}},
          {"Location", std::string("CALIBRATION_CameraLocation") + location},
          {"Rt", {{"Rotation", {1, 0, 0, 0, 1, 0, 0, 0, 1}}, {"Translation", translation}}},
          {"SensorWidth", width},
          {"SensorHeight", height}};
}

// The lens of a wide depth camera, and one that is nearly none.
const std::vector<double> kDepthParameters = {
    0.51, 0.5, 0.4935, 0.4937, 0.436, 0.0683, 0.0044, 0.773, 0.148, 0.02, 0, 0, -8.9e-05, 6.4e-05};
const std::vector<double> kColorParameters = {0.5, 0.48, 0.473, 0.63, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0};

std::uint16_t RawDepth(int frame, int u, int v) {
  return static_cast<std::uint16_t>(700 + 10 * frame + u + v);
}

class AzureKinect : public testing::Test {
 protected:
  AzureKinect() {
    calibration["CalibrationInformation"]["Cameras"] = {
        Camera("D0", kDepthParameters, 1024, 1024, {0, 0, 0}),
        Camera("PV0", kColorParameters, 4096, 3072, {-0.032, -0.002, 0.004})};
    cv::Mat image(kColorHeight, kColorWidth, CV_8UC3, cv::Scalar(50, 100, 200));
    std::vector<uint8_t> bytes;
    cv::imencode(".jpg", image, bytes);
    color = {bytes.begin(), bytes.end()};
  }

  std::string Bytes() const {
    std::string clusters;
    for (int i = 0; i < 3; ++i) {
      std::string depth;
      for (int v = 0; v < kDepthHeight; ++v) {
        for (int u = 0; u < kDepthWidth; ++u) {
          depth += static_cast<char>(RawDepth(i, u, v) >> 8);
          depth += static_cast<char>(RawDepth(i, u, v));
        }
      }
      std::string content = Number(0xE7, static_cast<std::uint32_t>(1000 + 33 * i));
      if (i != lost_color) content += Block(1, -2, color);
      clusters += Element(0x1F43B675, content + Block(2, 0, depth), sized);
    }
    const std::string file =
        Element(0x466E, "calibration.json") + Element(0x465C, calibration.dump() + '\0');
    return Element(0x1A45DFA3, Element(0x4282, "matroska")) +
           Element(0x18538067,
                   Element(0x1549A966, Number(0x2AD7B1, 1000000)) +
                       Element(0x1654AE6B,
                               Track(1, "COLOR", color_code, kColorWidth, kColorHeight) +
                                   Track(2, "DEPTH", depth_code, kDepthWidth, kDepthHeight)) +
                       Element(0x1941A469, Element(0x61A7, file)) + clusters,
                   sized);
  }

  fs::path Written(const std::string& bytes) const {
    std::ofstream(folder_.path() / "scan.mkv", std::ios::binary) << bytes;
    return folder_.path() / "scan.mkv";
  }
  Sequence Opened() const { return OpenSequence(Written(Bytes()), PoseUse::kIfGiven); }
  std::string ErrorOf(const std::string& bytes) const {
    try {
      OpenSequence(Written(bytes), PoseUse::kIfGiven);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
      return error.what();
    }
    return "no error";
  }

  json calibration;
  std::string color;
  std::string color_code = "MJPG", depth_code = "b16g";
  int lost_color = -1;
  bool sized = true;  // whether segment and clusters tell their sizes

 private:
  TemporaryFolder folder_;
};

// The numbers of the sensor SDK for 320x288 and 1280x720.
TEST_F(AzureKinect, CamerasAreThoseOfTheMode) {
  const Sequence sequence = Opened();
  EXPECT_EQ(sequence.format, "azure kinect mkv");
  EXPECT_FALSE(sequence.has_poses);
  EXPECT_EQ(sequence.depth_scale, 1000);
  EXPECT_EQ(sequence.depth_camera.width, kDepthWidth);
  EXPECT_NEAR(sequence.depth_camera.fx, 0.4935 * 512, 1e-9);
  EXPECT_NEAR(sequence.depth_camera.cx, 0.51 * 512 - 96 - 0.5, 1e-9);
  EXPECT_NEAR(sequence.depth_camera.cy, 0.5 * 512 - 90 - 0.5, 1e-9);
  EXPECT_NEAR(sequence.color_camera.fy, 0.63 * 960, 1e-9);
  EXPECT_NEAR(sequence.color_camera.cy, 0.48 * 960 - 120 - 0.5, 1e-9);
  EXPECT_EQ(sequence.depth_distortion.k4, 0.773);
  EXPECT_EQ(sequence.depth_distortion.p1, 6.4e-05);
  EXPECT_EQ(sequence.depth_distortion.p2, -8.9e-05);
  EXPECT_TRUE(sequence.color_distortion.IsZero());
  EXPECT_NEAR(sequence.T_color_depth.translation().x(), -0.032, 1e-12);
  ASSERT_EQ(sequence.frame_count(), 3);
  EXPECT_NEAR(sequence.frames[1].timestamp, 1.033, 1e-9);
  EXPECT_NEAR(sequence.frames[1].color_delay, -0.002, 1e-9);
}

// A calibration of 16:9 shows the middle of the same sensor.
TEST_F(AzureKinect, OldCalibrationsAreWide) {
  json& camera = calibration["CalibrationInformation"]["Cameras"][1];
  camera["SensorHeight"] = 2304;
  const Sequence sequence = Opened();
  EXPECT_NEAR(sequence.color_camera.fy, 0.63 * 720, 1e-9);
  EXPECT_NEAR(sequence.color_camera.cy, 0.48 * 720 - 0.5, 1e-9);
}

TEST_F(AzureKinect, DepthIsThatOfAPinhole) {
  const Sequence sequence = Opened();
  const PinholeCamera& camera = sequence.depth_camera;
  const DepthImage depth = LoadDepth(sequence, 2);
  for (int v = 20; v < kDepthHeight - 20; v += 31) {
    for (int u = 20; u < kDepthWidth - 20; u += 31) {
      const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
      const double r = x * x + y * y;
      const auto& k = kDepthParameters;
      const double d = (1 + k[4] * r + k[5] * r * r + k[6] * r * r * r) /
                       (1 + k[7] * r + k[8] * r * r + k[9] * r * r * r);
      const double seen_x = x * d + (r + 2 * x * x) * k[12] + 2 * x * y * k[13];
      const double seen_y = y * d + (r + 2 * y * y) * k[13] + 2 * x * y * k[12];
      const double expected =
          1e-3 * (720 + camera.fx * seen_x + camera.cx + camera.fy * seen_y + camera.cy);
      EXPECT_NEAR(depth(u, v), expected, 1.01e-3) << u << " " << v;  // half a pixel in both
    }
  }
}

TEST_F(AzureKinect, ColoursWithoutDepthAreCountedAndSizesMayBeUnknown) {
  lost_color = 1;
  sized = false;
  const Sequence sequence = Opened();
  EXPECT_EQ(sequence.frame_count(), 2);
  EXPECT_EQ(sequence.frames_without_partner, 1);
  EXPECT_NEAR(LoadColor(sequence, 1)(640, 360)[0], 200, 3);  // JPEG is lossy
}

TEST_F(AzureKinect, CheckNamesTheFormatAndACopyHasTheLens) {
  const fs::path path = Written(Bytes());
  const CheckReport report = CheckSequence(path, NoProgress);
  EXPECT_EQ(report.format, "azure kinect mkv");
  EXPECT_FALSE(report.has_errors());
  SequenceCorrection copy;
  copy.sequence = OpenSequence(path, PoseUse::kIfGiven);
  WriteRepairedSequence(copy, path.parent_path() / "copy");
  const Sequence sequence = OpenSequence(path.parent_path() / "copy", PoseUse::kIgnored);
  EXPECT_EQ(sequence.depth_distortion.k6, 0.02);
  EXPECT_EQ(sequence.frames[0].color_path.extension(), ".jpg");
  EXPECT_EQ(LoadDepth(sequence, 1)(100, 100), LoadDepth(copy.sequence, 1)(100, 100));
}

TEST_F(AzureKinect, NamesWhatIsWrong) {
  const json good = calibration;
  json& cameras = calibration["CalibrationInformation"]["Cameras"];
  cameras[0]["Intrinsics"]["ModelType"] = "CALIBRATION_LensDistortionModelRational6KT";
  EXPECT_THAT(ErrorOf(Bytes()), AllOf(HasSubstr("camera D0"), HasSubstr("Rational6KT")));
  calibration = good;
  calibration["CalibrationInformation"]["Cameras"][1]["Location"] = "elsewhere";
  EXPECT_THAT(ErrorOf(Bytes()), HasSubstr("no camera PV0"));
  calibration = good;
  calibration["CalibrationInformation"]["Cameras"][0]["Intrinsics"]["ModelParameters"] = {1, 2};
  EXPECT_THAT(ErrorOf(Bytes()), HasSubstr("14 numbers"));
  calibration = "no object";
  EXPECT_THAT(ErrorOf(Bytes()), HasSubstr("'CalibrationInformation' is missing"));
  calibration = good;
  color_code = "NV12";
  EXPECT_THAT(ErrorOf(Bytes()), AllOf(HasSubstr("track COLOR"), HasSubstr("'NV12'")));
  color_code = "MJPG";
  std::string bytes = Bytes();
  bytes.replace(bytes.find("calibration.json"), 16, "calibration.text");
  EXPECT_THAT(ErrorOf(bytes), HasSubstr("holds no calibration.json"));
  bytes = Bytes();
  bytes.replace(bytes.find("DEPTH"), 5, "INFRA");
  EXPECT_THAT(ErrorOf(bytes), AllOf(HasSubstr("no track DEPTH"), HasSubstr("INFRA")));
  EXPECT_THAT(ErrorOf("RIFF, an AVI file"), HasSubstr("no Matroska file"));
  EXPECT_THAT(ErrorOf(Bytes().substr(0, Bytes().size() - 1000)), HasSubstr("ends too early"));
}

TEST_F(AzureKinect, AnyByteHasAnAnswer) {
  const std::string good = Bytes();
  for (size_t at = 0; at < 3000; at += 7) {  // up to the first images
    std::string bytes = good;
    bytes[at] = static_cast<char>(~bytes[at]);
    ErrorOf(bytes);
  }
}

TEST(Matroska, ReadsWhatFfmpegWrites) {
  const fs::path path = SourceFolder() / "tests/fuzz/corpus/mkv/ffmpeg.mkv";
  const MatroskaFile file = ReadMatroska(path);
  EXPECT_EQ(file.defect, "");
  ASSERT_GE(file.tracks.size(), 2u);
  EXPECT_EQ(file.tracks[0].name, "COLOR");
  EXPECT_EQ(file.tracks[0].codec, "V_MJPEG");
  EXPECT_EQ(file.tracks[0].width, 20);
  EXPECT_EQ(file.tracks[1].name, "DEPTH");
  EXPECT_EQ(file.tracks[1].height, 12);
  ASSERT_EQ(file.tracks[1].frames.size(), 3u);
  EXPECT_NEAR(file.tracks[1].frames[2].time, 0.067, 1e-9);  // milliseconds
  EXPECT_EQ(file.attachments.count("calibration.json"), 1u);
  const std::string bytes = FileText(path);
  const MatroskaFrame& frame = file.tracks[1].frames[1];
  ASSERT_EQ(frame.bytes, 16u * 12 * 2);
  EXPECT_EQ(static_cast<uint8_t>(bytes[frame.offset]) * 256 +
                static_cast<uint8_t>(bytes[frame.offset + 1]),
            600);
  EXPECT_EQ(static_cast<uint8_t>(bytes[file.tracks[0].frames[0].offset]), 0xff);  // of a JPEG
}

}  // namespace
}  // namespace curvefusion
