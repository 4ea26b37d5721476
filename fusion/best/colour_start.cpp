#include "fusion/best/colour_start.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/curve_graph/viewed_region.h"
#include "fusion/silhouettes/wire_silhouettes.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

constexpr double kStep = 0.003;       // metres, between the places that images are asked about
constexpr double kShownAsWire = 0.9;  // of the images
// Depth shows wires in wrong places, but in the right pixels. Chosen on four scans of wires, of
// whose curves from colour .84 and more lie where depth shows something thin, and five rooms
// without any, where .42 at most do (docs/lab_notebook.md).
constexpr double kMinThinInDepth = 0.6;
// Or depth does not show them at all, but what is behind: .96 and .98 of the places of a white grid
// by an SR300 and of springs, .97 and .98 by a phone; .39 to .88 of what three rooms without wires
// give. All are training scans. Of 24 rooms one has 1.0, but nothing that is proven.
constexpr double kMinFreeInDepth = 0.9;
constexpr int kThinImages = 20;    // chosen: enough for a share
constexpr double kBehind = 0.03;   // metres; likewise what hides it: that of StripViews
constexpr double kThinCellPx = 8;  // chosen: of images 640 pixels wide

// Metres of curve, and how many of them the images show as wire.
struct ShownCurves {
  double length = 0;
  double shown = 0;

  // What is shown speaks for curves as much as what is not shown speaks against them.
  bool IsBetterThan(const ShownCurves& other, DepthCurves others) const {
    const bool is_more = others == DepthCurves::kMisplaced || shown > other.shown;
    return is_more && 2 * shown - length > 2 * other.shown - other.length;
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

// Where images have pixels in which something lies, as cells with their neighbours.
MaskImage CellsAround(const std::vector<Vec3>& points, const PinholeCamera& cells,
                      const RigidTransform& T_camera_world) {
  MaskImage around(cells.width, cells.height, 0);
  for (const Vec3& point : points) {
    const Vec3 p = T_camera_world * point;
    if (p.z() <= 0) continue;
    const Vec2 pixel = cells.Project(p);
    if (!cells.Contains(pixel)) continue;
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    for (int v = std::max(0, at.y() - 1); v <= std::min(cells.height - 1, at.y() + 1); ++v)
      for (int u = std::max(0, at.x() - 1); u <= std::min(cells.width - 1, at.x() + 1); ++u)
        around(u, v) = 1;
  }
  return around;
}

// How much of the curves from colour lies, in the images, where depth has points of something thin,
// in whatever distance: a share of the places of all images.
double ShareThinInDepth(const Reconstruction& depth, const Reconstruction& colour,
                        const std::vector<int>& frames) {
  const PinholeCamera& camera = depth.sequence.color_camera;
  const PinholeCamera cells = camera.Scaled(640 / (kThinCellPx * camera.width));
  size_t looked = 0, thin = 0;
  for (const int frame : EvenlyThinned(frames, kThinImages)) {
    const MaskImage around = CellsAround(
        depth.points.positions, cells,
        depth.sequence.T_color_depth * depth.sequence.frames[frame].T_world_camera.inverse());
    const RigidTransform T_color_world =
        colour.sequence.T_color_depth * colour.sequence.frames[frame].T_world_camera.inverse();
    for (const EdgeId id : colour.skeleton.Edges()) {
      for (const Vec3& point : Resample(colour.skeleton.edge(id).points, kStep)) {
        const Vec3 p = T_color_world * point;
        if (p.z() <= 0 || !cells.Contains(cells.Project(p))) continue;
        const Eigen::Vector2i at = PinholeCamera::Rounded(cells.Project(p));
        ++looked;
        thin += around(at.x(), at.y());
      }
    }
  }
  return looked > 0 ? static_cast<double>(thin) / static_cast<double>(looked) : 0;
}

// How much of the curves from colour lies in free space: a share of their places in all images in
// which depth shows something there, or behind it.
double ShareFreeInDepth(const Sequence& sequence, const SkeletonGraph& skeleton,
                        const std::vector<int>& frames) {
  size_t told = 0, free = 0;
  for (const int frame : EvenlyThinned(frames, kThinImages)) {
    const DepthImage depth = LoadDepth(sequence, frame);
    const RigidTransform T_camera_world = sequence.frames[frame].T_world_camera.inverse();
    for (const EdgeId id : skeleton.Edges()) {
      for (const Vec3& point : Resample(skeleton.edge(id).points, kStep)) {
        const Vec3 p = T_camera_world * point;
        if (p.z() <= 0 || !sequence.depth_camera.Contains(sequence.depth_camera.Project(p)))
          continue;
        const Eigen::Vector2i at = PinholeCamera::Rounded(sequence.depth_camera.Project(p));
        const float there = depth(at.x(), at.y());
        if (there < p.z() - kBehind) continue;  // hidden, or not measured
        ++told;
        free += there > p.z() + kBehind;
      }
    }
  }
  return told > 0 ? static_cast<double>(free) / static_cast<double>(told) : 0;
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

// Curves from colour and what they were fitted with.
struct ColourFit {
  WireImages images;
  Reconstruction colour;
  std::optional<ColourCurves> curves;
};

// Whether curves from colour agree with what depth shows, if it shows wires like that.
bool IsLikely(bool depth_shows_them, const Reconstruction& result, const ColourFit& fit,
              const StageReporter& reporter) {
  if (depth_shows_them) {
    const double thin = ShareThinInDepth(result, fit.colour, fit.images.frames);
    reporter.log.Count(kWiresFromColour, "share thin in depth", thin);
    return thin >= kMinThinInDepth;
  }
  const double free = ShareFreeInDepth(fit.colour.sequence, fit.colour.skeleton, fit.images.frames);
  reporter.log.Count(kWiresFromColour, "share free in depth", free);
  return free >= kMinFreeInDepth;
}

}  // namespace

std::optional<ColourCurves> StartFromColour(const Sequence& given, PoseErrors pose_errors,
                                            const WireColours& colours, DepthCurves depth_curves,
                                            const BestOptions& options,
                                            const StageReporter& reporter, Reconstruction& result) {
  const bool is_asked_for = options.depth.use == DepthRole::kBackground;
  const bool is_none = depth_curves == DepthCurves::kNone;
  if (!is_asked_for && !is_none && (colours.posterior.empty() || result.points.empty()))
    return std::nullopt;
  const WireImages images =
      colours.posterior.empty() ? LookForContrast(given) : LookForColours(given, colours);
  const Eigen::AlignedBox3d around = RegionOf(given, result.points);
  for (const WireDepth depth : {WireDepth::kNotShown, WireDepth::kLookedPast}) {
    ColourFit fit = {images, {}, {}};
    const AdjustmentStart start = {CameraPoses(given), pose_errors, depth, colours.posterior};
    fit.curves = FitCurvesOfColour(given, start, around, options, reporter, fit.images, fit.colour);
    if (!fit.curves) continue;
    const Sequence& fitted = fit.colour.sequence;
    const ShownCurves before = CountShown(
        fitted, fit.images,
        Transformed(result.skeleton, AffineTransform(MeanMotion(result.sequence, fitted))));
    const ShownCurves after = CountShown(fitted, fit.images, fit.colour.skeleton);
    reporter.log.Count(kWiresFromColour, "of depth shown as wire, m", before.shown);
    reporter.log.Count(kWiresFromColour, "shown as wire, m", after.shown);
    const bool shows_thin = depth == WireDepth::kNotShown && !is_none;
    const bool is_likely = IsLikely(shows_thin, result, fit, reporter);
    const bool is_better = is_likely && (is_none || after.IsBetterThan(before, depth_curves));
    if (!is_asked_for && !is_better) continue;
    TakeCurves(std::move(fit.colour), result);
    result.warnings.push_back(fmt::format(
        "the curves come from the colour images alone, and their size from depth: the images show "
        "{:.2f} m of them as wire, and {:.2f} of {:.2f} m of depth's",
        after.shown, before.shown, before.length));
    return std::move(fit.curves);
  }
  return std::nullopt;
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
      FitCurvesOfColour(given, start, around, options, reporter, images, colour);
  if (!fitted) return std::nullopt;
  TakeCurves(std::move(colour), result);
  result.warnings.push_back(
      "the curves come from the colour images alone, and their scale from the poses: depth images "
      "were not used; a line that is painted on something of one colour looks like a wire");
  return fitted;
}

}  // namespace curvefusion
