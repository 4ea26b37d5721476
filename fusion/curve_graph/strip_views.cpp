#include "fusion/curve_graph/strip_views.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "capture/farthest_depth.h"
#include "capture/frame_stream.h"
#include "fusion/curve_graph/strip_middles.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen while looking at training scans chair 3, furnished 1, rack 2, tree 2, umbrella 1 and
// vine 1 (docs/lab_notebook.md).
constexpr int kPixelStride = 2;             // every so many-th pixel of strips' middles
constexpr double kExplainedPx = 1.2;        // curves cover so much beside their outline
constexpr double kReachPx[2] = {3.5, 1.4};  // from a strip's middle: first look, close look
constexpr double kLargestFocal = 900;       // pixels; images beyond it are halved
constexpr double kSeen = 0.8;               // of the images that look at a wire show a strip there
constexpr double kMinChance = 0.02;         // that a strip lies there by chance, at least
constexpr double kCorrelation = 0.3;        // neighbouring images tell the same
constexpr double kMiddlePx = 0.7;           // standard deviation of where strips have their middle
// derived: log of the density of middles at zero over that of chance, even within reach
constexpr double kAtMiddle = 0.47;
constexpr double kMargin = 0.05;          // metres around what is known of the object
constexpr double kMarginShare = 0.25;     // likewise, of its size
constexpr int kRegionMarginPx = 16;       // strips' sides and what is averaged along them
constexpr double kNearest = 0.05;         // metres before a camera
constexpr float kHidingDistance = 0.03F;  // metres; noise and drift of depth come to less
constexpr float kFreeDistance = 0.02F;    // metres behind a wire; CurveFusion 4, assumption (i)
constexpr double kFreeShare = 0.8;        // of the images whose depth tells
constexpr int kCellPx = 4;                // of a colour image
constexpr int kAroundCells = 9;
constexpr double kDistanceUnits = 16;    // of the images of distances, in a pixel
constexpr double kFromTheSide = 0.15;    // sine of the angle between a curve and the line of sight
constexpr double kUsualSine = M_PI / 4;  // derived: of that angle, in the mean over directions
constexpr int kSameDirection = 43;       // 30 degrees, see DirectionUnits
constexpr int kMinLooks = 8;             // images that tell
constexpr double kAhead = 1e-3;          // metres, between which a direction is projected

cv::Mat AsMat(MaskImage& mask) { return {mask.height(), mask.width(), CV_8U, mask.data()}; }

Image<uint8_t> DistanceTo(const MaskImage& middles) {
  MaskImage others(middles.width(), middles.height());
  for (size_t i = 0; i < others.size(); ++i) others.data()[i] = middles.data()[i] ^ 1;
  cv::Mat distance;
  cv::distanceTransform(AsMat(others), distance, cv::DIST_L2, cv::DIST_MASK_3);
  Image<uint8_t> units(middles.width(), middles.height());
  for (int v = 0; v < middles.height(); ++v)
    for (int u = 0; u < middles.width(); ++u)
      units(u, v) =
          static_cast<uint8_t>(std::min(255.0, kDistanceUnits * distance.at<float>(v, u)));
  return units;
}

// What a strip within reach of a place tells, and none: logarithms of how much likelier that is for
// a wire than by chance, by the share of pixels around that have a strip within reach.
void SetEvidence(double reach_px, const Image<uint8_t>& to_strip, Image<float>& seen,
                 Image<float>& not_seen) {
  Image<float> shares((to_strip.width() + kCellPx - 1) / kCellPx,
                      (to_strip.height() + kCellPx - 1) / kCellPx);
  for (int v = 0; v < to_strip.height(); ++v)
    for (int u = 0; u < to_strip.width(); ++u)
      shares(u / kCellPx, v / kCellPx) += to_strip(u, v) <= reach_px * kDistanceUnits;
  seen = not_seen = Image<float>(shares.width(), shares.height());
  const cv::Mat from(shares.height(), shares.width(), CV_32F, shares.data());
  cv::Mat around;
  cv::blur(from / (kCellPx * kCellPx), around, cv::Size(kAroundCells, kAroundCells));
  for (int v = 0; v < shares.height(); ++v) {
    for (int u = 0; u < shares.width(); ++u) {
      const double chance = std::clamp<double>(around.at<float>(v, u), kMinChance, kSeen);
      seen(u, v) = static_cast<float>(std::log(kSeen / chance));
      not_seen(u, v) = static_cast<float>(std::log((1 - kSeen) / (1 - chance)));
    }
  }
}

// Of every pixel what the nearest middle has.
Image<uint8_t> FromNearest(const MaskImage& middles, const Image<uint8_t>& values) {
  MaskImage others(middles.width(), middles.height());
  for (size_t i = 0; i < others.size(); ++i) others.data()[i] = middles.data()[i] ^ 1;
  cv::Mat distance, labels;
  cv::distanceTransform(AsMat(others), distance, labels, cv::DIST_L2, 5, cv::DIST_LABEL_PIXEL);
  std::vector<uint8_t> of_label(middles.size() + 1, 0);
  for (int v = 0; v < middles.height(); ++v)
    for (int u = 0; u < middles.width(); ++u)
      if (middles(u, v)) of_label[labels.at<int>(v, u)] = values(u, v);
  Image<uint8_t> nearest(middles.width(), middles.height());
  for (int v = 0; v < middles.height(); ++v)
    for (int u = 0; u < middles.width(); ++u) nearest(u, v) = of_label[labels.at<int>(v, u)];
  return nearest;
}

void FindStrips(const MaskImage& middles, const Image<uint8_t>& directions,
                StripViews::View& view) {
  view.to_strip = DistanceTo(middles);
  view.direction = FromNearest(middles, directions);
  for (int look = 0; look < 2; ++look)
    SetEvidence(kReachPx[look], view.to_strip, view.seen[look], view.not_seen[look]);
  view.unexplained.clear();
  for (int v = 0; v < middles.height(); ++v) {
    for (int u = v % kPixelStride; u < middles.width(); u += kPixelStride) {
      if (middles(u, v)) view.unexplained.emplace_back(u, v);
    }
  }
}

template <typename Pixel>
Image<Pixel> Crop(const Image<Pixel>& image, const cv::Rect& region) {
  Image<Pixel> crop(region.width, region.height);
  for (int v = 0; v < region.height; ++v) {
    const Pixel* row = image.row(region.y + v) + region.x;
    std::copy(row, row + region.width, crop.row(v));
  }
  return crop;
}

template <typename Pixel>
Image<Pixel> Shrunk(const Image<Pixel>& image, const PinholeCamera& camera, int type) {
  if (image.width() == camera.width && image.height() == camera.height) return image;
  Image<Pixel> small(camera.width, camera.height);
  const cv::Mat from(image.height(), image.width(), type, const_cast<Pixel*>(image.data()));
  cv::Mat to(small.height(), small.width(), type, small.data());
  cv::resize(from, to, to.size(), 0, 0, cv::INTER_AREA);
  return small;
}

// What is looked at of an image: the part around the object.
struct Part {
  ColorImage color;
  PosteriorImage posterior;
};

template <typename Pixel>
void PutInto(Image<Pixel>& whole, const cv::Rect& region, const Image<Pixel>& part) {
  for (int v = 0; v < region.height; ++v)
    std::copy(part.row(v), part.row(v) + region.width, whole.row(region.y + v) + region.x);
}

// Finds the strips in a part of an image.
void FindStripsWithin(const cv::Rect& region, const Part& part, StripViews::View& view) {
  const int width = view.explained.width(), height = view.explained.height();
  MaskImage middles(width, height, 0);
  Image<uint8_t> directions(width, height, 0);
  if (!region.empty()) {
    const MaskImage found = StripMiddles(part.color, part.posterior, Crop(view.explained, region));
    PutInto(middles, region, found);
    PutInto(directions, region, StripDirections(part.color, found));
  }
  FindStrips(middles, directions, view);
}

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
    View& view = views_.emplace_back();
    view.T_depth_world = sequence.frames[frame.index].T_world_camera.inverse();
    view.T_color_world = sequence.T_color_depth * view.T_depth_world;
    view.center = view.T_color_world.inverse().translation();
    view.farthest = FarthestInCells(frame.depth);
    const auto place = std::lower_bound(frames.begin(), frames.end(), frame.index) - frames.begin();
    const cv::Rect region = RegionIn(view);
    parts.push_back({Crop(Shrunk(frame.color, color_camera_, CV_8UC3), region),
                     Crop(Shrunk(posteriors[place], color_camera_, CV_8U), region)});
  });
  ParallelFor(0, static_cast<int64_t>(views_.size()), 1, [&](int64_t i) {
    View& view = views_[i];
    view.explained = MaskImage(color_camera_.width, color_camera_.height, 0);
    FindStripsWithin(RegionIn(view), parts[i], view);
  });
}

PinholeCamera StripViews::CameraLookedThrough(const PinholeCamera& color_camera, double scale) {
  const double all = color_camera.fx > kLargestFocal ? 0.5 * scale : scale;
  return all == 1 ? color_camera : color_camera.Scaled(all);
}

// Where the bounds lie in an image.
cv::Rect StripViews::RegionIn(const View& view) const {
  const cv::Rect whole(0, 0, color_camera_.width, color_camera_.height);
  Eigen::AlignedBox2d box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p =
        view.T_color_world * bounds_.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner));
    if (p.z() < kNearest) return whole;
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
    MaskImage middles(view.explained.width(), view.explained.height());
    for (size_t k = 0; k < middles.size(); ++k)
      middles.data()[k] = view.to_strip.data()[k] == 0 && !view.explained.data()[k] ? 1 : 0;
    FindStrips(middles, Image<uint8_t>(view.direction), view);
  });
}

void StripViews::Explain(const Polyline& points, const std::vector<double>& radii) {
  ParallelFor(0, static_cast<int64_t>(views_.size()), 1,
              [&](int64_t i) { ExplainIn(views_[i], points, radii); });
}

void StripViews::ExplainIn(View& view, const Polyline& points,
                           const std::vector<double>& radii) const {
  cv::Mat target = AsMat(view.explained);
  cv::Point before;
  bool has_before = false;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = view.T_color_world * points[i];
    if (p.z() < kNearest) {
      has_before = false;
      continue;
    }
    const Eigen::Vector2i at = PinholeCamera::Rounded(color_camera_.Project(p));
    const double radius = radii.empty() ? 0 : radii[i];
    const double width = 2 * (radius * color_camera_.fx / p.z() + kExplainedPx);
    const cv::Point here(at.x(), at.y());
    cv::line(target, has_before ? before : here, here, cv::Scalar(1),
             static_cast<int>(std::ceil(width)));
    before = here;
    has_before = true;
  }
}

// What depth says of a place in one view: metres from it to the farthest thing there; 0 = nothing.
float StripViews::BehindIn(const View& view, const Vec3& p) const {
  const Vec3 p_depth = view.T_depth_world * p;
  if (p_depth.z() <= 0) return 0;
  const Vec2 pixel = depth_camera_.Project(p_depth);
  if (!depth_camera_.Contains(pixel)) return 0;
  const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
  const float farthest = view.farthest(at.x() / kDepthCellPx, at.y() / kDepthCellPx);
  return farthest > 0 ? farthest - static_cast<float>(p_depth.z()) : 0;
}

bool StripViews::Hides(const View& view, const Vec3& p) const {
  return BehindIn(view, p) < -kHidingDistance;
}

bool StripViews::IsFree(const Vec3& p) const {
  int told = 0, free = 0;
  for (const View& view : views_) {
    const float behind = BehindIn(view, p);
    told += behind != 0 && behind >= -kHidingDistance;
    free += behind > kFreeDistance;
  }
  return told > 0 && free >= kFreeShare * told;
}

// Whether the nearest strip runs as a line does that is seen at a pixel; one seen from its end runs
// anywhere.
bool StripViews::RunsAlong(const View& view, const Vec3& p_color, const Vec2& pixel,
                           const Vec3& direction) const {
  const Vec3 d = view.T_color_world.linear() * direction;
  if (d.cross(p_color.normalized()).norm() < kFromTheSide) return true;
  const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
  const Vec2 ahead = color_camera_.Project(Vec3(p_color + kAhead * d)) - pixel;
  const auto turn = static_cast<int8_t>(view.direction(at.x(), at.y()) -
                                        DirectionUnits(std::atan2(ahead.y(), ahead.x())));
  return std::abs(turn) <= kSameDirection;
}

// A curve that runs towards the camera is short in the image, which then tells little of its
// length.
double StripViews::ShareTold(const View& view, const Vec3& p_color, const Vec3& direction) const {
  const Vec3 d = view.T_color_world.linear() * direction;
  return std::min(1.0, d.cross(p_color.normalized()).norm() / kUsualSine);
}

StripAgreement StripViews::AgreementAt(const Vec3& p, int look, int stride,
                                       const Vec3* direction) const {
  StripAgreement agreement;
  for (size_t i = 0; i < views_.size(); i += static_cast<size_t>(stride)) {
    const View& view = views_[i];
    const Vec3 p_color = view.T_color_world * p;
    if (p_color.z() < kNearest) continue;
    const Vec2 pixel = color_camera_.Project(p_color);
    if (!color_camera_.Contains(pixel)) continue;
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    if (view.explained(at.x(), at.y()) || Hides(view, p)) continue;
    const double distance = view.to_strip(at.x(), at.y()) / kDistanceUnits;
    const bool seen = distance <= kReachPx[look] &&
                      (direction == nullptr || RunsAlong(view, p_color, pixel, *direction));
    const Image<float>& ratio = seen ? view.seen[look] : view.not_seen[look];
    const double told = direction == nullptr ? 1 : ShareTold(view, p_color, *direction);
    ++agreement.looked;
    agreement.seen += seen;
    agreement.evidence += stride * told * ratio(at.x() / kCellPx, at.y() / kCellPx);
    const double off = distance / kMiddlePx;
    if (seen) agreement.middle_evidence += told * (kAtMiddle - 0.5 * off * off);
  }
  agreement.evidence *= kCorrelation;
  agreement.middle_evidence *= kCorrelation;
  return agreement;
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
    const bool is_told = look.looked >= kMinLooks;
    shares.push_back(is_told ? static_cast<double>(look.seen) / look.looked : 1);
  }
  return shares;
}

}  // namespace curvefusion
