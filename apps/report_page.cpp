#include "apps/report_page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/page_curves.h"
#include "apps/page_parts.h"
#include "apps/preview.h"
#include "apps/run_account.h"

namespace curvefusion {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFrames = 6;            // that are shown
constexpr int kPreviewWidth = 1200;   // pixels
constexpr int kMaxPathPoints = 1000;  // of the camera's path
// Of all curves: 20 bytes each, and eight corners of a tube in the browser.
constexpr size_t kMaxPoints = 120'000;

Json VectorJson(const Vec3& v) {
  const auto rounded = [](double x) { return std::round(x * 1e6) / 1e6; };
  return {rounded(v.x()), rounded(v.y()), rounded(v.z())};
}

Json CameraPathJson(const Sequence& sequence) {
  Json path = Json::array();
  const int stride = (sequence.frame_count() + kMaxPathPoints - 1) / kMaxPathPoints;
  for (int frame = 0; frame < sequence.frame_count(); frame += stride) {
    const Vec3 p = sequence.frames[frame].T_world_camera.translation();
    for (int axis = 0; axis < 3; ++axis) {
      path.push_back(std::round(p[axis] / kMillimetre * 10) / 10);
    }
  }
  return path;
}

Json SettingsJson(const Config& config) {
  Json settings = Json::array();
  for (const OptionValue& option : ChangedOptions(config)) {
    settings.push_back({{"name", option.name},
                        {"value", option.value},
                        {"initial", option.initial},
                        {"unit", option.unit},
                        {"description", option.description}});
  }
  return settings;
}

Json FramesJson(const PagePictures& pictures) {
  Json frames = Json::array();
  for (const PageFrame& frame : pictures.frames) frames.push_back(FrameJson(frame));
  return frames;
}

Json PageData(const RunRecord& record, const PagePictures& pictures,
              const std::vector<std::string>& files) {
  const Reconstruction& reconstruction = record.reconstruction;
  const SkeletonGraph& uncertain = reconstruction.uncertain.graph;
  const double tolerance = DrawingTolerance(reconstruction.skeleton, uncertain, kMaxPoints);
  const Mat3 axes = MeanCameraAxes(reconstruction.sequence);
  const std::filesystem::path folder = record.sequence.folder.lexically_normal();
  return {{"format", "curvefusion-page"},
          {"version", 1},
          {"title", folder.has_filename() ? folder.filename().string()
                                          : folder.parent_path().filename().string()},
          {"nothing_found",
           reconstruction.skeleton.empty() ? Json(WhyNothing(reconstruction)) : Json()},
          {"report", ReportData(record)},
          {"tolerance_mm", tolerance / kMillimetre},
          {"up", VectorJson(axes.row(1))},
          {"towards_viewer", VectorJson(axes.row(2))},
          {"curves", DrawnCurves(reconstruction.skeleton, tolerance)},
          {"uncertain", DrawnCurves(uncertain, tolerance)},
          {"camera_path", CameraPathJson(reconstruction.sequence)},
          {"frames", FramesJson(pictures)},
          {"settings", SettingsJson(record.config)},
          {"files", files},
          {"preview", pictures.preview}};
}

// Nothing in it can end the element that holds it: "<" stands in texts only, as do escapes.
std::string ForScriptElement(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace

PagePictures MakePagePictures(const Reconstruction& reconstruction, const ColorImage& preview) {
  PagePictures pictures{JpegUrl(preview, kPreviewWidth), {}};
  const Sequence& sequence = reconstruction.sequence;
  const SkeletonGraph& shown =
      reconstruction.skeleton.empty() ? reconstruction.uncertain.graph : reconstruction.skeleton;
  for (const int frame : ShownFrames(shown, sequence, kFrames)) {
    pictures.frames.push_back(MakePageFrame(sequence, frame));
  }
  return pictures;
}

std::string ReportPage(const RunRecord& record, const PagePictures& pictures,
                       const std::vector<std::string>& files) {
  // Names of files need not be UTF-8.
  const std::string data =
      PageData(record, pictures, files).dump(-1, ' ', false, Json::error_handler_t::replace);
  return AssemblePage("report.html", ForScriptElement(data));
}

}  // namespace curvefusion
