#include "capture/intrinsics.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "capture/distortion_keys.h"
#include "capture/json_fields.h"
#include "capture/trajectory.h"
#include "kernel/error.h"
#include "kernel/json_input.h"
#include "kernel/text_input.h"

namespace curvefusion {

namespace {

using nlohmann::json;

[[noreturn]] void Fail(const std::string& message) { throw Error(ErrorKind::kBadInput, message); }

json ParseJsonObject(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) {
    Fail(
        fmt::format("{}: is missing; it must give the camera's width, height, focal lengths and "
                    "principal point",
                    path.string()));
  }
  json object = ParseJson(ReadFile(path), path.string());
  if (!object.is_object()) Fail(fmt::format("{}: must be a JSON object", path.string()));
  return object;
}

PinholeCamera ParseCamera(const json& object, const std::string& where) {
  PinholeCamera camera;
  camera.width = JsonPixels(object, "width", where);
  camera.height = JsonPixels(object, "height", where);
  camera.fx = JsonNumber(object, "fx", where);
  camera.fy = JsonNumber(object, "fy", where);
  camera.cx = JsonNumber(object, "cx", where);
  camera.cy = JsonNumber(object, "cy", where);
  RequirePlausible(camera, where);
  return camera;
}

RigidTransform ParseTransform(const json& value, const std::string& where) {
  return *RigidFromMatrix(JsonMatrix(value, where), where,
                          [](const CheckFinding& finding) { Fail(finding.message); });
}

std::optional<double> ParseDepthScale(const json& object, const std::string& where) {
  if (!object.contains("depth_scale")) return std::nullopt;
  const double scale = JsonNumber(object, "depth_scale", where);
  if (!(scale > 0)) {
    Fail(
        fmt::format("{}: depth_scale is {}; it is the number of depth units in a metre, 1000 for "
                    "millimetres",
                    where, scale));
  }
  return scale;
}

// The colour camera is the depth camera where the file names no other.
void ParseColourCamera(const json& object, const std::string& where,
                       const FindingHandler& on_finding, Intrinsics& intrinsics) {
  intrinsics.color_camera = intrinsics.depth_camera;
  intrinsics.color_distortion = intrinsics.depth_distortion;
  if (object.contains("color_camera")) {
    const json& camera = object["color_camera"];
    const std::string where_color = where + ": color_camera";
    intrinsics.color_camera = ParseCamera(camera, where_color);
    intrinsics.color_distortion = ParseDistortion(camera, intrinsics.color_camera, where_color);
    ReportUnknownKeys(camera, where_color, on_finding);
  }
  if (object.contains("T_color_depth")) {
    intrinsics.T_color_depth = ParseTransform(object["T_color_depth"], where + ": T_color_depth");
  }
}

Intrinsics ParseIntrinsics(const std::filesystem::path& path, const FindingHandler& on_finding) {
  const json object = ParseJsonObject(path);
  const std::string where = path.string();
  Intrinsics intrinsics;
  intrinsics.depth_camera = ParseCamera(object, where);
  intrinsics.depth_distortion = ParseDistortion(object, intrinsics.depth_camera, where);
  intrinsics.depth_scale = ParseDepthScale(object, where);
  ParseColourCamera(object, where, on_finding, intrinsics);
  ReportUnknownKeys(object, where, on_finding);
  return intrinsics;
}

Intrinsics ParseRedwoodIntrinsics(const std::filesystem::path& path,
                                  const FindingHandler& on_finding) {
  const json object = ParseJsonObject(path);
  const std::string where = path.string();
  const auto matrix = object.find("intrinsic_matrix");
  if (matrix == object.end() || !matrix->is_array() || matrix->size() != 9) {
    Fail(fmt::format("{}: 'intrinsic_matrix' must hold 9 numbers, column by column", where));
  }
  std::vector<double> m;
  for (const json& entry : *matrix) m.push_back(entry.is_number() ? entry.get<double>() : NAN);
  if (m[6] == 0 && m[7] == 0 && m[2] != 0) {
    Fail(
        fmt::format("{}: 'intrinsic_matrix' is written row by row; it must be column by column: "
                    "[fx,0,0, 0,fy,0, cx,cy,1]",
                    where));
  }
  Intrinsics intrinsics;
  intrinsics.depth_camera = {JsonPixels(object, "width", where),
                             JsonPixels(object, "height", where),
                             m[0],
                             m[4],
                             m[6],
                             m[7]};
  RequirePlausible(intrinsics.depth_camera, where);
  intrinsics.depth_distortion = ParseDistortion(object, intrinsics.depth_camera, where);
  intrinsics.depth_scale = ParseDepthScale(object, where);
  ParseColourCamera(object, where, on_finding, intrinsics);
  return intrinsics;
}

// Turns the first defect into a finding, so that a check can go on without cameras.
template <class Parse>
Intrinsics ReportDefect(const Parse& parse, const std::filesystem::path& path,
                        const FindingHandler& on_finding) {
  std::string message;
  try {
    return parse(path, on_finding);
  } catch (const Error& error) {
    message = error.what();
  }
  on_finding({Severity::kError, message});
  return {};
}

}  // namespace

Intrinsics ReadIntrinsics(const std::filesystem::path& path, const FindingHandler& on_finding) {
  return ReportDefect(ParseIntrinsics, path, on_finding);
}

Intrinsics ReadRedwoodIntrinsics(const std::filesystem::path& path,
                                 const FindingHandler& on_finding) {
  return ReportDefect(ParseRedwoodIntrinsics, path, on_finding);
}

}  // namespace curvefusion
