#include "fusion/best/colour_start.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "fusion/best/colour_fit.h"
#include "fusion/best/curves_in_depth.h"
#include "fusion/curve_graph/selection.h"
#include "fusion/curve_graph/viewed_region.h"
#include "fusion/curve_graph/wire_proof.h"
#include "fusion/silhouettes/wire_silhouettes.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

// Chosen: nearly all images show places of true curves of simulated scans as wire, at most .65 of
// them those of false links (docs/topology.md#why-it-works).
constexpr double kStep = 0.003;       // metres, between the places that images are asked about
constexpr double kShownAsWire = 0.9;  // of the images
// Chosen on 13 training scans by Azure Kinect and Kinect V2, of which curves in thin pixels have
// .52 to .96 where they are better than others or hardly worse, .26 where they are much worse
// (docs/lab_notebook.md).
constexpr double kMinOnCurves = 0.5;
// Chosen on 18 such scans, 5 of them validation: of what was looked at; two with .02 and .04 become
// worse by images alone, 15 of 16 with .14 and more better (docs/lab_notebook.md).
constexpr double kTellingShare = 0.1;

// Whether depth's curves tell where wires are and what colours they have.
bool TellsOfWires(DepthCurves depth_curves) {
  return depth_curves == DepthCurves::kDoubtful || depth_curves == DepthCurves::kMisplaced;
}

// Metres of curve, and how many of them the images show as wire.
struct ShownCurves {
  double length = 0;
  double shown = 0;

  // What is shown speaks for curves as much as what is not shown speaks against them.
  bool IsBetterThan(const ShownCurves& other, DepthCurves others) const {
    const bool is_more = others == DepthCurves::kMisplaced || shown > other.shown;
    return is_more && 2 * shown - length > 2 * other.shown - other.length;
  }

  // Whether more of them is shown, however many there are.
  bool IsShownMoreThan(const ShownCurves& other) const {
    return shown * other.length > other.shown * length;
  }
};

// Depth's curves may fit poses that went wrong with them, so both are judged by one set of poses.
ShownCurves CountShown(const Sequence& sequence, const WireImages& images,
                       const SkeletonGraph& skeleton) {
  const WireSilhouettes silhouettes(sequence, images.frames, images.posteriors, kColourImages);
  ShownCurves curves;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline points = Resample(skeleton.edge(id).points, kStep);
    const std::vector<double> shares = silhouettes.SharesAlong(points);
    const auto shown = std::count_if(shares.begin(), shares.end(),
                                     [](double share) { return share >= kShownAsWire; });
    curves.length += Length(points);
    curves.shown +=
        Length(points) * static_cast<double>(shown) / static_cast<double>(shares.size());
  }
  return curves;
}

// The motion of the world that takes the cameras of one reconstruction to those of another.
RigidTransform MeanMotion(const Sequence& from, const Sequence& to) {
  Mat3 turns = Mat3::Zero();
  Vec3 from_center = Vec3::Zero(), to_center = Vec3::Zero();
  for (size_t i = 0; i < from.frames.size(); ++i) {
    const RigidTransform& a = from.frames[i].T_world_camera;
    const RigidTransform& b = to.frames[i].T_world_camera;
    turns += b.linear() * a.linear().transpose();
    from_center += a.translation() / static_cast<double>(from.frames.size());
    to_center += b.translation() / static_cast<double>(from.frames.size());
  }
  const Eigen::JacobiSVD<Mat3> svd(turns, Eigen::ComputeFullU | Eigen::ComputeFullV);
  RigidTransform motion = RigidTransform::Identity();
  motion.linear() = svd.matrixU() * svd.matrixV().transpose();
  motion.translation() = to_center - motion.linear() * from_center;
  return motion;
}

// The fit replaces what the result has.
void TakeCurves(Reconstruction&& colour, Reconstruction& result) {
  result.sequence = std::move(colour.sequence);
  result.points = std::move(colour.points);
  result.skeleton = std::move(colour.skeleton);
  result.radii = std::move(colour.radii);
  result.uncertain = {};
  result.trust = colour.trust;
  result.trust.from_colour = true;
}

// Where the object is, by the points that depth has of something thin.
Eigen::AlignedBox3d RegionOf(const Sequence& sequence, const ObservedPoints& points) {
  Eigen::AlignedBox3d around;
  for (const Vec3& p : points.positions) around.extend(p);
  return around.isEmpty() ? RegionSeenByMost(sequence) : around;
}

// How curves are sought.
struct Attempt {
  WireDepth depth = WireDepth::kNotShown;
  bool in_thin_pixels = false;  // only around what depth has of something thin
};

// Curves from colour and what speaks for them.
struct ColourFit {
  Attempt attempt;
  std::vector<int> frames;
  Reconstruction colour;
  ColourCurves curves;
  ShownCurves depth_shown, shown;
  double on_curves = 0;  // share of what depth has of something thin
};

void ReportShown(const ColourFit& fit, StageLog& log) {
  log.Count(kWiresFromColour, "of depth shown as wire, m", fit.depth_shown.shown);
  log.Count(kWiresFromColour, "shown as wire, m", fit.shown.shown);
  log.Count(kWiresFromColour, "share of depth on curves", fit.on_curves);
}

// Those of one row compete; the next row is tried where none of them is better than depth's curves.
std::vector<std::vector<Attempt>> AttemptsFor(DepthCurves depth_curves) {
  const Attempt whole_images, looked_past = {WireDepth::kLookedPast};
  if (!TellsOfWires(depth_curves)) return {{whole_images}, {looked_past}};
  return {{{.in_thin_pixels = true}, whole_images}, {looked_past}};
}

// Whether curves from colour agree with what depth shows, if it shows wires like that.
bool IsLikely(bool depth_shows_them, const Reconstruction& result, const ColourFit& fit,
              const StageReporter& reporter) {
  if (depth_shows_them) {
    const double thin = ShareThinInDepth(result, fit.colour, fit.frames);
    reporter.log.Count(kWiresFromColour, "share thin in depth", thin);
    return IsThinInDepth(thin);
  }
  const PlacesInDepth places = LookUpDepth(fit.colour.sequence, fit.colour.skeleton, fit.frames);
  reporter.log.Count(kWiresFromColour, "places looked at in depth", places.looked);
  reporter.log.Count(kWiresFromColour, "places measured in depth", places.measured);
  reporter.log.Count(kWiresFromColour, "share free in depth", places.ShareOpen());
  return places.AreOpen();
}

// Whether colour images prove any of them to be a wire: nothing does not replace what depth has.
bool AreProven(const Reconstruction& colour, const ProofLimits& limits) {
  SkeletonGraph kept = colour.skeleton;
  UncertainCurves uncertain;
  const std::vector<StretchEvidence> evidence =
      CollectEvidence(kept, colour.radii, colour.sequence, 0, kept);
  KeepProven(evidence, ProveWires(kept, evidence, {}), limits, kept, uncertain);
  return !kept.empty();
}

// Whether they may replace depth's.
bool IsAccepted(const ColourFit& fit, DepthCurves depth_curves, const BestOptions& options,
                const Reconstruction& result, const StageReporter& reporter) {
  const bool is_none = depth_curves == DepthCurves::kNone;
  const bool shows_thin = fit.attempt.depth == WireDepth::kNotShown && TellsOfWires(depth_curves);
  if (!is_none && !AreProven(fit.colour, LimitsOf(options.evidence))) return false;
  if (fit.attempt.in_thin_pixels)
    return fit.on_curves >= kMinOnCurves && fit.shown.IsShownMoreThan(fit.depth_shown);
  return IsLikely(shows_thin, result, fit, reporter) &&
         (is_none || fit.shown.IsBetterThan(fit.depth_shown, depth_curves));
}

}  // namespace

std::optional<ColourCurves> StartFromColour(const Sequence& given, PoseErrors pose_errors,
                                            const WireColours& colours, DepthCurves depth_curves,
                                            const BestOptions& options,
                                            const StageReporter& reporter, Reconstruction& result) {
  const bool is_asked_for = options.depth.use == DepthRole::kBackground;
  if (!is_asked_for && TellsOfWires(depth_curves) &&
      (colours.posterior.empty() || result.points.empty()))
    return std::nullopt;
  const WireImages images =
      colours.posterior.empty() ? LookForContrast(given) : LookForColours(given, colours);
  const Eigen::AlignedBox3d around =
      TellsOfWires(depth_curves) ? RegionOf(given, result.points) : RegionSeenByMost(given);

  const auto fit_curves = [&](const Attempt& attempt) -> std::optional<ColourFit> {
    WireImages learned = images;
    Reconstruction colour;
    const AdjustmentStart start = {CameraPoses(given), pose_errors, attempt.depth,
                                   colours.posterior};
    std::optional<ColourCurves> curves =
        FitCurvesOfColour(given, start, around, attempt.in_thin_pixels ? &result : nullptr, options,
                          reporter, learned, colour);
    if (!curves) return std::nullopt;
    ColourFit fit = {attempt, learned.frames, std::move(colour), *std::move(curves)};
    const Sequence& fitted = fit.colour.sequence;
    fit.depth_shown = CountShown(
        fitted, learned,
        Transformed(result.skeleton, AffineTransform(MeanMotion(result.sequence, fitted))));
    fit.shown = CountShown(fitted, learned, fit.colour.skeleton);
    fit.on_curves = ShareOnCurves(result, fit.colour, fit.frames);
    ReportShown(fit, reporter.log);
    return fit;
  };

  for (const std::vector<Attempt>& competing : AttemptsFor(depth_curves)) {
    std::optional<ColourFit> best;
    for (const Attempt& attempt : competing) {
      std::optional<ColourFit> fit = fit_curves(attempt);
      if (!fit) continue;
      const bool is_accepted = IsAccepted(*fit, depth_curves, options, result, reporter) ||
                               (is_asked_for && !attempt.in_thin_pixels);
      if (is_accepted && (!best || fit->on_curves > best->on_curves)) best = std::move(fit);
    }
    if (!best) continue;
    ReportShown(*best, reporter.log);  // not those tried last
    TakeCurves(std::move(best->colour), result);
    result.warnings.push_back(fmt::format(
        "the curves come from the colour images alone, and their size from depth: the images show "
        "{:.2f} m of them as wire, and {:.2f} of {:.2f} m of depth's",
        best->shown.shown, best->depth_shown.shown, best->depth_shown.length));
    return std::move(best->curves);
  }
  return std::nullopt;
}

std::optional<ColourCurves> FitToColourAlone(SkeletonGraph depth_curves, const Sequence& given,
                                             PoseErrors pose_errors,
                                             const std::vector<uint8_t>& colours,
                                             const BestOptions& options,
                                             const StageReporter& reporter,
                                             Reconstruction& result) {
  Reconstruction by_images;
  by_images.sequence = given;
  by_images.skeleton = std::move(depth_curves);
  AdjustmentStart start = {CameraPoses(given), pose_errors, WireDepth::kNotShown, colours};
  std::optional<ColourAdjustment> adjusted =
      AdjustCurvesAndPoses(start, options.colour_adjustment, reporter, by_images);
  if (!adjusted || adjusted->accepted_share < kTellingShare) return std::nullopt;
  result.sequence = std::move(by_images.sequence);
  result.skeleton = std::move(by_images.skeleton);
  result.trust = by_images.trust;
  result.trust.from_colour = true;
  return ColourCurves{*std::move(adjusted), std::move(start)};
}

std::optional<ColourCurves> StartWithoutDepth(const Sequence& given, const BestOptions& options,
                                              const StageReporter& reporter,
                                              Reconstruction& result) {
  const Eigen::AlignedBox3d around = RegionSeenByMost(given);
  if (around.isEmpty()) return std::nullopt;
  const AdjustmentStart start = {CameraPoses(given), PoseErrors::kDrift, WireDepth::kNotShown};
  Reconstruction colour;
  WireImages images = LookForContrast(given);
  std::optional<ColourCurves> fitted =
      FitCurvesOfColour(given, start, around, nullptr, options, reporter, images, colour);
  if (!fitted) return std::nullopt;
  TakeCurves(std::move(colour), result);
  result.warnings.push_back(
      "the curves come from the colour images alone, and their scale from the poses: depth images "
      "were not used; a line that is painted on something of one colour looks like a wire");
  return fitted;
}

}  // namespace curvefusion
