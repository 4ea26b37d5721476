#include "fusion/best/colour_fit.h"

#include <algorithm>
#include <utility>

#include "capture/frame_stream.h"

namespace curvefusion {

namespace {

// Derived: where most candidates are no wires, what stays is more likely one than not.
constexpr double kRatherAWire = 0.5;

void ReportAdjustment(const ColourAdjustment& adjusted, StageLog& log) {
  const char* stage = "colour adjustment";
  log.Count(stage, "frames", static_cast<double>(adjusted.frames.size()));
  log.Count(stage, "strips", adjusted.strips);
  log.Count(stage, "accepted share", adjusted.accepted_share);
  log.Count(stage, "agreed share", adjusted.agreed_share);
  log.Count(stage, "depths", adjusted.depths);
  log.Count(stage, "scatter of depth", adjusted.depth_scatter);
  log.Count(stage, "residual before, px", adjusted.start_residual_px);
  log.Count(stage, "residual, px", adjusted.residual_px);
  log.Count(stage, "colour shift x, px", adjusted.color_shift_px.x());
  log.Count(stage, "colour shift y, px", adjusted.color_shift_px.y());
  if (!adjusted.skipped.empty()) log.Remark(stage, "skipped: " + adjusted.skipped);
}

}  // namespace

RadiusEstimate MeasureRadii(const SkeletonGraph& skeleton, const Sequence& sequence,
                            double array_diameter, const RadiusOptions& options,
                            const StageReporter& reporter) {
  const StageLog::Timer timer = reporter.Begin("radius");
  RadiusEstimate estimate = EstimateRadius(skeleton, sequence, AllFrames(sequence), options);
  // Strips of wires so close that none stands alone are not measured one by one.
  if (estimate.global_radius == 0) {
    estimate.global_radius = estimate.unmeasured_radius = 0.5 * array_diameter;
  }
  reporter.log.Count("radius", "strips", static_cast<double>(estimate.strips.size()));
  return estimate;
}

void AssignMeasuredRadii(double array_diameter, const RadiusOptions& options,
                         const StageReporter& reporter, Reconstruction& result) {
  result.radii = MeasureRadii(result.skeleton, result.sequence, array_diameter, options, reporter);
  AssignRadii(result.radii, result.skeleton);
}

std::optional<ColourAdjustment> AdjustCurvesAndPoses(const AdjustmentStart& start,
                                                     const ColourAdjustmentOptions& options,
                                                     const StageReporter& reporter,
                                                     Reconstruction& result) {
  if (!options.enabled || result.skeleton.empty()) return std::nullopt;
  const StageLog::Timer timer = reporter.Begin("colour adjustment");
  ColourAdjustment adjusted = AdjustToColours(result.skeleton, result.sequence, start, options);
  result.skeleton = adjusted.skeleton;
  for (size_t i = 0; i < result.sequence.frames.size(); ++i) {
    result.sequence.frames[i].T_world_camera = adjusted.T_world_camera[i];
  }
  result.sequence.color_camera.cx += adjusted.color_shift_px.x();
  result.sequence.color_camera.cy += adjusted.color_shift_px.y();
  ReportAdjustment(adjusted, reporter.log);
  result.trust.adjusted = adjusted.skipped.empty();
  result.trust.residual_before_px = adjusted.start_residual_px;
  result.trust.residual_px = adjusted.residual_px;
  reporter.observer.OnGraph("adjusted", result.skeleton);
  return adjusted.skipped.empty() ? std::optional(std::move(adjusted)) : std::nullopt;
}

ProofLimits LimitsOf(const ViewEvidenceOptions& options) {
  return {options.min_probability, std::max(options.min_probability, kRatherAWire)};
}

}  // namespace curvefusion
