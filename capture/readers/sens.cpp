#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "capture/json_fields.h"
#include "capture/readers/binary_fields.h"
#include "capture/readers/readers.h"
#include "capture/trajectory.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kVersion = 4;
constexpr std::uint64_t kMaxNameBytes = 4096;  // chosen: "StructureSensor" has 15
constexpr std::uint32_t kMaxSide = 65536;      // pixels, as in intrinsics.json
constexpr double kMicrosecond = 1e-6;          // of the stamps

using Matrix = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;

// The values of the format.
enum ColorCompression : std::int32_t { kRaw = 0, kPng = 1, kJpeg = 2 };
enum DepthCompression : std::int32_t { kRawUshort = 0, kZlibUshort = 1, kOcciUshort = 2 };

struct SensHeader {
  Matrix intrinsic_color, extrinsic_color, intrinsic_depth, extrinsic_depth;
  std::int32_t color_compression = 0, depth_compression = 0;
  std::uint32_t color_width = 0, color_height = 0, depth_width = 0, depth_height = 0;
  float depth_shift = 0;  // units per metre
  std::uint64_t frames = 0;
};

struct SensFrame {
  Matrix camera_to_world;
  std::uint64_t color_stamp = 0, depth_stamp = 0;
  std::uint64_t color_bytes = 0, depth_bytes = 0;
  std::uint64_t color_offset = 0;  // depth comes after it

  // Lost frames have -inf everywhere; the format's own reader takes zeros for the same.
  bool HasPose() const { return camera_to_world.allFinite() && !camera_to_world.isZero(0); }
};

[[noreturn]] void Fail(const fs::path& path, const std::string& message) {
  throw Error(ErrorKind::kBadInput, path.string() + ": " + message);
}

Matrix NextMatrix(BinaryFields& fields) {
  Matrix matrix;
  fields.Read(matrix.data(), 16 * sizeof(float));
  return matrix;
}

SensHeader ReadHeader(const fs::path& path, BinaryFields& fields) {
  const auto version = fields.Next<std::uint32_t>();
  if (version != kVersion) {
    Fail(path, fmt::format("is a .sens file of version {}, or none; version {} is read: export it "
                           "again with BundleFusion or ScanNet's tools",
                           version, kVersion));
  }
  const auto name_bytes = fields.Next<std::uint64_t>();
  if (name_bytes > kMaxNameBytes) {
    Fail(path, fmt::format("the name of its sensor has {} bytes; is it a .sens file?", name_bytes));
  }
  fields.Skip(name_bytes);
  SensHeader header;
  header.intrinsic_color = NextMatrix(fields);
  header.extrinsic_color = NextMatrix(fields);
  header.intrinsic_depth = NextMatrix(fields);
  header.extrinsic_depth = NextMatrix(fields);
  header.color_compression = fields.Next<std::int32_t>();
  header.depth_compression = fields.Next<std::int32_t>();
  header.color_width = fields.Next<std::uint32_t>();
  header.color_height = fields.Next<std::uint32_t>();
  header.depth_width = fields.Next<std::uint32_t>();
  header.depth_height = fields.Next<std::uint32_t>();
  header.depth_shift = fields.Next<float>();
  header.frames = fields.Next<std::uint64_t>();
  return header;
}

SensFrame NextFrame(BinaryFields& fields) {
  SensFrame frame;
  frame.camera_to_world = NextMatrix(fields);
  frame.color_stamp = fields.Next<std::uint64_t>();
  frame.depth_stamp = fields.Next<std::uint64_t>();
  frame.color_bytes = fields.Next<std::uint64_t>();
  frame.depth_bytes = fields.Next<std::uint64_t>();
  frame.color_offset = fields.position();
  fields.Skip(frame.color_bytes);
  fields.Skip(frame.depth_bytes);
  return frame;
}

// The frames without their images. A recording that is cut off has those before the cut.
std::vector<SensFrame> ReadFrames(const fs::path& path, const SensHeader& header,
                                  BinaryFields& fields, const FindingHandler& on_finding) {
  std::vector<SensFrame> frames;
  try {
    while (frames.size() < header.frames) frames.push_back(NextFrame(fields));
  } catch (const Error&) {
    on_finding(
        {Severity::kError, fmt::format("{}: ends within frame {} of {}; copy or record it again",
                                       path.string(), frames.size(), header.frames)});
  }
  return frames;
}

PixelCoding ColorCoding(const fs::path& path, const SensHeader& header) {
  switch (header.color_compression) {
    case kRaw:
      return PixelCoding::kRgb8;
    case kPng:
    case kJpeg:
      return PixelCoding::kPngOrJpeg;
    default:
      Fail(path, fmt::format("colour has compression {}; 0 (raw), 1 (PNG) and 2 (JPEG) are read",
                             header.color_compression));
  }
}

PixelCoding DepthCoding(const fs::path& path, const SensHeader& header) {
  switch (header.depth_compression) {
    case kRawUshort:
      return PixelCoding::kDepth16;
    case kZlibUshort:
      return PixelCoding::kDepth16Zlib;
    case kOcciUshort:
      Fail(path,
           "depth is compressed by Occipital's codec (occi_ushort), which only Occipital's own "
           "library decodes; write the recording again with zlib_ushort depth");
    default:
      Fail(path, fmt::format("depth has compression {}; 0 (raw) and 1 (zlib) are read",
                             header.depth_compression));
  }
}

PinholeCamera Camera(const Matrix& intrinsic, std::uint32_t width, std::uint32_t height,
                     const std::string& where) {
  if (width > kMaxSide || height > kMaxSide) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}x{} pixels; up to {} a side can be", where,
                                                  width, height, kMaxSide));
  }
  const PinholeCamera camera = {static_cast<int>(width), static_cast<int>(height), intrinsic(0, 0),
                                intrinsic(1, 1),         intrinsic(0, 2),          intrinsic(1, 2)};
  RequirePlausible(camera, where);
  return camera;
}

// From a camera to the base frame, which is the frame of the colour camera in most recordings.
RigidTransform Extrinsic(const Matrix& matrix, const std::string& where) {
  const auto fail = [](const CheckFinding& finding) {
    throw Error(ErrorKind::kBadInput, finding.message);
  };
  return *RigidFromMatrix(matrix.cast<double>(), where, fail);
}

void UseHeader(const fs::path& path, const SensHeader& header, Sequence& sequence) {
  const std::string name = path.string();
  sequence.color_camera = Camera(header.intrinsic_color, header.color_width, header.color_height,
                                 name + ": the colour camera");
  sequence.depth_camera = Camera(header.intrinsic_depth, header.depth_width, header.depth_height,
                                 name + ": the depth camera");
  sequence.T_color_depth =
      Extrinsic(header.extrinsic_color, name + ": extrinsics of colour").inverse() *
      Extrinsic(header.extrinsic_depth, name + ": extrinsics of depth");
  if (!(header.depth_shift > 0 && std::isfinite(header.depth_shift))) {
    Fail(path, fmt::format("its depth shift is {}; it is the number of depth units in a metre, "
                           "1000 for millimetres",
                           header.depth_shift));
  }
  sequence.depth_scale = header.depth_shift;
}

bool HasTimes(const std::vector<SensFrame>& frames) {
  const auto not_later = [](const SensFrame& a, const SensFrame& b) {
    return a.depth_stamp >= b.depth_stamp;
  };
  return std::adjacent_find(frames.begin(), frames.end(), not_later) == frames.end();
}

// Seconds from depth to colour; 0 where the two have clocks of their own.
double ColorDelay(const SensFrame& frame) {
  const double delay = kMicrosecond * (static_cast<double>(frame.color_stamp) -
                                       static_cast<double>(frame.depth_stamp));
  return std::abs(delay) <= kAssociationTolerance ? delay : 0;
}

// What all frames have in common.
struct FrameSettings {
  fs::path path;
  PixelCoding color_coding, depth_coding;
  bool has_times;
};

SequenceFrame FrameOf(const SensFrame& given, size_t index, const RigidTransform& pose,
                      const FrameSettings& settings, const Sequence& cameras) {
  SequenceFrame frame;
  frame.name = fmt::format("{:06}", index);
  frame.timestamp = settings.has_times ? kMicrosecond * static_cast<double>(given.depth_stamp)
                                       : static_cast<double>(index);
  frame.T_world_camera = pose;
  frame.color_path = frame.depth_path = settings.path;
  frame.color_delay = settings.has_times ? ColorDelay(given) : 0;
  const auto part = [&](std::uint64_t offset, std::uint64_t bytes, PixelCoding coding,
                        const PinholeCamera& camera, const char* kind) {
    return ImagePart{offset,       bytes,         coding,
                     camera.width, camera.height, fmt::format("{} image of frame {}", kind, index)};
  };
  frame.color_part = part(given.color_offset, given.color_bytes, settings.color_coding,
                          cameras.color_camera, "colour");
  frame.depth_part = part(given.color_offset + given.color_bytes, given.depth_bytes,
                          settings.depth_coding, cameras.depth_camera, "depth");
  return frame;
}

Sequence ReadWith(const fs::path& path, bool with_poses, const FindingHandler& on_finding) {
  BinaryFields fields(path);
  const SensHeader header = ReadHeader(path, fields);
  Sequence sequence;
  UseHeader(path, header, sequence);
  FrameSettings settings = {path, ColorCoding(path, header), DepthCoding(path, header), false};
  const std::vector<SensFrame> frames = ReadFrames(path, header, fields, on_finding);
  settings.has_times = HasTimes(frames);
  for (size_t i = 0; i < frames.size(); ++i) {
    const SensFrame& given = frames[i];
    const std::string where = fmt::format("{}: frame {}", path.string(), i);
    std::optional<RigidTransform> pose;
    if (!with_poses) pose = RigidTransform::Identity();
    if (with_poses && given.HasPose()) {
      pose = RigidFromMatrix(given.camera_to_world.cast<double>(), where, on_finding);
    }
    if (given.color_bytes == 0 || given.depth_bytes == 0) {
      ++sequence.frames_without_partner;
    } else if (!pose) {
      ++sequence.frames_without_pose;
    } else {
      sequence.frames.push_back(FrameOf(given, i, *pose, settings, sequence));
    }
  }
  return sequence;
}

}  // namespace

bool IsSens(const fs::path& file) { return file.extension() == ".sens"; }

bool HasSensPoses(const fs::path& file) {
  BinaryFields fields(file);
  const SensHeader header = ReadHeader(file, fields);
  const std::vector<SensFrame> frames =
      ReadFrames(file, header, fields, [](const CheckFinding&) {});
  // A recording that no tracker has seen has the identity everywhere.
  return std::any_of(frames.begin(), frames.end(), [](const SensFrame& frame) {
    return frame.HasPose() && !frame.camera_to_world.isIdentity(0);
  });
}

Sequence ReadSens(const fs::path& file, const FindingHandler& on_finding) {
  return ReadWith(file, true, on_finding);
}

Sequence ReadSensImages(const fs::path& file, const FindingHandler& on_finding) {
  return ReadWith(file, false, on_finding);
}

}  // namespace curvefusion
