#include "capture/check_json.h"

#include <nlohmann/json.hpp>

#include "capture/camera_json.h"

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
          {"has_depth", report.has_depth},
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

Json FramesJson(const std::vector<FrameStretch>& frames) {
  Json result = Json::array();
  for (const FrameStretch& stretch : frames) {
    result.push_back({{"first", stretch.first}, {"last", stretch.last}});
  }
  return result;
}

Json AmountJson(const std::optional<MistakeAmount>& amount) {
  return amount ? Json{{"value", amount->value}, {"unit", amount->unit}} : Json(nullptr);
}

// In the words of intrinsics.json.
Json ColourFitJson(const ColourCameraFit& fit) {
  if (!fit.measured) return nullptr;
  return {{"is_misregistered", fit.IsMisregistered()},
          {"displacement_px", fit.displacement_px},
          {"color_camera", CameraJson(fit.color_camera)},
          {"T_color_depth", RowsJson(fit.T_color_depth)}};
}

// All mistakes of a cause: their frames, and the amount, of which there is one.
Mistake MistakeOf(const std::string& cause, const std::vector<Mistake>& mistakes) {
  Mistake all{cause};
  for (const Mistake& mistake : mistakes) {
    if (cause.empty() || mistake.cause != cause) continue;
    all.frames.insert(all.frames.end(), mistake.frames.begin(), mistake.frames.end());
    if (!all.amount) all.amount = mistake.amount;
  }
  return all;
}

Json FindingsJson(const CheckReport& report) {
  Json result = Json::array();
  for (const CheckFinding& finding : report.findings) {
    const Mistake mistake = MistakeOf(finding.cause, report.geometry.mistakes);
    result.push_back({{"severity", finding.severity == Severity::kError ? "error" : "warning"},
                      {"cause", NamedJson(finding.cause)},
                      {"frames", FramesJson(mistake.frames)},
                      {"amount", AmountJson(mistake.amount)},
                      {"message", finding.message}});
  }
  return result;
}

}  // namespace

std::string CheckJson(const CheckReport& report) {
  const Json json = {
      {"format", "curvefusion-check"},   {"version", 1},
      {"usable", !report.has_errors()},  {"sequence_format", NamedJson(report.format)},
      {"figures", FiguresJson(report)},  {"colour_fit", ColourFitJson(report.colour_camera)},
      {"findings", FindingsJson(report)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace curvefusion
