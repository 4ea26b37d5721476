#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "capture/distortion_keys.h"
#include "capture/json_fields.h"
#include "capture/readers/bag_file.h"
#include "capture/readers/readers.h"
#include "capture/readers/recorded_images.h"
#include "capture/readers/ros_messages.h"
#include "kernel/error.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxMessage = 4096;  // chosen: bytes of a camera's or transform's message
constexpr double kDefaultUnit = 1e-3;        // metres; what RealSense cameras are set to
constexpr size_t kMaxNamedTopics = 8;        // chosen: a message of some lines

// What one camera, depth or colour, has written.
struct Stream : RecordedStream {  // its name is the prefix of its topics
  std::optional<RosCamera> camera;
  std::map<std::string, RigidTransform> T_stream_reference;  // by the name of the reference
};

struct Recording {
  Stream depth, color;
  std::optional<float> depth_unit;  // metres, of the sensor's option
  std::optional<float> image_unit;  // the same, of the first depth image
  std::set<std::string> topics;
};

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

bool IsTopicOf(const std::string& topic, const char* camera) {
  return topic.starts_with("/device_") && topic.find(camera) != std::string::npos;
}

PixelCoding CodingOf(const RosImage& image, const std::string& where) {
  const std::map<std::string, PixelCoding> codings = {
      {"mono16", PixelCoding::kDepth16}, {"16UC1", PixelCoding::kDepth16},
      {"rgb8", PixelCoding::kRgb8},      {"bgr8", PixelCoding::kBgr8},
      {"rgba8", PixelCoding::kRgba8},    {"bgra8", PixelCoding::kBgra8},
      {"mono8", PixelCoding::kGrey8},    {"8UC1", PixelCoding::kGrey8}};
  const auto coding = codings.find(image.encoding);
  if (coding != codings.end() && !image.is_big_endian) return coding->second;
  Fail(fmt::format("{}: its pixels are '{}'{}; record depth as Z16 and colour as RGB8", where,
                   image.encoding, image.is_big_endian ? ", big-endian" : ""));
}

// The image of a message without its pixels. `unit` takes the metres that RealSense writes behind
// the pixels of depth, in messages that say so by the frame name "1".
RecordedImage ParseImage(const BagMessage& message, double time, const std::string& name,
                         const std::string& where, float* unit) {
  const RosImage image = ParseRosImage(message.Read(0, kMaxRosImageHead), where);
  RecordedImage recorded = {image.stamp, time, {}};
  ImagePart& part = recorded.part;
  part = {message.offset() + image.pixel_offset,
          image.pixel_bytes,
          CodingOf(image, where),
          image.width,
          image.height,
          name,
          message.chunk()};
  const std::uint64_t end = image.pixel_offset + image.pixel_bytes;
  if (image.pixel_bytes == 0 || end > message.bytes()) Fail(where + ": its pixels are missing");
  const std::string defect = RawDefect(part);
  if (!defect.empty()) Fail(where + ": " + defect);
  if (unit != nullptr && message.bytes() == end + sizeof(float)) {
    *unit = ParseFloat(message.Read(end, sizeof(float)), where);
  }
  return recorded;
}

void UseStreamMessage(const std::string& file, const std::string& topic, double time,
                      const BagMessage& message, const char* kind, Stream& stream, float* unit) {
  const std::string prefix = topic.substr(0, topic.find('/', topic.rfind(kind)));
  if (stream.name.empty()) stream.name = prefix;
  if (prefix != stream.name) return;  // a second camera
  const std::string part = topic.substr(prefix.size());
  if (part == "/image/data") {
    const std::string name = fmt::format("{} image {}", kind, stream.images.size());
    stream.images.push_back(
        ParseImage(message, time, name, fmt::format("{}: {}", file, name), unit));
  } else if (part == "/info/camera_info") {
    stream.camera = ParseCameraInfo(message.Read(0, kMaxMessage), file + ": " + topic);
  } else if (part.starts_with("/tf/")) {
    stream.T_stream_reference[part] =
        ParseTransform(message.Read(0, kMaxMessage), file + ": " + topic);
  }
}

void UseMessage(const std::string& file, const std::string& topic, double time,
                const BagMessage& message, Recording& recording) {
  recording.topics.insert(topic);
  if (IsTopicOf(topic, "/Depth_0/")) {
    float unit = 0;
    UseStreamMessage(file, topic, time, message, "Depth_0", recording.depth, &unit);
    if (unit > 0 && !recording.image_unit) recording.image_unit = unit;
  } else if (IsTopicOf(topic, "/Color_0/")) {
    UseStreamMessage(file, topic, time, message, "Color_0", recording.color, nullptr);
  } else if (IsTopicOf(topic, "/option/Depth_Units/value") && !recording.depth_unit) {
    recording.depth_unit = ParseFloat(message.Read(0, kMaxMessage), file + ": " + topic);
  }
}

// A bag that is cut off has the messages before the cut.
Recording ReadRecording(const fs::path& file, const FindingHandler& on_finding) {
  Recording recording;
  std::string defect;
  try {
    ReadBag(file, [&](const std::string& topic, double time, const BagMessage& message) {
      UseMessage(file.string(), topic, time, message, recording);
    });
  } catch (const Error& error) {
    if (recording.depth.images.empty()) throw;
    defect = error.what();
  }
  if (!defect.empty()) on_finding({Severity::kError, defect});
  return recording;
}

void RequireStream(const fs::path& file, const Recording& recording, const Stream& stream,
                   const char* kind) {
  if (stream.images.empty()) {
    std::vector<std::string> topics(recording.topics.begin(), recording.topics.end());
    const bool has_more = topics.size() > kMaxNamedTopics;
    if (has_more) topics.resize(kMaxNamedTopics);
    Fail(
        fmt::format("{}: holds no {} images of a RealSense camera (topic "
                    "/device_0/sensor_N/{}_0/image/data); it holds {}{}; bags of other cameras are "
                    "exported to a folder first",
                    file.string(), kind, kind,
                    topics.empty() ? "nothing" : fmt::format("{}", fmt::join(topics, ", ")),
                    has_more ? " and more" : ""));
  }
  if (!stream.camera) {
    Fail(fmt::format("{}: the topic {}/info/camera_info is missing, so the camera is unknown",
                     file.string(), stream.name));
  }
}

// Coefficients in the order of OpenCV. Projecting by RealSense's "modified" and "inverse" models
// differs from Brown and Conrady's only in tangential terms of the fourth order, which are left out.
Distortion LensOf(const RosCamera& camera, const std::string& where) {
  const std::vector<double>& c = camera.coefficients;
  if (std::all_of(c.begin(), c.end(), [](double value) { return value == 0; })) return {};
  const std::set<std::string> known = {"Brown Conrady", "Modified Brown Conrady",
                                       "Inverse Brown Conrady", "plumb_bob"};
  if (!known.contains(camera.lens) || c.size() != 5) {
    Fail(
        fmt::format("{}: its lens model is '{}' with {} coefficients, which is not undone here; "
                    "record rectified images",
                    where, camera.lens, c.size()));
  }
  if (!std::all_of(c.begin(), c.end(), [](double value) { return std::isfinite(value); })) {
    Fail(where + ": its lens coefficients are not finite");
  }
  const Distortion distortion = {c[0], c[1], c[2], c[3], c[4]};
  RequireUnfolded(camera.camera, distortion, where);
  return distortion;
}

// Both transforms lead from a frame they have in common.
RigidTransform ColorFromDepth(const fs::path& file, const Recording& recording,
                              const FindingHandler& on_finding) {
  for (const auto& [reference, T_depth_reference] : recording.depth.T_stream_reference) {
    const auto color = recording.color.T_stream_reference.find(reference);
    if (color == recording.color.T_stream_reference.end()) continue;
    return color->second * T_depth_reference.inverse();
  }
  on_finding({Severity::kWarning,
              fmt::format("{}: holds no extrinsics of depth and colour (topics {}/tf/0 and "
                          "{}/tf/0); both cameras are taken to be at one place, as after aligning",
                          file.string(), recording.depth.name, recording.color.name)});
  return RigidTransform::Identity();
}

double DepthUnit(const fs::path& file, const Recording& recording,
                 const FindingHandler& on_finding) {
  const std::optional<float> unit =
      recording.image_unit ? recording.image_unit : recording.depth_unit;
  if (!unit) {
    on_finding({Severity::kWarning,
                fmt::format("{}: does not say its depth unit; 1 mm is assumed", file.string())});
    return kDefaultUnit;
  }
  // The number that was meant: .001, not the float next to it.
  const double metres = ParseNumber(fmt::format("{}", *unit)).value_or(0);
  if (metres > 0 && std::isfinite(metres) && std::isfinite(1 / metres)) return metres;
  Fail(fmt::format("{}: its depth unit is {} m", file.string(), *unit));
}

void UseCameras(const fs::path& file, const Recording& recording, const FindingHandler& on_finding,
                Sequence& sequence) {
  const auto use = [&](const Stream& stream, PinholeCamera& camera, Distortion& distortion) {
    const std::string where = fmt::format("{}: {}/info/camera_info", file.string(), stream.name);
    camera = stream.camera->camera;
    RequirePlausible(camera, where);
    distortion = LensOf(*stream.camera, where);
  };
  use(recording.depth, sequence.depth_camera, sequence.depth_distortion);
  use(recording.color, sequence.color_camera, sequence.color_distortion);
  sequence.T_color_depth = ColorFromDepth(file, recording, on_finding);
  sequence.depth_scale = 1 / DepthUnit(file, recording, on_finding);
}

}  // namespace

bool IsBag(const fs::path& file) { return file.extension() == ".bag"; }

bool HasBagPoses(const fs::path& /*file*/) { return false; }

Sequence ReadRealSenseImages(const fs::path& file, const FindingHandler& on_finding) {
  Recording recording = ReadRecording(file, on_finding);
  RequireStream(file, recording, recording.depth, "Depth");
  RequireStream(file, recording, recording.color, "Color");
  Sequence sequence;
  UseCameras(file, recording, on_finding, sequence);
  AddRecordedFrames(file, std::move(recording.depth), std::move(recording.color), on_finding,
                    sequence);
  return sequence;
}

Sequence ReadRealSense(const fs::path& file, const FindingHandler& /*on_finding*/) {
  Fail(
      fmt::format("{}: holds no camera poses; reconstruct finds them by tracking the camera "
                  "(curvefusion track does only that)",
                  file.string()));
}

}  // namespace curvefusion
