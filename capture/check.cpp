#include "capture/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "capture/content/colour_findings.h"
#include "capture/content/geometry_check.h"
#include "capture/content/suitability.h"
#include "capture/content/thumbnails.h"
#include "capture/detect_format.h"
#include "capture/image_file.h"
#include "capture/readers/readers.h"
#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kWindow = 32;        // frames between two progress messages
constexpr int kSurveyFrames = 24;  // chosen: every sixth of a scan of 5 s

// What decoding one frame told.
struct FrameCheck {
  DepthSamples depth;
  Image<uint16_t> depth_thumbnail;
  Image<uint8_t> grey_thumbnail;
  std::vector<std::string> defects;
  std::vector<std::string> unreadable;  // names of images
  std::string remark;                   // on the colour image
};

// Calls `decode` for an image whose header is sound: other defects are in the survey of the
// headers.
template <class Decode>
void CollectDefect(const std::string& name, const ImageHeader& header, const Decode& decode,
                   FrameCheck& check) {
  try {
    if (header.defect.empty()) return decode();
  } catch (const Error& error) {
    check.defects.emplace_back(error.what());
  }
  check.unreadable.push_back(name);
}

void CheckDepth(const Sequence& sequence, const SequenceFrame& frame, FrameCheck& check) {
  const auto decode = [&] {
    const Image<uint16_t> raw = DecodeDepthImage(frame.depth_path, frame.depth_part);
    check.depth_thumbnail = ShrunkDepth(sequence, raw);
    check.depth.Add(MetricDepth(raw, sequence.depth_scale, sequence.invalid_depth));
  };
  const ImageHeader depth = ReadImageHeader(frame.depth_path, frame.depth_part);
  if (depth.bits != 16 && depth.defect.empty()) return;
  CollectDefect(ImageName(frame.depth_path, frame.depth_part), depth, decode, check);
}

FrameCheck CheckFrame(const Sequence& sequence, const SequenceFrame& frame) {
  FrameCheck check;
  if (sequence.has_depth) CheckDepth(sequence, frame, check);
  const auto decode_color = [&] {
    check.grey_thumbnail =
        ShrunkColor(sequence, DecodeColorImage(frame.color_path, frame.color_part, &check.remark));
  };
  const std::string name = ImageName(frame.color_path, frame.color_part);
  CollectDefect(name, ReadImageHeader(frame.color_path, frame.color_part), decode_color, check);
  if (!check.remark.empty()) {
    check.remark = fmt::format("{}: may be damaged ({})", name, check.remark);
  }
  return check;
}

// What decoding all frames told.
struct DecodedContent {
  DepthSamples depth;
  Thumbnails thumbnails;
  std::set<std::string> unreadable;  // names of images

  void Add(int frame, FrameCheck& check) {
    depth.Add(check.depth);
    unreadable.insert(check.unreadable.begin(), check.unreadable.end());
    if (thumbnails.depth.empty()) return;
    thumbnails.depth[static_cast<size_t>(frame)] = std::move(check.depth_thumbnail);
    thumbnails.grey[static_cast<size_t>(frame)] = std::move(check.grey_thumbnail);
  }
};

DecodedContent CheckFrames(const Sequence& sequence, const Progress& progress,
                           const FindingHandler& on_finding) {
  DecodedContent content;
  content.thumbnails = EmptyThumbnails(sequence);
  const int count = sequence.frame_count();
  for (int begin = 0; begin < count; begin += kWindow) {
    progress("check", begin, count);
    const int end = std::min(begin + kWindow, count);
    std::vector<FrameCheck> checks(static_cast<size_t>(end - begin));
    ParallelFor(begin, end, 1,
                [&](int64_t i) { checks[i - begin] = CheckFrame(sequence, sequence.frames[i]); });
    for (int i = begin; i < end; ++i) {
      FrameCheck& check = checks[static_cast<size_t>(i - begin)];
      for (const std::string& defect : check.defects) on_finding({Severity::kError, defect});
      if (!check.remark.empty()) on_finding({Severity::kWarning, check.remark});
      content.Add(i, check);
    }
  }
  progress("check", count, count);
  return content;
}

double TrajectoryLength(const Sequence& sequence) {
  double length = 0;
  for (size_t i = 1; i < sequence.frames.size(); ++i) {
    length += (sequence.frames[i].T_world_camera.translation() -
               sequence.frames[i - 1].T_world_camera.translation())
                  .norm();
  }
  return length;
}

std::optional<Sequence> TryReadSequence(const std::filesystem::path& folder,
                                        const FindingHandler& on_finding) {
  std::string message;
  try {
    return ReadSequence(folder, PoseUse::kIfGiven, DepthUse::kIfGiven, on_finding);
  } catch (const Error& error) {
    message = error.what();
  }
  on_finding({Severity::kError, message});
  return std::nullopt;
}

void ReportMissingPoses(const Sequence& sequence, const FindingHandler& on_finding) {
  if (sequence.has_poses) return;
  on_finding({Severity::kWarning,
              fmt::format("{}: has no camera poses; reconstruct finds them by tracking the camera "
                          "(curvefusion track does only that)",
                          sequence.folder.string()),
              "no-poses"});
}

// Where most frames of a TUM sequence have no pose, the clocks may be far apart.
GeometryReport CheckPoses(const Sequence& sequence, const Thumbnails& thumbnails,
                          const FindingHandler& on_finding) {
  if (!sequence.has_poses || !sequence.has_depth) return {};
  if (sequence.format == "tum" && sequence.frames_without_pose > sequence.frame_count()) {
    const Sequence images = ReadTumImages(sequence.folder, [](const CheckFinding&) {});
    GeometryReport report = CheckClocks(images, on_finding);
    if (report.correction) return report;
  }
  return CheckGeometry(sequence, thumbnails, on_finding);
}

// A corrected copy has no frames whose images cannot be read.
void LeaveOut(const std::set<std::string>& unreadable, const Sequence& sequence,
              std::optional<SequenceCorrection>& correction) {
  if (unreadable.empty()) return;
  SequenceCorrection corrected = correction.value_or(SequenceCorrection{sequence, false, {}});
  const size_t left_out = std::erase_if(corrected.sequence.frames, [&](const SequenceFrame& frame) {
    return unreadable.contains(ImageName(frame.depth_path, frame.depth_part)) ||
           unreadable.contains(ImageName(frame.color_path, frame.color_part));
  });
  if (left_out == 0 || corrected.sequence.frames.empty()) return;
  corrected.made.push_back(fmt::format("{} frame{} left out whose images cannot be read", left_out,
                                       left_out == 1 ? "" : "s"));
  correction = std::move(corrected);
}

void Summarize(const Sequence& sequence, CheckReport& report) {
  report.format = sequence.format;
  report.has_poses = sequence.has_poses;
  report.has_depth = sequence.has_depth;
  report.frames = sequence.frame_count();
  report.frames_without_pose = sequence.frames_without_pose;
  report.frames_without_partner = sequence.frames_without_partner;
  report.depth_scale = sequence.has_depth ? sequence.depth_scale : 0;
  report.trajectory_length = TrajectoryLength(sequence);
  if (sequence.format == "tum" && !sequence.frames.empty()) {
    report.duration = sequence.frames.back().timestamp - sequence.frames.front().timestamp;
  }
}

}  // namespace

bool CheckReport::has_errors() const {
  return std::any_of(findings.begin(), findings.end(), [](const CheckFinding& finding) {
    return finding.severity == Severity::kError;
  });
}

CheckReport CheckSequence(const std::filesystem::path& folder, const Progress& progress) {
  CheckReport report;
  const FindingHandler collect = [&report](const CheckFinding& finding) {
    report.findings.push_back(finding);
  };
  if (auto sequence = TryReadSequence(folder, collect)) {
    sequence->color_levels = MeasureColorLevels(*sequence);
    Summarize(*sequence, report);
    ReportMissingPoses(*sequence, collect);
    report.image_sizes = SurveyImages(*sequence, collect);
    DecodedContent content = CheckFrames(*sequence, progress, collect);
    const bool has_samples = content.depth.pixels > 0;
    const DepthSurvey depth = SurveyDepth(std::move(content.depth));
    report.median_depth = depth.median;
    report.depth_validity = depth.validity;
    report.geometry = CheckPoses(*sequence, content.thumbnails, collect);
    const bool is_explained = report.geometry.correction.has_value();
    LeaveOut(content.unreadable, *sequence, report.geometry.correction);
    if (has_samples && !is_explained) ReportDepthScale(*sequence, depth, collect);
    if (!report.has_errors()) {
      if (sequence->has_depth) {
        report.colour_camera = FitColourCamera(*sequence, {});
        ReportColourCamera(*sequence, report.colour_camera, collect);
      }
      ReportSuitability(*sequence, depth, SurveyColour(*sequence, kSurveyFrames), collect);
    }
  }
  std::stable_partition(
      report.findings.begin(), report.findings.end(),
      [](const CheckFinding& finding) { return finding.severity == Severity::kError; });
  return report;
}

}  // namespace curvefusion
