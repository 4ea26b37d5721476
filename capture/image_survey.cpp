#include "capture/image_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "capture/image_file.h"

namespace curvefusion {

namespace {

constexpr double kMinMedianDepth = 0.1;  // metres
constexpr double kMaxMedianDepth = 10;
constexpr size_t kMaxNamedFiles = 5;
constexpr size_t kDepthStride = 61;  // prime: no image width puts all samples into few columns

// Files by what is wrong with them.
using Defects = std::map<std::string, std::vector<std::string>>;

void ReportDefects(const Defects& defects, const FindingHandler& on_finding) {
  for (const auto& [defect, files] : defects) {
    std::string names = files[0];
    for (size_t i = 1; i < std::min(files.size(), kMaxNamedFiles); ++i) names += ", " + files[i];
    if (files.size() > kMaxNamedFiles) {
      names += fmt::format(" and {} more", files.size() - kMaxNamedFiles);
    }
    on_finding({Severity::kError, names + ": " + defect});
  }
}

// Adds a header to the survey of its kind; `first` is the first readable header of the kind.
void Examine(const std::filesystem::path& path, const ImagePart& part, bool is_depth,
             ImageHeader& first, Defects& defects) {
  const ImageHeader header = ReadImageHeader(path, part);
  const std::string name = ImageName(path, part);
  if (!header.defect.empty()) {
    defects[fmt::format("{}; {}", header.defect, kUnreadableImageRemedy)].push_back(name);
    return;
  }
  if (is_depth && (header.bits != 16 || header.channels != 1)) {
    defects[fmt::format("has {} bits and {} channels, depth needs 16 bits and one channel; export "
                        "the depth again as 16-bit PNG",
                        header.bits, header.channels)]
        .push_back(name);
  }
  if (first.width == 0) first = header;
  if (header.width != first.width || header.height != first.height) {
    defects[fmt::format("is {}x{}, the first {} image is {}x{}; all must have one size",
                        header.width, header.height, is_depth ? "depth" : "colour", first.width,
                        first.height)]
        .push_back(name);
  }
}

void ReportCameraSize(const char* kind, const ImageHeader& image, const PinholeCamera& camera,
                      const Sequence& sequence, const FindingHandler& on_finding) {
  if (camera.width == 0 || image.width == 0) return;
  if (image.width == camera.width && image.height == camera.height) return;
  on_finding({Severity::kError,
              fmt::format("{}: the {} images are {}x{}, the intrinsics are for {}x{}; give the {} "
                          "camera's intrinsics for the size of its images",
                          sequence.folder.string(), kind, image.width, image.height, camera.width,
                          camera.height, kind)});
}

std::string BetterDepthScale(const Sequence& sequence, double median) {
  const double raw = median * sequence.depth_scale;
  double best = 0;
  for (const double scale : {1000.0, 5000.0, 10000.0, 4000.0, 100.0, 1.0e6}) {
    const double depth = raw / scale;
    if (depth < 0.2 || depth > 5) continue;
    if (best == 0 || std::abs(std::log(depth)) < std::abs(std::log(raw / best))) best = scale;
  }
  if (best == 0) return "set depth_scale to the number of depth units in a metre";
  return fmt::format("depth_scale {:g} would make it {:.2f} m", best, raw / best);
}

}  // namespace

ImageSizes SurveyImages(const Sequence& sequence, const FindingHandler& on_finding) {
  Defects defects;
  ImageHeader depth;
  ImageHeader color;
  for (const SequenceFrame& frame : sequence.frames) {
    if (sequence.has_depth) Examine(frame.depth_path, frame.depth_part, true, depth, defects);
    Examine(frame.color_path, frame.color_part, false, color, defects);
  }
  ReportDefects(defects, on_finding);
  ReportCameraSize("depth", depth, sequence.depth_camera, sequence, on_finding);
  ReportCameraSize("colour", color, sequence.color_camera, sequence, on_finding);
  return {depth.width, depth.height, color.width, color.height};
}

void DepthSamples::Add(const DepthImage& image) {
  for (size_t i = 0; i < image.size(); i += kDepthStride, ++pixels) {
    if (image.data()[i] > 0) valid.push_back(image.data()[i]);
  }
}

void DepthSamples::Add(const DepthSamples& other) {
  valid.insert(valid.end(), other.valid.begin(), other.valid.end());
  pixels += other.pixels;
}

DepthSurvey SurveyDepth(DepthSamples samples) {
  if (samples.valid.empty()) return {};
  const size_t count = samples.valid.size();
  const auto middle = samples.valid.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(samples.valid.begin(), middle, samples.valid.end());
  const auto tenth = samples.valid.begin() + static_cast<std::ptrdiff_t>(count / 10);
  std::nth_element(samples.valid.begin(), tenth, middle);
  return {*middle, *tenth, static_cast<double>(count) / static_cast<double>(samples.pixels)};
}

void ReportDepthScale(const Sequence& sequence, const DepthSurvey& survey,
                      const FindingHandler& on_finding) {
  if (survey.validity == 0) {
    on_finding({Severity::kError,
                fmt::format("{}: the depth images have no valid pixel (raw values other than 0)",
                            sequence.folder.string())});
  } else if (survey.median < kMinMedianDepth || survey.median > kMaxMedianDepth) {
    on_finding(
        {Severity::kError,
         fmt::format("{}: the median depth is {:.4g} m with depth_scale {:g}, it should be "
                     "between {} and {} m; {}",
                     sequence.folder.string(), survey.median, sequence.depth_scale, kMinMedianDepth,
                     kMaxMedianDepth, BetterDepthScale(sequence, survey.median))});
  }
}

}  // namespace curvefusion
