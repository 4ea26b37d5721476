#include "fusion/adjustment/colour_adjustment.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include "capture/frame_stream.h"
#include "fusion/adjustment/colour_frames.h"
#include "fusion/adjustment/curve_pose_solver.h"
#include "fusion/adjustment/curve_vertices.h"
#include "fusion/adjustment/depth_gauge.h"
#include "fusion/registration/pose_correction.h"
#include "fusion/registration/trajectory_anchor.h"
#include "kernel/quantile.h"
#include "kernel/rigid_motion.h"

namespace curvefusion {

namespace {

// How far strips are looked for, and beyond which distance they count less: the start is a few
// pixels off.
struct AdjustmentRound {
  double search_px;
  double huber_px;
  bool learns_colours;
  bool measures_depth;
};
// Chosen: curves start a few pixels off and end at .1 px. Colours that are learned after rounds 2
// to 4 instead give the same within chance (docs/lab_notebook.md).
constexpr std::array<AdjustmentRound, 6> kRounds = {{{14, 4, true, true},
                                                     {10, 2, true, false},
                                                     {7, 1, false, false},
                                                     {5, 0.4, false, true},
                                                     {4, 0.4, false, false},
                                                     {4, 0.4, false, false}}};
constexpr double kCornerAngle = 1.0;   // radians; derived: the same as for smoothing
constexpr double kMaxVertices = 5500;  // of all curves, roughly; chosen: 16 m in steps of 3 mm
constexpr int kMinStrips = 300;        // chosen: an adjustment to fewer is not believed
// Chosen: a spring whose turns hide one another (training spring 3) has .085 and comes from .64 to
// .17 px; adjustments that do not fit have .04 and less (training rack 1 and spring 4).
constexpr double kMinAcceptedShare = 0.05;
// Chosen: or so many of the strips that are accepted at places where most images show one. Curves
// that fit have .33 and more, but for close coils; those that do not .05 at most
// (docs/lab_notebook.md).
constexpr double kMinAgreedShare = 0.25;
// Chosen: curves that fit come to .1, parallel wires 18 mm apart that were taken for the next to
// .6; more is a wire taken for the next.
constexpr double kMaxResidualPx = 0.4;
// Chosen: fitted curves come to .1 to .2, and what lay on its strips need not come nearer.
constexpr double kFittedPx = 0.25;
constexpr double kMinGain = 0.8;  // of the residual
constexpr int kHeldOutFrames = 40;
constexpr size_t kMinHeldOut = 300;  // places seen; fewer tell nothing
// chosen after the values were seen: four adjustments that were good read .70 to .76 px before and
// .74 to .83 after, so only gross failures are refused.
constexpr double kMaxLoss = 1.25;
// Chosen: less tells nothing, as depth images lie beside colour images by about as much each.
constexpr double kDepthMiddlePx = 0.5;
constexpr double kFarPx = 3;  // from depth; farther is another wire
// How well an adjusted pose is known. Chosen with those of color_shift.cpp, on the same scans.
constexpr double kPlaceSigma = 0.2 * kMillimetre;
constexpr double kRollSigma = 0.0003;   // radians: .1 px at the border of 640 x 480 pixels
constexpr double kShiftSigmaPx = 0.15;  // of a colour image's shift, however many edges it has

// Time grows with the number of vertices; along much wire they are farther apart, which strips
// tell the same of: each is read along several millimetres.
double VertexStep(const SkeletonGraph& skeleton, double step) {
  return std::max(step, skeleton.TotalLength() / kMaxVertices);
}

bool Drifts(const Sequence& sequence, const AdjustmentStart& start) {
  return IsVideo(sequence) && start.pose_errors == PoseErrors::kDrift;
}

CurvePoseProblem MakeProblem(const Sequence& sequence, const CurveVertices& curves,
                             const std::vector<int>& indices, const AdjustmentStart& start) {
  CurvePoseProblem problem;
  problem.color_camera = sequence.color_camera;
  problem.depth_camera = sequence.depth_camera;
  problem.T_color_depth = sequence.T_color_depth;
  problem.start.positions = curves.positions;
  problem.rows = curves.rows;
  problem.pose_errors = start.pose_errors;
  for (size_t i = 0; i < indices.size(); ++i) {
    problem.T_world_given.push_back(start.T_world_given[indices[i]]);
    problem.start.T_camera_world.push_back(sequence.frames[indices[i]].T_world_camera.inverse());
    if (Drifts(sequence, start) && i > 0) problem.gaps.push_back(indices[i] - indices[i - 1]);
  }
  return problem;
}

// The strips as images would show them that lie as all frames' do on average.
std::vector<StripObservation> Observations(const std::vector<FrameStrips>& strips,
                                           const std::vector<Vec2>& frame_shifts_px) {
  std::vector<StripObservation> observations;
  for (size_t f = 0; f < strips.size(); ++f) {
    for (const SeenStrip& seen : strips[f]) {
      if (!seen.strip.accepted) continue;
      const Vec2 pixel = seen.sample.pixel + seen.strip.offset_px * seen.sample.normal;
      observations.push_back(
          {static_cast<int>(f), seen.vertex, pixel - frame_shifts_px[f], seen.sample.normal});
    }
  }
  return observations;
}

double MedianResidual(const CurvePoseProblem& problem, const CurvePoseState& state) {
  std::vector<double> residuals;
  for (const StripObservation& strip : problem.strips) {
    const double residual = StripResidual(problem, state, strip);
    if (!std::isnan(residual)) residuals.push_back(std::abs(residual));
  }
  return residuals.empty() ? 0 : Median(std::move(residuals));
}

// What only few images show beside a curve is not its wire.
std::vector<FrameStrips> WhereImagesAgree(std::vector<FrameStrips> strips, size_t vertices) {
  const std::vector<char> shown = ShownByColour(strips, vertices);
  for (FrameStrips& frame : strips)
    std::erase_if(frame, [&](const SeenStrip& seen) { return !shown[seen.vertex]; });
  return strips;
}

// Of depth's middles those at vertices that too few colour images show: colour, where it tells,
// tells four times as exactly, and without depth's errors of registration.
std::vector<StripObservation> WhereColourTellsLittle(const std::vector<StripObservation>& centres,
                                                     const std::vector<FrameStrips>& strips,
                                                     size_t vertices) {
  const std::vector<char> told = ToldByColour(strips, vertices);
  std::vector<StripObservation> kept;
  std::copy_if(centres.begin(), centres.end(), std::back_inserter(kept),
               [&](const auto& centre) { return !told[centre.vertex]; });
  return kept;
}

// Takes what the depth images say of the strips into the problem; how the colour images lie.
ColorShift UseDepth(const Sequence& sequence, const ColourFrames& frames,
                    const CurveVertices& curves, const CurvePoseState& state,
                    const std::vector<FrameStrips>& strips, double axis_depth,
                    CurvePoseProblem& problem, ColourAdjustment& result) {
  DepthGauge gauge = MeasureDepthGauge(sequence, frames.indices, curves, state, strips, axis_depth);
  problem.depths = std::move(gauge.depths);
  problem.depth_centres = WhereColourTellsLittle(gauge.centres, strips, curves.positions.size());
  problem.color_camera.cx += gauge.color_shift.shift_px.x();
  problem.color_camera.cy += gauge.color_shift.shift_px.y();
  result.color_shift_px += gauge.color_shift.shift_px;
  result.depths = static_cast<int>(problem.depths.size());
  result.depth_scatter = gauge.scatter;
  const bool is_video = !problem.gaps.empty();
  // A camera that stands still needs no shutters in step.
  if (!is_video) gauge.color_shift.of_frames_px.assign(frames.size(), Vec2::Zero());
  return gauge.color_shift;
}

// Curves and poses, and how the colour images lie.
struct Fit {
  CurvePoseState state;
  ColorShift color_shift;
};

// Runs all rounds, from how likely pixels of `frames` are to show wire.
Fit RunRounds(const Sequence& sequence, const CurveVertices& curves, CurvePoseProblem problem,
              const ColourAdjustmentOptions& options, WireDepth depth, ColourFrames& frames,
              ColourAdjustment& result) {
  Fit fit{problem.start, {}};
  CurvePoseState& state = fit.state;
  ColorShift& color_shift = fit.color_shift;
  color_shift.of_frames_px.assign(frames.size(), Vec2::Zero());
  color_shift.frame_sigmas_px.assign(frames.size(), Vec2::Zero());
  result.color_shift_px.setZero();
  for (const AdjustmentRound& round : kRounds) {
    const std::vector<FrameStrips> strips =
        TrackCurves(curves, problem, state, frames, round.search_px);
    problem.strips =
        Observations(WhereImagesAgree(strips, curves.positions.size()), color_shift.of_frames_px);
    if (&round == &kRounds.front()) result.start_residual_px = MedianResidual(problem, state);
    if (options.edges) {
      problem.edges =
          Observations(TrackEdges(curves, problem, state, frames, round.search_px, strips),
                       color_shift.of_frames_px);
    }
    if (round.measures_depth && depth == WireDepth::kShown) {
      color_shift =
          UseDepth(sequence, frames, curves, state, strips, options.axis_depth, problem, result);
    }
    // While curves find their strips this would carry one wrong strip to its neighbours.
    problem.evens_bends = &round == &kRounds.back();
    state = ImproveCurvesAndPoses(problem, state, round.huber_px);
    if (round.learns_colours) LearnColours(strips, curves, frames);
    result.strips = static_cast<int>(problem.strips.size());
    result.accepted_share = AcceptedShare(strips);
    result.agreed_share = AgreedShare(strips, curves.positions.size());
    if (result.strips < kMinStrips) break;
  }
  result.residual_px = MedianResidual(problem, state);
  return fit;
}

// The adjustment fits all frames to one another; the first of a video anchor the world.
RigidTransform Anchor(const std::vector<RigidTransform>& T_world_given,
                      const std::vector<int>& indices, const std::vector<RigidTransform>& poses,
                      const PinholeCamera& color_camera, const std::vector<Vec2>& shift_sigmas_px) {
  std::vector<SmallMotion> sigmas;
  for (const Vec2& sigma_px : shift_sigmas_px) {
    sigmas.emplace_back() << Vec3::Constant(kPlaceSigma),
        std::hypot(sigma_px.y(), kShiftSigmaPx) / color_camera.fy,
        std::hypot(sigma_px.x(), kShiftSigmaPx) / color_camera.fx, kRollSigma;
  }
  return AnchorToGivenPoses(T_world_given, indices, poses, sigmas);
}

// An image that lies beside its place looks like a camera that is turned.
RigidTransform TurnLike(const Vec2& shift_px, const PinholeCamera& camera) {
  return RigidMotion({shift_px.y() / camera.fy, -shift_px.x() / camera.fx, 0}, Vec3::Zero());
}

// Frames that were not used, which judge the adjustment.
std::vector<int> HeldOutFrames(int frame_count, const std::vector<int>& used) {
  std::vector<int> others;
  for (int i = 0; i < frame_count; ++i) {
    if (!std::binary_search(used.begin(), used.end(), i)) others.push_back(i);
  }
  return EvenlyThinned(others, kHeldOutFrames);
}

// The mean distance of curves from the strips, pixels, without the shift that all share: neither
// sensor tells where the other's image lies. Distances count up to kFarPx.
double MeanResidual(const CurvePoseProblem& problem, const CurvePoseState& state) {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Identity();
  Vec2 rhs = Vec2::Zero();
  const auto residual = [&](const StripObservation& strip) {
    return std::clamp(StripResidual(problem, state, strip), -kFarPx, kFarPx);
  };
  for (const StripObservation& strip : problem.strips) {
    matrix += strip.normal * strip.normal.transpose();
    rhs += residual(strip) * strip.normal;
  }
  const Vec2 shift_px = matrix.inverse() * rhs;
  double sum = 0;
  for (const StripObservation& strip : problem.strips) {
    sum += std::abs(residual(strip) - strip.normal.dot(shift_px));
  }
  return sum / static_cast<double>(problem.strips.size());
}

// How far the curves lie from the middle of what depth images show of them, pixels; nothing where
// these show too little.
std::optional<double> DepthDisagreement(const Sequence& sequence, const CurveVertices& curves,
                                        const std::vector<Vec3>& positions,
                                        const std::vector<RigidTransform>& T_world_camera,
                                        const std::vector<int>& frames, double axis_depth) {
  CurvePoseProblem problem;
  problem.color_camera = problem.depth_camera = sequence.depth_camera;
  CurvePoseState state{positions, {}};
  for (const int i : frames) state.T_camera_world.push_back(T_world_camera[i].inverse());
  std::vector<FrameStrips> places = ExpectStrips(curves, problem, state);
  for (FrameStrips& frame : places) {
    for (SeenStrip& seen : frame) seen.strip.accepted = true;
  }
  const DepthGauge gauge = MeasureDepthGauge(sequence, frames, curves, state, places, axis_depth);
  if (gauge.centres.size() < kMinHeldOut) return std::nullopt;
  problem.strips = gauge.centres;
  return MeanResidual(problem, state);
}

// Why an adjustment is not to be believed; empty where it is.
std::string ReasonToSkip(const ColourAdjustment& result) {
  const bool is_seen =
      result.accepted_share >= kMinAcceptedShare || result.agreed_share >= kMinAgreedShare;
  if (result.strips < kMinStrips || !is_seen) {
    return fmt::format(
        "the wires' colour tells them from the background in {} places only ({:.0f} % of those "
        "looked at)",
        result.strips, 100 * result.accepted_share);
  }
  const bool fits = CameNearer(result) || result.residual_px <= kFittedPx;
  if (result.residual_px > kMaxResidualPx || !fits) {
    return fmt::format("curves did not come nearer to their strips: {:.2f} px before, {:.2f} after",
                       result.start_residual_px, result.residual_px);
  }
  return {};
}

// From the colours at the curves' places; where curves lie beside their strips, and these are the
// background's, from what images show without them.
Fit FitToColours(const Sequence& sequence, const CurveVertices& curves,
                 const AdjustmentStart& start, const ColourAdjustmentOptions& options,
                 ColourFrames& frames, ColourAdjustment& result) {
  const CurvePoseProblem problem = MakeProblem(sequence, curves, frames.indices, start);
  const std::vector<FrameStrips> expected = ExpectStrips(curves, problem, problem.start);
  LearnColours(expected, curves, frames);
  const Fit fit = RunRounds(sequence, curves, problem, options, start.depth, frames, result);
  if (ReasonToSkip(result).empty()) return fit;
  LookUpFirst(sequence, start.colours, MedianWidthPx(expected), frames);
  return RunRounds(sequence, curves, problem, options, start.depth, frames, result);
}

}  // namespace

void VisitOptions(ColourAdjustmentOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"enabled", "", 0, 1,
                 "Deviation: curves and camera poses are adjusted together to the wires' strips in "
                 "the colour images, which show them to a tenth of a pixel; the paper ends with "
                 "curves as good as depth."},
                options.enabled);
  visitor.Visit(
      {"vertex_step", "m", 0.001, 0.02,
       "Deviation: distance of the vertices that are moved; farther apart where there are "
       "more than some 16 m of wire. Prototype of this stage."},
      options.vertex_step);
  visitor.Visit(
      {"frame_stride", "frames", 1, 30,
       "Deviation: of a video only every so many-th frame is used, more of them where the camera "
       "moves 15 mm in fewer frames, of other views all, and at most 120; poses between are "
       "interpolated."},
      options.frame_stride);
  visitor.Visit({"depth_before_axis", "radii", 0, 1.5,
                 "Deviation: depth is measured so far before the axis, on the near side. Prototype "
                 "of this stage: .83 to 1."},
                options.axis_depth);
  visitor.Visit({"edges", "", 0, 1,
                 "Deviation: strips that other wires touch on one side are found by their edge on "
                 "the other: a bar with a wire array shows no strip of its own."},
                options.edges);
}

bool CameNearer(const ColourAdjustment& adjusted) {
  return adjusted.residual_px <= kMinGain * adjusted.start_residual_px;
}

ColourAdjustment AdjustToColours(const SkeletonGraph& skeleton, const Sequence& sequence,
                                 const AdjustmentStart& start,
                                 const ColourAdjustmentOptions& options) {
  ColourAdjustment result;
  result.skeleton = skeleton;
  result.T_world_camera = CameraPoses(sequence);
  const double step = VertexStep(skeleton, options.vertex_step);
  const CurveVertices curves = SampleVertices(skeleton, step, kCornerAngle);
  const bool has_radii = std::all_of(curves.radii.begin(), curves.radii.end(),
                                     [](double radius) { return radius > 0; });
  if (curves.positions.empty() || !has_radii) {
    result.skipped = "there are no curves of known radius";
    return result;
  }
  ColourFrames frames =
      LoadColourFrames(sequence, ChooseColourFrames(sequence, options.frame_stride));
  const Fit fit = FitToColours(sequence, curves, start, options, frames, result);
  result.frames = std::move(frames.indices);
  result.posteriors = std::move(frames.posteriors);
  result.skipped = ReasonToSkip(result);
  if (!result.skipped.empty()) {
    result.color_shift_px.setZero();
    return result;
  }
  std::vector<RigidTransform> poses;
  for (const RigidTransform& T_camera_world : fit.state.T_camera_world) {
    poses.push_back(T_camera_world.inverse());
  }
  CurveVertices moved = curves;
  moved.positions = fit.state.positions;
  if (Drifts(sequence, start)) {
    const RigidTransform T_anchored_world =
        Anchor(start.T_world_given, result.frames, poses, sequence.color_camera,
               fit.color_shift.frame_sigmas_px);
    for (RigidTransform& pose : poses) pose = T_anchored_world * pose;
    for (Vec3& position : moved.positions) position = T_anchored_world * position;
  }
  std::vector<RigidTransform> T_world_adjusted =
      InterpolateCorrections(start.T_world_given, result.frames, poses);
  const std::vector<int> held_out = start.depth == WireDepth::kShown
                                        ? HeldOutFrames(sequence.frame_count(), result.frames)
                                        : std::vector<int>{};
  const auto before = DepthDisagreement(sequence, curves, curves.positions, result.T_world_camera,
                                        held_out, options.axis_depth);
  const auto after = DepthDisagreement(sequence, curves, moved.positions, T_world_adjusted,
                                       held_out, options.axis_depth);
  if (before && after && *after > kMaxLoss * std::max(*before, kDepthMiddlePx)) {
    result.skipped = fmt::format(
        "depth images that were not used agree less with the curves: {:.2f} px before, {:.2f} "
        "after",
        *before, *after);
    result.color_shift_px.setZero();
    return result;
  }
  result.skeleton = WithVertices(skeleton, moved, step);
  result.T_world_camera = std::move(T_world_adjusted);
  for (size_t i = 0; i < poses.size(); ++i) {
    result.T_world_camera[result.frames[i]] =
        poses[i] * TurnLike(fit.color_shift.of_frames_px[i], sequence.color_camera);
  }
  return result;
}

}  // namespace curvefusion
