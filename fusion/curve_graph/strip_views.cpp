#include "fusion/curve_graph/strip_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "capture/farthest_depth.h"
#include "capture/frame_stream.h"
#include "capture/image_mat.h"
#include "fusion/curve_graph/strip_middles.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen while looking at training scans chair 3, furnished 1, rack 2, tree 2, umbrella 1 and
// vine 1 (docs/lab_notebook.md).
constexpr double kExplainedPx = 1.2;   // curves cover so much beside their outline
constexpr double kLargestFocal = 900;  // pixels; images beyond it are halved
constexpr double kMargin = 0.05;       // metres around what is known of the object
constexpr double kMarginShare = 0.25;  // likewise, of its size
constexpr int kRegionMarginPx = 16;    // strips' sides and what is averaged along them
constexpr auto kHiding = static_cast<float>(kHidingDistance);
constexpr float kFreeDistance = 0.02F;   // metres behind a wire; CurveFusion 4, assumption (i)
constexpr double kFreeShare = 0.8;       // of the images whose depth tells
constexpr double kFromTheSide = 0.15;    // sine of the angle between a curve and the line of sight
constexpr double kUsualSine = M_PI / 4;  // derived: of that angle, in the mean over directions
constexpr int kSameDirection = 43;       // 30 degrees, see DirectionUnits
constexpr double kAhead = 1e-3;          // metres, between which a direction is projected

template <typename Pixel>
Image<Pixel> Crop(const Image<Pixel>& image, const cv::Rect& region) {
  Image<Pixel> crop(region.width, region.height);
  for (int v = 0; v < region.height; ++v) {
    const Pixel* row = image.row(region.y + v) + region.x;
    std::copy(row, row + region.width, crop.row(v));
  }
  return crop;
}

// What is looked at of a frame: the part of its colour image around the object.
struct Part {
  RigidTransform T_depth_world, T_color_world;
  Image<float> farthest;
  cv::Rect region;
  ColorImage color;
  PosteriorImage posterior;
};

Eigen::Matrix<float, 3, 4> CameraMatrix(const PinholeCamera& camera, const RigidTransform& T) {
  Mat3 pixels_times_depth;
  pixels_times_depth << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  return (pixels_times_depth * T.matrix().topRows<3>()).cast<float>();
}

// Of the angle between the line of sight to a place and a unit direction, both the camera's.
double SineToSight(const Vec3& p, const Vec3& d) { return d.cross(p.normalized()).norm(); }

}  // namespace

StripViews::StripViews(const Sequence& sequence, const std::vector<int>& frames,
                       const std::vector<PosteriorImage>& posteriors,
                       const Eigen::AlignedBox3d& around, double scale)
    : depth_camera_(sequence.depth_camera),
      color_camera_(CameraLookedThrough(sequence.color_camera, scale)),
      bounds_(around) {
  if (bounds_.isEmpty()) return;
  const Vec3 margin = Vec3::Constant(kMargin + kMarginShare * bounds_.diagonal().norm());
  bounds_.min() -= margin;
  bounds_.max() += margin;
  const std::vector<int> used = EvenlyThinned(frames, kMaxViews);
  std::vector<Part> parts;
  ForEachFrame(sequence, used, {.depth = true, .color = true}, [&](const DecodedFrame& frame) {
    const RigidTransform T_depth_world = sequence.frames[frame.index].T_world_camera.inverse();
    const RigidTransform T_color_world = sequence.T_color_depth * T_depth_world;
    const auto place = std::lower_bound(frames.begin(), frames.end(), frame.index) - frames.begin();
    const cv::Rect region = RegionIn(T_color_world);
    parts.push_back(
        {T_depth_world, T_color_world, FarthestInCells(frame.depth), region,
         Crop(ShrunkTo(color_camera_.width, color_camera_.height, frame.color), region),
         Crop(ShrunkTo(color_camera_.width, color_camera_.height, posteriors[place]), region)});
  });
  views_.resize(parts.size());
  ParallelFor(0, static_cast<int64_t>(parts.size()), 1, [&](int64_t i) {
    Part& part = parts[i];
    const StripPixels strips =
        part.region.empty() ? StripPixels() : FindStripPixels(part.color, part.posterior);
    views_[i] = {part.T_color_world,
                 CameraMatrix(color_camera_, part.T_color_world),
                 CameraMatrix(depth_camera_, part.T_depth_world),
                 part.T_color_world.inverse().translation(),
                 StripImage(color_camera_.width, color_camera_.height, part.region, strips),
                 std::move(part.farthest)};
  });
}

PinholeCamera StripViews::CameraLookedThrough(const PinholeCamera& color_camera, double scale) {
  const double all = color_camera.fx > kLargestFocal ? 0.5 * scale : scale;
  return all == 1 ? color_camera : color_camera.Scaled(all);
}

// Where the bounds lie in an image.
cv::Rect StripViews::RegionIn(const RigidTransform& T_color_world) const {
  const cv::Rect whole(0, 0, color_camera_.width, color_camera_.height);
  Eigen::AlignedBox2d box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p =
        T_color_world * bounds_.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    if (p.z() < PinholeCamera::kNearest) return whole;
    box.extend(color_camera_.Project(p));
  }
  const cv::Point first(cvFloor(box.min().x()) - kRegionMarginPx,
                        cvFloor(box.min().y()) - kRegionMarginPx);
  const cv::Point last(cvCeil(box.max().x()) + kRegionMarginPx,
                       cvCeil(box.max().y()) + kRegionMarginPx);
  return cv::Rect(first, last) & whole;
}

void StripViews::ExplainAll(const SkeletonGraph& skeleton) {
  ParallelFor(0, static_cast<int64_t>(views_.size()), 1, [&](int64_t i) {
    View& view = views_[i];
    for (const EdgeId id : skeleton.Edges())
      ExplainIn(view, skeleton.edge(id).points, skeleton.edge(id).radii);
    view.strips.DropExplained();
  });
}

void StripViews::Explain(const Polyline& points, const std::vector<double>& radii) {
  ParallelFor(0, static_cast<int64_t>(views_.size()), 1,
              [&](int64_t i) { ExplainIn(views_[i], points, radii); });
}

void StripViews::ExplainIn(View& view, const Polyline& points,
                           const std::vector<double>& radii) const {
  Eigen::Vector2i before;
  bool has_before = false;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = view.T_color_world * points[i];
    if (p.z() < PinholeCamera::kNearest) {
      has_before = false;
      continue;
    }
    const Eigen::Vector2i here = PinholeCamera::Rounded(color_camera_.Project(p));
    const double radius = radii.empty() ? 0 : radii[i];
    const double width = 2 * (radius * color_camera_.fx / p.z() + kExplainedPx);
    view.strips.Explain(has_before ? before : here, here, static_cast<int>(std::ceil(width)));
    before = here;
    has_before = true;
  }
}

// The pixel of a camera that shows a place; nothing outside its image.
inline std::optional<StripViews::Sight> StripViews::RoundedIn(const PinholeCamera& camera,
                                                              const Vec3f& p) {
  const float scale = 1 / p.z();
  const Eigen::Vector2f pixel(p.x() * scale, p.y() * scale);
  const float u = pixel.x() + 0.5F, v = pixel.y() + 0.5F;
  if (!(u >= 0 && v >= 0 && u < static_cast<float>(camera.width) &&
        v < static_cast<float>(camera.height)))
    return std::nullopt;
  return Sight{static_cast<int>(u), static_cast<int>(v), pixel};
}

// What depth says of a place in one view: metres from it to the farthest thing there; 0 = nothing.
inline float StripViews::Behind(const View& view, const Vec3f& in_depth) const {
  if (in_depth.z() <= 0) return 0;
  const std::optional<Sight> sight = RoundedIn(depth_camera_, in_depth);
  if (!sight) return 0;
  const float farthest = view.farthest(sight->u / kDepthCellPx, sight->v / kDepthCellPx);
  return farthest > 0 ? farthest - in_depth.z() : 0;
}

bool StripViews::IsHidden(const View& view, const Vec3f& in_depth) const {
  return Behind(view, in_depth) < -kHiding;
}

bool StripViews::IsFree(const Vec3& p) const {
  int told = 0, free = 0;
  for (const View& view : views_) {
    const float behind = Behind(view, view.depth_from_world * p.cast<float>().homogeneous());
    told += behind != 0 && behind >= -kHiding;
    free += behind > kFreeDistance;
  }
  return told > 0 && free >= kFreeShare * told;
}

// Nothing where a curve explains what is seen there, or depth shows only what is nearer.
inline std::optional<StripViews::Sight> StripViews::SightOf(const View& view, const Vec3f& in_color,
                                                            const Vec3f& in_depth) const {
  if (in_color.z() < PinholeCamera::kNearest) return std::nullopt;
  const std::optional<Sight> sight = RoundedIn(color_camera_, in_color);
  if (!sight || view.strips.IsExplained(sight->u, sight->v)) return std::nullopt;
  if (IsHidden(view, in_depth)) return std::nullopt;
  return sight;
}

// Whether the nearest strip runs as a line does that is seen at a pixel; one seen from its end runs
// anywhere. `p` and the unit direction `d` are the camera's.
bool StripViews::RunsAlong(const View& view, const Sight& sight, const Vec3& p,
                           const Vec3& d) const {
  if (SineToSight(p, d) < kFromTheSide) return true;
  const Vec2 ahead = color_camera_.Project(Vec3(p + kAhead * d)) - sight.pixel.cast<double>();
  const auto turn = static_cast<int8_t>(view.strips.DirectionOfStrip(sight.u, sight.v) -
                                        DirectionUnits(std::atan2(ahead.y(), ahead.x())));
  return std::abs(turn) <= kSameDirection;
}

StripAgreement StripViews::Along(const Vec3& p, const Vec3& direction) const {
  const Eigen::Vector4f place = p.cast<float>().homogeneous();
  StripAgreement agreement;
  for (const View& view : views_) {
    const std::optional<Sight> sight =
        SightOf(view, view.color_from_world * place, view.depth_from_world * place);
    if (!sight) continue;
    const Vec3 p_color = view.T_color_world * p;
    const Vec3 d = view.T_color_world.linear() * direction;
    const auto [u, v, pixel] = *sight;
    const bool is_seen =
        view.strips.IsSeen(StripImage::kCloseLook, u, v) && RunsAlong(view, *sight, p_color, d);
    // A curve that runs towards the camera is short in the image, which then tells little of its
    // length.
    const double told = std::min(1.0, SineToSight(p_color, d) / kUsualSine);
    ++agreement.looked;
    agreement.seen += is_seen;
    agreement.evidence += told * view.strips.Evidence(StripImage::kCloseLook, is_seen, u, v);
    if (is_seen) agreement.middle_evidence += told * view.strips.MiddleEvidence(u, v);
  }
  return agreement.Weighted(1);
}

std::vector<StripAgreement> StripViews::AgreementsAlong(const Polyline& points) const {
  const std::vector<Vec3> tangents = Tangents(points);
  std::vector<StripAgreement> agreements(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), 8,
              [&](int64_t i) { agreements[i] = Along(points[i], tangents[i]); });
  return agreements;
}

std::vector<double> StripViews::SharesAlong(const Polyline& points) const {
  std::vector<double> shares;
  for (const StripAgreement& look : AgreementsAlong(points)) {
    const bool is_told = look.looked >= StripAgreement::kMinLooks;
    shares.push_back(is_told ? static_cast<double>(look.seen) / look.looked : 1);
  }
  return shares;
}

}  // namespace curvefusion
