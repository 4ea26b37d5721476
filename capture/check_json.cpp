#include "capture/check_json.h"

#include <nlohmann/json.hpp>

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

Json SizeJson(int width, int height) {
  return width > 0 ? Json{{"width", width}, {"height", height}} : Json(nullptr);
}

Json KnownJson(double value) { return value > 0 ? Json(value) : Json(nullptr); }

Json NamedJson(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json FiguresJson(const CheckReport& report) {
  const ImageSizes& sizes = report.image_sizes;
  return {{"frames", report.frames},
          {"has_poses", report.has_poses},
          {"frames_without_pose", report.frames_without_pose},
          {"frames_without_partner", report.frames_without_partner},
          {"depth_size", SizeJson(sizes.depth_width, sizes.depth_height)},
          {"color_size", SizeJson(sizes.color_width, sizes.color_height)},
          {"depth_scale", KnownJson(report.depth_scale)},
          {"median_depth", KnownJson(report.median_depth)},
          {"depth_validity", report.depth_validity},
          {"trajectory_length", report.has_poses ? Json(report.trajectory_length) : Json(nullptr)},
          {"duration", KnownJson(report.duration)}};
}

Json FindingsJson(const std::vector<CheckFinding>& findings) {
  Json result = Json::array();
  for (const CheckFinding& finding : findings) {
    result.push_back({{"severity", finding.severity == Severity::kError ? "error" : "warning"},
                      {"cause", NamedJson(finding.cause)},
                      {"message", finding.message}});
  }
  return result;
}

}  // namespace

std::string CheckJson(const CheckReport& report) {
  const Json json = {
      {"format", "curvefusion-check"},  {"version", 1},
      {"usable", !report.has_errors()}, {"sequence_format", NamedJson(report.format)},
      {"figures", FiguresJson(report)}, {"findings", FindingsJson(report.findings)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace curvefusion
