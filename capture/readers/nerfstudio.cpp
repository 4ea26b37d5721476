#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "capture/distortion_keys.h"
#include "capture/json_fields.h"
#include "capture/readers/frame_assembly.h"
#include "capture/readers/readers.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr double kDefaultDepthUnit = 1e-3;  // metres; nerfstudio's depth_unit_scale_factor
// Each may stand at the top or in every frame.
constexpr std::array<const char*, 15> kCameraKeys = {
    "w",  "h",  "fl_x",         "fl_y",           "cx",        "cy", "k1", "k2", "k3", "k4",
    "p1", "p2", "camera_model", "camera_angle_x", "is_fisheye"};

struct Lens {
  PinholeCamera camera;
  Distortion distortion;
};

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

double NumberOr(const json& object, const char* key, const std::string& where, double otherwise) {
  return object.contains(key) ? JsonNumber(object, key, where) : otherwise;
}

double FocalLength(const json& object, const std::string& where, int width) {
  if (object.contains("fl_x") || !object.contains("camera_angle_x")) {
    return JsonNumber(object, "fl_x", where);
  }
  return width / 2.0 / std::tan(JsonNumber(object, "camera_angle_x", where) / 2);
}

Lens ParseLens(const json& object, const std::string& where) {
  if (object.contains("is_fisheye") && object["is_fisheye"] == true) {
    Fail(where +
         ": 'is_fisheye' is true; undistort the images first (ns-process-data, or "
         "colmap image_undistorter)");
  }
  Lens lens;
  PinholeCamera& camera = lens.camera;
  camera.width = JsonPixels(object, "w", where);
  camera.height = JsonPixels(object, "h", where);
  camera.fx = FocalLength(object, where, camera.width);
  camera.fy = NumberOr(object, "fl_y", where, camera.fx);
  // Places in the image count from the corner of the top-left pixel there, here from its centre.
  camera.cx = NumberOr(object, "cx", where, camera.width / 2.0) - 0.5;
  camera.cy = NumberOr(object, "cy", where, camera.height / 2.0) - 0.5;
  RequirePlausible(camera, where);
  lens.distortion = ParseDistortion(object, camera, where);
  return lens;
}

// The keys at the top of the file, those of the frame put over them.
json CameraOf(const json& top, const json& frame) {
  json camera = json::object();
  for (const char* key : kCameraKeys) {
    if (frame.contains(key)) {
      camera[key] = frame[key];
    } else if (top.contains(key)) {
      camera[key] = top[key];
    }
  }
  return camera;
}

fs::path PathOf(const fs::path& folder, const json& frame, const char* key, const char* other_key,
                const std::string& where, const char* remedy) {
  for (const char* name : {key, other_key}) {
    const auto value = frame.find(name);
    if (value == frame.end()) continue;
    if (!value->is_string()) Fail(fmt::format("{}: '{}' is no text", where, name));
    return (folder / value->get<std::string>()).lexically_normal();
  }
  Fail(fmt::format("{}: '{}' is missing; {}", where, key, remedy));
}

// Names of colour images may lack the extension, which then is .png.
fs::path ColorPath(const fs::path& folder, const json& frame, const std::string& where) {
  fs::path path =
      PathOf(folder, frame, "file_path", "file_path", where, "it names the colour image");
  if (!path.has_extension()) path += ".png";
  return path;
}

fs::path DepthPath(const fs::path& folder, const json& frame, const std::string& where) {
  const fs::path path =
      PathOf(folder, frame, "depth_file_path", "depth_path", where,
             "CurveFusion needs a depth image for every frame; name a 16-bit PNG");
  if (path.extension() == ".png" || path.extension() == ".PNG") return path;
  Fail(fmt::format("{}: '{}' is no PNG; write depth as 16-bit grey PNG in millimetres", where,
                   path.string()));
}

// Camera axes of OpenGL (y up, looking along -z) to those here (y down, looking along +z).
std::optional<RigidTransform> PoseOf(const json& frame, const std::string& where,
                                     const FindingHandler& on_finding) {
  const auto value = frame.find("transform_matrix");
  if (value == frame.end()) Fail(where + ": 'transform_matrix' is missing");
  Eigen::Matrix4d matrix = JsonMatrix(*value, where + ": transform_matrix");
  matrix.block<4, 2>(0, 1) *= -1;
  return RigidFromMatrix(matrix, where + ": transform_matrix", on_finding);
}

// Whether no frame names a depth image.
bool HasColorOnly(const json& frames) {
  return std::none_of(frames.begin(), frames.end(), [](const json& frame) {
    return frame.contains("depth_file_path") || frame.contains("depth_path");
  });
}

double DepthScale(const json& top, const std::string& where) {
  for (const char* key : {"depth_unit_scale_factor", "integer_depth_scale"}) {
    if (!top.contains(key)) continue;
    const double unit = JsonNumber(top, key, where);
    if (!(unit > 0 && std::isfinite(1 / unit))) {
      Fail(
          fmt::format("{}: '{}' is {}; it is the number of metres in a unit of depth, .001 for "
                      "millimetres",
                      where, key, unit));
    }
    return 1 / unit;
  }
  return 1 / kDefaultDepthUnit;
}

void WarnOfScale(const json& top, const std::string& where, const FindingHandler& on_finding) {
  const double scale = NumberOr(top, "applied_scale", where, 1);
  if (scale == 1) return;
  on_finding(
      {Severity::kWarning,
       fmt::format("{}: 'applied_scale' is {:g}: the poses may not be in metres; `curvefusion "
                   "check` compares them with depth",
                   where, scale)});
}

void RequireSameLens(const Lens& first, const Lens& lens, const std::string& where) {
  const auto numbers = [](const Lens& l) {
    return std::array<double, 11>{static_cast<double>(l.camera.width),
                                  static_cast<double>(l.camera.height),
                                  l.camera.fx,
                                  l.camera.fy,
                                  l.camera.cx,
                                  l.camera.cy,
                                  l.distortion.k1,
                                  l.distortion.k2,
                                  l.distortion.p1,
                                  l.distortion.p2,
                                  l.distortion.k3};
  };
  if (numbers(first) == numbers(lens)) return;
  Fail(
      fmt::format("{}: its camera ({}x{}, f {:.6g}, {:.6g}) is not that of the first frame ({}x{}, "
                  "f {:.6g}, {:.6g}); CurveFusion takes one camera for all frames: leave the "
                  "others out or resample their images",
                  where, lens.camera.width, lens.camera.height, lens.camera.fx, lens.camera.fy,
                  first.camera.width, first.camera.height, first.camera.fx, first.camera.fy));
}

json ParseTransforms(const fs::path& path) {
  json top = ParseJson(ReadFile(path), path.string());
  if (!top.is_object()) Fail(path.string() + ": must be a JSON object");
  const auto frames = top.find("frames");
  if (frames == top.end() || !frames->is_array() || frames->empty()) {
    Fail(path.string() + ": 'frames' must be a list with a frame or more");
  }
  return top;
}

Sequence ReadWith(const fs::path& folder, bool with_poses, const FindingHandler& on_finding) {
  const fs::path path = folder / "transforms.json";
  const json top = ParseTransforms(path);
  Sequence sequence;
  sequence.depth_scale = DepthScale(top, path.string());
  WarnOfScale(top, path.string(), on_finding);
  sequence.has_depth = !HasColorOnly(top["frames"]);
  std::optional<Lens> lens;
  for (size_t i = 0; i < top["frames"].size(); ++i) {
    const json& frame = top["frames"][i];
    const std::string where = fmt::format("{}: frame {}", path.string(), i);
    if (!frame.is_object()) Fail(where + ": must be a JSON object");
    const Lens own = ParseLens(CameraOf(top, frame), where);
    if (!lens) lens = own;
    RequireSameLens(*lens, own, where);
    const fs::path color = ColorPath(folder, frame, where);
    const fs::path depth = sequence.has_depth ? DepthPath(folder, frame, where) : fs::path();
    const auto pose = with_poses ? PoseOf(frame, where, on_finding) : RigidTransform::Identity();
    if (pose) {
      sequence.frames.push_back({FrameName(color), 0, *pose, color, depth});
    } else {
      ++sequence.frames_without_pose;
    }
  }
  NumberByColorPath(sequence);
  sequence.color_camera = lens->camera;
  sequence.color_distortion = sequence.depth_distortion = lens->distortion;
  sequence.depth_camera =
      sequence.frames.empty() || !sequence.has_depth
          ? lens->camera
          : RegisteredDepthCamera(lens->camera, sequence.frames.front().depth_path);
  return sequence;
}

}  // namespace

bool HasTransforms(const fs::path& folder) { return fs::exists(folder / "transforms.json"); }

Sequence ReadNerfstudio(const fs::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, true, on_finding);
}

Sequence ReadNerfstudioImages(const fs::path& folder, const FindingHandler& on_finding) {
  return ReadWith(folder, false, on_finding);
}

}  // namespace curvefusion
