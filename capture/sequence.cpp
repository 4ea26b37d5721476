#include "capture/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "capture/decoded_images.h"
#include "capture/detect_format.h"
#include "capture/image_file.h"
#include "capture/image_survey.h"
#include "kernel/error.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr int kDepthScaleFrames = 3;             // looked at when opening
constexpr double kVideoStep = 20 * kMillimetre;  // cameras in hands move less from frame to frame

void RequireSize(const Sequence& sequence, const std::string& image, int width, int height,
                 const PinholeCamera& camera) {
  if (width == camera.width && height == camera.height) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: is {}x{}, the intrinsics in {} are for {}x{}", image, width, height,
                          sequence.folder.string(), camera.width, camera.height));
}

void RequirePlausibleDepth(const Sequence& sequence, const FindingHandler& on_finding) {
  DepthSamples samples;
  const int count = std::min(kDepthScaleFrames, sequence.frame_count());
  for (int i = 0; i < count; ++i) {
    samples.Add(LoadDepth(sequence, i * sequence.frame_count() / count));
  }
  ReportDepthScale(sequence, SurveyDepth(samples), on_finding);
}

// Tells images from each other.
std::string KeyOf(const std::filesystem::path& path, const ImagePart& part) {
  return fmt::format("{}:{}:{}:{}", path.string(), part.chunk.offset, part.offset,
                     static_cast<int>(part.coding));
}

std::shared_ptr<const Image<uint16_t>> StoredDepth(const Sequence& sequence,
                                                   const SequenceFrame& frame) {
  const auto decode = [&] { return DecodeDepthImage(frame.depth_path, frame.depth_part); };
  if (!sequence.decoded) return std::make_shared<const Image<uint16_t>>(decode());
  return sequence.decoded->Depth(KeyOf(frame.depth_path, frame.depth_part), decode);
}

std::shared_ptr<const ColorImage> StoredColor(const Sequence& sequence,
                                              const SequenceFrame& frame) {
  const auto decode = [&] { return DecodeColorImage(frame.color_path, frame.color_part); };
  if (!sequence.decoded) return std::make_shared<const ColorImage>(decode());
  return sequence.decoded->Color(KeyOf(frame.color_path, frame.color_part), decode);
}

}  // namespace

Sequence KeepingImages(Sequence sequence) {
  if (!sequence.decoded) sequence.decoded = std::make_shared<DecodedImages>();
  return sequence;
}

Sequence WithoutDepth(Sequence sequence) {
  sequence.has_depth = false;
  for (SequenceFrame& frame : sequence.frames) {
    frame.depth_path.clear();
    frame.depth_part = {};
  }
  return sequence;
}

Sequence OpenSequence(const std::filesystem::path& folder, PoseUse poses, DepthUse depth) {
  std::vector<std::string> warnings;
  const FindingHandler throw_errors = [&warnings](const CheckFinding& finding) {
    if (finding.severity == Severity::kError) throw Error(ErrorKind::kBadInput, finding.message);
    warnings.push_back(finding.message);
  };
  Sequence sequence = ReadSequence(folder, poses, depth, throw_errors);
  SurveyImages(sequence, throw_errors);
  if (sequence.has_depth) RequirePlausibleDepth(sequence, throw_errors);
  sequence.color_levels = MeasureColorLevels(sequence);
  sequence.warnings = std::move(warnings);
  return sequence;
}

std::vector<RigidTransform> CameraPoses(const Sequence& sequence) {
  std::vector<RigidTransform> poses;
  for (const SequenceFrame& frame : sequence.frames) poses.push_back(frame.T_world_camera);
  return poses;
}

double StepBetweenFrames(const Sequence& sequence, double share) {
  std::vector<double> steps;
  for (size_t i = 1; i < sequence.frames.size(); ++i) {
    steps.push_back((sequence.frames[i].T_world_camera.translation() -
                     sequence.frames[i - 1].T_world_camera.translation())
                        .norm());
  }
  return steps.empty() ? std::numeric_limits<double>::infinity()
                       : Quantile(std::move(steps), share);
}

bool IsVideo(const Sequence& sequence) { return StepBetweenFrames(sequence, 0.75) < kVideoStep; }

DepthImage LoadDepth(const Sequence& sequence, int frame) {
  const PinholeCamera& camera = sequence.depth_camera;
  if (!sequence.has_depth) return {camera.width, camera.height};
  const SequenceFrame& entry = sequence.frames.at(static_cast<size_t>(frame));
  const auto raw = StoredDepth(sequence, entry);
  RequireSize(sequence, ImageName(entry.depth_path, entry.depth_part), raw->width(), raw->height(),
              sequence.depth_camera);
  DepthImage depth = MetricDepth(*raw, sequence.depth_scale, sequence.invalid_depth);
  if (sequence.depth_distortion.IsZero()) return depth;
  return Undistorted(depth, sequence.depth_camera, sequence.depth_distortion);
}

ColorImage LoadColor(const Sequence& sequence, int frame) {
  ColorImage image = LoadColorAsStored(sequence, frame);
  ApplyLevels(sequence.color_levels, image);
  return image;
}

ColorImage LoadColorAsStored(const Sequence& sequence, int frame) {
  const SequenceFrame& entry = sequence.frames.at(static_cast<size_t>(frame));
  const auto color = StoredColor(sequence, entry);
  RequireSize(sequence, ImageName(entry.color_path, entry.color_part), color->width(),
              color->height(), sequence.color_camera);
  if (sequence.color_distortion.IsZero()) return *color;
  return Undistorted(*color, sequence.color_camera, sequence.color_distortion);
}

}  // namespace curvefusion
