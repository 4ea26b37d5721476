#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/distortion_keys.h"
#include "capture/json_fields.h"
#include "capture/readers/matroska.h"
#include "capture/readers/readers.h"
#include "capture/readers/recorded_images.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/json_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr double kMillimetreUnits = 1000;
constexpr const char* kCalibration = "calibration.json";
constexpr size_t kFourCcOffset = 16;  // of biCompression in a BITMAPINFOHEADER

// A camera of calibration.json: its values are shares of a calibration image, and count from the
// corner of the top-left pixel.
struct RawCamera {
  std::array<double, 14> parameters{};  // cx, cy, fx, fy, k1 ... k6, two centres, p2, p1
  std::string model;
  int width = 0, height = 0;  // of the sensor
  RigidTransform T_camera_depth = RigidTransform::Identity();
  std::string where;
};

// The part of a calibration image that a mode's images show.
struct Mode {
  int width, height;                          // of the images
  int calibration_width, calibration_height;  // of the calibration image at their scale
  int left, top;                              // where it begins
};

// Of the sensor SDK: narrow and wide field of view, each binned and not.
constexpr std::array<Mode, 4> kDepthModes = {{{320, 288, 512, 512, 96, 90},
                                              {640, 576, 1024, 1024, 192, 180},
                                              {512, 512, 512, 512, 0, 0},
                                              {1024, 1024, 1024, 1024, 0, 0}}};
// 4:3 shows all of the sensor, 16:9 its middle.
constexpr std::array<Mode, 6> kColorModes = {{{1280, 720, 1280, 960, 0, 120},
                                              {1920, 1080, 1920, 1440, 0, 180},
                                              {2560, 1440, 2560, 1920, 0, 240},
                                              {2048, 1536, 2048, 1536, 0, 0},
                                              {3840, 2160, 3840, 2880, 0, 360},
                                              {4096, 3072, 4096, 3072, 0, 0}}};

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

const MatroskaTrack& TrackOf(const fs::path& file, const MatroskaFile& recording,
                             const char* name) {
  std::vector<std::string> names;
  for (const MatroskaTrack& track : recording.tracks) {
    if (track.name == name && !track.frames.empty()) return track;
    names.push_back(track.name.empty() ? "one without a name" : track.name);
  }
  Fail(
      fmt::format("{}: has no track {} with images, as Azure Kinect records (it has {}); other "
                  "videos are unpacked into a folder first",
                  file.string(), name, fmt::join(names, ", ")));
}

// Empty where the track has none, or not in letters.
std::string FourCc(const MatroskaTrack& track) {
  if (track.codec != "V_MS/VFW/FOURCC" || track.codec_private.size() < kFourCcOffset + 4) return {};
  const std::string code = track.codec_private.substr(kFourCcOffset, 4);
  const bool is_text =
      std::all_of(code.begin(), code.end(), [](char c) { return c > ' ' && c < 127; });
  return is_text ? code : std::string();
}

PixelCoding CodingOf(const fs::path& file, const MatroskaTrack& track) {
  const std::string code = FourCc(track);
  const bool is_depth = track.name == "DEPTH";
  if (!track.is_encoded && is_depth && code == "b16g") return PixelCoding::kDepth16BigEndian;
  const bool is_jpeg = code == "MJPG" || track.codec == "V_MJPEG";  // the latter when copied
  if (!track.is_encoded && !is_depth && is_jpeg) return PixelCoding::kPngOrJpeg;
  if (!track.is_encoded && !is_depth && code == "BGRA") return PixelCoding::kBgra8;
  Fail(
      fmt::format("{}: the track {} is coded as '{}'{}; b16g is read for depth, MJPG and BGRA for "
                  "colour: record with k4arecorder --color-mode 1080p",
                  file.string(), track.name, code.empty() ? track.codec : code,
                  track.is_encoded ? ", compressed once more" : ""));
}

json ParseCalibration(const fs::path& file, const MatroskaFile& recording,
                      const std::string& where) {
  const auto found = recording.attachments.find(kCalibration);
  if (found == recording.attachments.end()) {
    Fail(fmt::format("{}: holds no {}, so the cameras are unknown", file.string(), kCalibration));
  }
  std::string_view text = found->second;
  while (text.ends_with('\0')) text.remove_suffix(1);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return ParseJson(std::string(text), where);
}

const json& Member(const json& object, const char* key, const std::string& where) {
  const auto found = object.find(key);
  if (!object.is_object() || found == object.end()) {
    Fail(fmt::format("{}: '{}' is missing", where, key));
  }
  return *found;
}

template <size_t kCount>
std::array<double, kCount> Numbers(const json& list, const std::string& where) {
  std::array<double, kCount> numbers{};
  if (!list.is_array() || list.size() < kCount) {
    Fail(fmt::format("{}: a list of {} numbers is needed", where, kCount));
  }
  for (size_t i = 0; i < kCount; ++i) {
    if (!list[i].is_number()) Fail(fmt::format("{}: {} is no number", where, list[i].dump()));
    numbers[i] = list[i].get<double>();
  }
  return numbers;
}

RigidTransform Extrinsics(const json& rt, const std::string& where) {
  const auto rotation = Numbers<9>(Member(rt, "Rotation", where), where + ": Rotation");
  const auto translation = Numbers<3>(Member(rt, "Translation", where), where + ": Translation");
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      matrix(row, column) = rotation[static_cast<size_t>(3 * row + column)];
    }
    matrix(row, 3) = translation[static_cast<size_t>(row)];
  }
  const auto fail = [](const CheckFinding& finding) { Fail(finding.message); };
  return *RigidFromMatrix(matrix, where, fail);
}

// The camera whose location ends in `location`: D0 is depth, PV0 colour.
RawCamera ParseCamera(const json& calibration, const char* location, const std::string& file) {
  const json& cameras =
      Member(Member(calibration, "CalibrationInformation", file), "Cameras", file);
  for (const json& camera : cameras) {
    const auto name = camera.find("Location");
    if (name == camera.end() || *name != std::string("CALIBRATION_CameraLocation") + location) {
      continue;
    }
    RawCamera raw;
    raw.where = fmt::format("{}: camera {}", file, location);
    const json& intrinsics = Member(camera, "Intrinsics", raw.where);
    raw.parameters = Numbers<14>(Member(intrinsics, "ModelParameters", raw.where), raw.where);
    const json& model = Member(intrinsics, "ModelType", raw.where);
    raw.model = model.is_string() ? model.get<std::string>() : model.dump();
    raw.width = JsonPixels(camera, "SensorWidth", raw.where);
    raw.height = JsonPixels(camera, "SensorHeight", raw.where);
    raw.T_camera_depth = Extrinsics(Member(camera, "Rt", raw.where), raw.where);
    return raw;
  }
  Fail(fmt::format("{}: holds no camera {}", file, location));
}

template <size_t kCount>
Mode ModeOf(const MatroskaTrack& track, const std::array<Mode, kCount>& modes,
            const fs::path& file) {
  for (const Mode& mode : modes) {
    if (mode.width == track.width && mode.height == track.height) return mode;
  }
  Fail(fmt::format("{}: images of {}x{} in the track {}, a size that Azure Kinect does not have",
                   file.string(), track.width, track.height, track.name));
}

PinholeCamera CameraOf(const RawCamera& raw, const Mode& mode) {
  const auto& p = raw.parameters;
  const double width = mode.calibration_width;
  const double height = mode.calibration_height;
  // The first calibrations were made in 16:9, which lacks an eighth of the height above and below.
  const bool is_wide = raw.width * 9 == raw.height * 16;
  const double shown = is_wide ? height * 3 / 4 : height;
  const PinholeCamera camera = {mode.width,
                                mode.height,
                                p[2] * width,
                                p[3] * shown,
                                p[0] * width - mode.left - 0.5,
                                p[1] * shown + (height - shown) / 2 - mode.top - 0.5};
  RequirePlausible(camera, raw.where);
  return camera;
}

// Both models are Brown and Conrady's with a denominator. The older one has other tangential terms
// and was made for devices that were never sold.
Distortion LensOf(const RawCamera& raw, const PinholeCamera& camera) {
  const auto& p = raw.parameters;
  if (raw.model != "CALIBRATION_LensDistortionModelBrownConrady" || p[10] != 0 || p[11] != 0) {
    Fail(
        fmt::format("{}: its lens model is {}, which is not undone here; Brown-Conrady is, which "
                    "all sold devices have",
                    raw.where, raw.model));
  }
  const Distortion distortion = {p[4], p[5], p[13], p[12], p[6], p[7], p[8], p[9]};
  RequireUnfolded(camera, distortion, raw.where);
  return distortion;
}

RecordedStream StreamOf(const fs::path& file, const MatroskaTrack& track) {
  RecordedStream stream;
  stream.name = track.name;
  const PixelCoding coding = CodingOf(file, track);
  for (const MatroskaFrame& frame : track.frames) {
    if (frame.bytes == 0) continue;
    const std::string name =
        fmt::format("image {} of the track {}", stream.images.size(), track.name);
    stream.images.push_back(
        {frame.time,
         frame.time,
         {frame.offset, frame.bytes, coding, track.width, track.height, name, {}}});
  }
  return stream;
}

}  // namespace

bool IsMkv(const fs::path& file) { return file.extension() == ".mkv"; }

bool HasMkvPoses(const fs::path& /*file*/) { return false; }

Sequence ReadAzureKinectImages(const fs::path& file, const FindingHandler& on_finding) {
  const MatroskaFile recording = ReadMatroska(file);
  if (!recording.defect.empty()) on_finding({Severity::kError, recording.defect});
  const MatroskaTrack& depth = TrackOf(file, recording, "DEPTH");
  const MatroskaTrack& color = TrackOf(file, recording, "COLOR");
  const std::string where = file.string() + ": " + kCalibration;
  const json calibration = ParseCalibration(file, recording, where);
  const RawCamera raw_depth = ParseCamera(calibration, "D0", where);
  const RawCamera raw_color = ParseCamera(calibration, "PV0", where);
  Sequence sequence;
  sequence.depth_scale = kMillimetreUnits;
  sequence.depth_camera = CameraOf(raw_depth, ModeOf(depth, kDepthModes, file));
  sequence.color_camera = CameraOf(raw_color, ModeOf(color, kColorModes, file));
  sequence.depth_distortion = LensOf(raw_depth, sequence.depth_camera);
  sequence.color_distortion = LensOf(raw_color, sequence.color_camera);
  sequence.T_color_depth = raw_color.T_camera_depth * raw_depth.T_camera_depth.inverse();
  AddRecordedFrames(file, StreamOf(file, depth), StreamOf(file, color), on_finding, sequence);
  return sequence;
}

Sequence ReadAzureKinect(const fs::path& file, const FindingHandler& /*on_finding*/) {
  Fail(
      fmt::format("{}: holds no camera poses; reconstruct finds them by tracking the camera "
                  "(curvefusion track does only that)",
                  file.string()));
}

}  // namespace curvefusion
