#include "fusion/best/colour_start.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/best/colour_fit.h"
#include "fusion/curve_graph/colour_candidates.h"
#include "fusion/curve_graph/strip_views.h"
#include "fusion/silhouettes/wire_silhouettes.h"
#include "fusion/tracking/tracked_poses.h"
#include "graph/contraction/ridge_skeleton.h"

namespace curvefusion {

namespace {

constexpr int kImages = 90;           // chosen: as many as StripViews looks at
constexpr int kRounds = 2;            // chosen: the second has the poses of the first
constexpr double kStep = 0.003;       // metres, between the places that images are asked about
constexpr double kShownAsWire = 0.9;  // of the images
constexpr const char* kStage = "wires from colour";
// Depth shows wires in wrong places, but in the right pixels. Chosen on four scans of wires, of
// whose curves from colour .84 and more lie where depth shows something thin, and five rooms
// without any, where .42 at most do (docs/lab_notebook.md).
constexpr double kMinThinInDepth = 0.6;
constexpr int kThinImages = 20;    // chosen: enough for a share
constexpr double kThinCellPx = 8;  // chosen: of images 640 pixels wide

// Images and how likely their pixels show wire.
struct WireImages {
  std::vector<int> frames;
  std::vector<PosteriorImage> posteriors;
};

WireImages LookForColours(const Sequence& sequence, const WireColours& colours) {
  WireImages images{EvenlyThinned(AllFrames(sequence), kImages), {}};
  ForEachFrame(
      sequence, images.frames, {.depth = false, .color = true}, [&](const DecodedFrame& frame) {
        images.posteriors.push_back(ApplyPosterior(BinColours(frame.color), colours.posterior));
      });
  return images;
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
};

// Depth's curves may fit poses that went wrong with them, so both are judged by one set of poses.
ShownCurves CountShown(const Sequence& sequence, const WireImages& images,
                       const SkeletonGraph& skeleton) {
  const WireSilhouettes silhouettes(sequence, images.frames, images.posteriors, kImages);
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

// Depth that shows wires in wrong places still shows surfaces where they are.
std::optional<Sequence> HoldToSurfaces(const Sequence& given, const StageReporter& reporter) {
  const StageLog::Timer timer = reporter.Begin(kStage);
  return HeldToItsSurfaces(given, [&](std::string_view stage, int64_t done, int64_t total) {
    reporter.observer.OnProgress(std::string(stage), done, total);
  });
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

void ContractPlacesThatImagesAgreeOn(const WireImages& images, const Eigen::AlignedBox3d& around,
                                     const RidgeOptions& options, const StageReporter& reporter,
                                     Reconstruction& colour) {
  const StageLog::Timer timer = reporter.Begin(kStage);
  const StripViews views(colour.sequence, images.frames, images.posteriors, around);
  colour.points = FindColourCandidates(
      views, CandidatePlaces::kFree,
      [&](int64_t done, int64_t total) { reporter.observer.OnProgress(kStage, done, total); });
  colour.skeleton = ExtractRidgeSkeleton(colour.points, options);
  reporter.log.Count(kStage, "places", static_cast<double>(colour.points.size()));
  reporter.log.Count(kStage, "length, m", colour.skeleton.TotalLength());
  reporter.observer.OnPoints("colour_places", colour.points);
  reporter.observer.OnGraph("from_colour", colour.skeleton);
}

// Curves and poses from colour, in rounds; the last `images` have the colours learned.
std::optional<ColourCurves> FitCurvesOfColour(const Sequence& sequence,
                                              const AdjustmentStart& start,
                                              const Eigen::AlignedBox3d& around,
                                              const BestOptions& options,
                                              const StageReporter& reporter, WireImages& images,
                                              Reconstruction& colour) {
  colour.sequence = sequence;
  std::optional<ColourCurves> fitted;
  for (int round = 0; round < kRounds; ++round) {
    Reconstruction next;
    next.sequence = colour.sequence;
    ContractPlacesThatImagesAgreeOn(images, around, options.ridge, reporter, next);
    if (next.skeleton.empty()) break;
    AssignMeasuredRadii(0, options.radius, reporter, next);
    std::optional<ColourAdjustment> again =
        AdjustCurvesAndPoses(start, options.colour_adjustment, reporter, next);
    if (!again || !CameNearer(*again)) break;  // as exact already
    images = {again->frames, again->posteriors};
    fitted = {std::move(*again), start};
    colour = std::move(next);
  }
  return fitted;
}

}  // namespace

std::optional<ColourCurves> StartFromColour(const Sequence& given, const WireColours& colours,
                                            DepthCurves depth_curves, const BestOptions& options,
                                            const StageReporter& reporter, Reconstruction& result) {
  if (colours.posterior.empty() || result.points.empty()) return std::nullopt;
  Eigen::AlignedBox3d around;
  for (const Vec3& p : result.points.positions) around.extend(p);
  Reconstruction colour;
  WireImages images = LookForColours(given, colours);
  std::optional<ColourCurves> fitted;
  // A camera before a plane and wires alone may slip along it: curves then fit no image.
  bool is_held = true;
  const auto fit = [&](const Sequence& poses, PoseErrors errors) {
    const AdjustmentStart start = {CameraPoses(poses), errors, WireDepth::kNotShown,
                                   colours.posterior};
    return FitCurvesOfColour(poses, start, around, options, reporter, images, colour);
  };
  if (const std::optional<Sequence> held = HoldToSurfaces(given, reporter))
    fitted = fit(*held, PoseErrors::kJitter);
  if (!fitted) {
    is_held = false;
    fitted = fit(given, PoseErrors::kDrift);
  }
  if (!fitted) return std::nullopt;
  const ShownCurves before = CountShown(
      colour.sequence, images,
      Transformed(result.skeleton, AffineTransform(MeanMotion(result.sequence, colour.sequence))));
  const ShownCurves after = CountShown(colour.sequence, images, colour.skeleton);
  reporter.log.Count(kStage, "of depth shown as wire, m", before.shown);
  reporter.log.Count(kStage, "shown as wire, m", after.shown);
  const double thin = ShareThinInDepth(result, colour, images.frames);
  reporter.log.Count(kStage, "share thin in depth", thin);
  const bool is_better = after.IsBetterThan(before, depth_curves) && thin >= kMinThinInDepth;
  if (!options.colour_start.always && !is_better) return std::nullopt;
  result.sequence = std::move(colour.sequence);
  result.points = std::move(colour.points);
  result.skeleton = std::move(colour.skeleton);
  result.radii = std::move(colour.radii);
  result.uncertain = {};
  result.trust = colour.trust;
  result.trust.from_colour = true;
  result.warnings.push_back(fmt::format(
      "the curves come from the colour images alone, and their scale from {}: the images show "
      "{:.2f} m of them as wire, and {:.2f} of {:.2f} m of depth's",
      is_held ? "the surfaces that depth shows" : "the poses", after.shown, before.shown,
      before.length));
  return fitted;
}

}  // namespace curvefusion
