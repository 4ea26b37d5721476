#include "fusion/curve_graph/colour_candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "capture/frame_stream.h"
#include "fusion/curve_graph/strip_middles.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// All chosen while looking at training scans chair 3, furnished 1, rack 2, tree 2, umbrella 1 and
// vine 1 (docs/lab_notebook.md).
constexpr int kViews = 40;              // images that are asked
constexpr int kReferenceStride = 3;     // of these, lines of sight start in every so many-th
constexpr int kCoarseStride = 3;        // and a first look is taken in every so many-th
constexpr int kPixelStride = 2;         // every so many-th pixel of strips' middles
constexpr double kExplainedPx = 3;      // curves cover so much beside their outline
constexpr double kCoarsePx = 3;         // steps along a line of sight, in the view that moves most
constexpr double kFinePx = 0.5;         // likewise
constexpr double kCoarseReachPx = 3.5;  // from a strip's middle
constexpr double kFineReachPx = 1.4;
constexpr double kMiddlePx = 0.7;      // standard deviation of where strips have their middle
constexpr double kSeen = 0.8;          // of the images that look at a wire show a strip there
constexpr double kMinChance = 0.02;    // that a strip lies there by chance, at least
constexpr double kCorrelation = 0.3;   // neighbouring images tell the same
constexpr double kCoarseEvidence = 1;  // least log-likelihood ratio
constexpr double kFineEvidence = 3.5;
constexpr double kAmbiguous = 1.5;     // less of it between two places of one line of sight
constexpr double kMinBaseline = 0.02;  // metres
constexpr double kMaxPeak = 0.015;     // metres; longer stretches tell no place
constexpr int kMinLooks = 8;
constexpr double kMargin = 0.05;          // metres around what is known of the object
constexpr double kMarginShare = 0.25;     // likewise, of its size
constexpr float kHidingDistance = 0.03F;  // metres; noise and drift of depth come to less
constexpr float kFreeDistance = 0.02F;    // metres behind a wire; CurveFusion 3, assumption (i)
constexpr double kFreeShare = 0.8;        // of the images whose depth tells
constexpr int kCellPx = 4;
constexpr double kDistanceUnits = 16;  // of the images of distances, in a pixel

using DistanceImage = Image<uint8_t>;

cv::Mat AsMat(MaskImage& mask) { return {mask.height(), mask.width(), CV_8U, mask.data()}; }

Image<float> DistanceToZero(MaskImage& mask) {
  Image<float> distance(mask.width(), mask.height());
  cv::Mat to(mask.height(), mask.width(), CV_32F, distance.data());
  cv::distanceTransform(AsMat(mask), to, cv::DIST_L2, cv::DIST_MASK_3);
  return distance;
}

DistanceImage DistanceTo(const MaskImage& crests) {
  MaskImage others(crests.width(), crests.height());
  for (size_t i = 0; i < others.size(); ++i) others.data()[i] = crests.data()[i] ^ 1;
  const Image<float> distance = DistanceToZero(others);
  DistanceImage units(crests.width(), crests.height());
  for (size_t i = 0; i < units.size(); ++i)
    units.data()[i] = static_cast<uint8_t>(std::min(255.0, kDistanceUnits * distance.data()[i]));
  return units;
}

// The greatest depth within each cell: thin things in front hide nothing.
Image<float> FarthestInCells(const DepthImage& depth) {
  Image<float> cells((depth.width() + kCellPx - 1) / kCellPx,
                     (depth.height() + kCellPx - 1) / kCellPx);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      float& cell = cells(u / kCellPx, v / kCellPx);
      cell = std::max(cell, depth(u, v));
    }
  }
  return cells;
}

// What a strip within reach of a place tells, and none: logarithms of how much likelier that is for
// a wire than by chance, by the share of pixels around that have a strip within reach.
struct StripEvidence {
  Image<float> seen;  // in cells
  Image<float> not_seen;
};

StripEvidence EvidenceWithin(const DistanceImage& to_crest, double reach_px) {
  constexpr int kAround = 9;  // cells
  StripEvidence evidence;
  Image<float> shares((to_crest.width() + kCellPx - 1) / kCellPx,
                      (to_crest.height() + kCellPx - 1) / kCellPx);
  for (int v = 0; v < to_crest.height(); ++v)
    for (int u = 0; u < to_crest.width(); ++u)
      shares(u / kCellPx, v / kCellPx) += to_crest(u, v) <= reach_px * kDistanceUnits;
  evidence.seen = evidence.not_seen = Image<float>(shares.width(), shares.height());
  const cv::Mat from(shares.height(), shares.width(), CV_32F, shares.data());
  cv::Mat around;
  cv::blur(from / (kCellPx * kCellPx), around, cv::Size(kAround, kAround));
  for (int v = 0; v < shares.height(); ++v) {
    for (int u = 0; u < shares.width(); ++u) {
      const double chance = std::clamp<double>(around.at<float>(v, u), kMinChance, kSeen);
      evidence.seen(u, v) = static_cast<float>(std::log(kSeen / chance));
      evidence.not_seen(u, v) = static_cast<float>(std::log((1 - kSeen) / (1 - chance)));
    }
  }
  return evidence;
}

struct View {
  RigidTransform T_depth_world;
  RigidTransform T_color_world;
  Vec3 center;
  MaskImage explained;  // by curves
  DistanceImage to_crest;
  StripEvidence coarse;
  StripEvidence fine;
  Image<float> farthest;                     // in cells of the depth image, metres
  std::vector<Eigen::Vector2i> unexplained;  // some middles of strips that no curve covers
};

// How many images look at a place, and how many of them show the middle of a strip there.
struct Agreement {
  int looked = 0;
  int seen = 0;
  double distances = 0;  // squared, of those, pixels
  double evidence = 0;   // the logarithm of how much likelier that is for a wire
};

// A place of a line of sight where a wire may be.
struct Peak {
  Vec3 position;
  Agreement agreement;
  double first = 0, last = 0;  // of the stretch that agrees, metres along the line of sight
};

class CandidateSearch {
 public:
  CandidateSearch(const SkeletonGraph& skeleton, const Sequence& sequence,
                  const std::vector<int>& frames, const std::vector<PosteriorImage>& posteriors)
      : depth_camera_(sequence.depth_camera), color_camera_(sequence.color_camera) {
    for (const EdgeId id : skeleton.Edges()) {
      for (const Vec3& p : skeleton.edge(id).points) bounds_.extend(p);
    }
    const Vec3 margin = Vec3::Constant(kMargin + kMarginShare * bounds_.diagonal().norm());
    bounds_.min() -= margin;
    bounds_.max() += margin;
    const std::vector<int> used = EvenlyThinned(frames, kViews);
    std::vector<ColorImage> images;
    ForEachFrame(sequence, used, {.depth = true, .color = true}, [&](const DecodedFrame& frame) {
      View& view = views_.emplace_back();
      view.T_depth_world = sequence.frames[frame.index].T_world_camera.inverse();
      view.T_color_world = sequence.T_color_depth * view.T_depth_world;
      view.center = view.T_color_world.inverse().translation();
      view.farthest = FarthestInCells(frame.depth);
      images.push_back(frame.color);
    });
    ParallelFor(0, static_cast<int64_t>(views_.size()), 1, [&](int64_t i) {
      const auto place = std::lower_bound(frames.begin(), frames.end(), used[i]) - frames.begin();
      views_[i].explained = Explained(skeleton, views_[i]);
      FindStrips(StripMiddles(images[i], posteriors[place], views_[i].explained), views_[i]);
    });
  }

  ObservedPoints Find() const {
    std::vector<std::pair<size_t, Eigen::Vector2i>> rays;
    for (size_t i = 0; i < views_.size(); i += kReferenceStride) {
      for (const Eigen::Vector2i& pixel : views_[i].unexplained) rays.emplace_back(i, pixel);
    }
    std::vector<std::optional<Peak>> places(rays.size());
    ParallelFor(0, static_cast<int64_t>(rays.size()), 16,
                [&](int64_t i) { places[i] = PlaceOn(views_[rays[i].first], rays[i].second); });
    ObservedPoints points;
    for (size_t i = 0; i < rays.size(); ++i) {
      if (!places[i]) continue;
      const Vec3& p = places[i]->position;
      points.Add(p, (p - views_[rays[i].first].center).normalized(),
                 static_cast<float>(places[i]->agreement.seen));
    }
    return points;
  }

 private:
  static void FindStrips(const MaskImage& strips, View& view) {
    view.to_crest = DistanceTo(strips);
    view.coarse = EvidenceWithin(view.to_crest, kCoarseReachPx);
    view.fine = EvidenceWithin(view.to_crest, kFineReachPx);
    for (int v = 0; v < strips.height(); ++v) {
      for (int u = v % kPixelStride; u < strips.width(); u += kPixelStride) {
        if (strips(u, v)) view.unexplained.emplace_back(u, v);
      }
    }
  }

  MaskImage Explained(const SkeletonGraph& skeleton, const View& view) const {
    MaskImage mask(color_camera_.width, color_camera_.height, 0);
    cv::Mat target = AsMat(mask);
    for (const EdgeId id : skeleton.Edges()) {
      const SkeletonEdge& edge = skeleton.edge(id);
      std::optional<cv::Point> before;
      for (size_t i = 0; i < edge.points.size(); ++i) {
        const Vec3 p = view.T_color_world * edge.points[i];
        if (p.z() < kMargin) {
          before.reset();
          continue;
        }
        const Eigen::Vector2i at = PinholeCamera::Rounded(color_camera_.Project(p));
        const double radius = edge.radii.empty() ? 0 : edge.radii[i];
        const double width = 2 * (radius * color_camera_.fx / p.z() + kExplainedPx);
        const cv::Point here(at.x(), at.y());
        cv::line(target, before.value_or(here), here, cv::Scalar(1),
                 static_cast<int>(std::ceil(width)));
        before = here;
      }
    }
    return mask;
  }

  // What depth says of a place in one view: metres from it to the farthest thing there; 0 =
  // nothing.
  float BehindIn(const View& view, const Vec3& p) const {
    const Vec3 p_depth = view.T_depth_world * p;
    if (p_depth.z() <= 0) return 0;
    const Vec2 pixel = depth_camera_.Project(p_depth);
    if (!depth_camera_.Contains(pixel)) return 0;
    const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
    const float farthest = view.farthest(at.x() / kCellPx, at.y() / kCellPx);
    return farthest > 0 ? farthest - static_cast<float>(p_depth.z()) : 0;
  }

  Agreement AgreementAt(const Vec3& p, bool fine) const {
    const double reach_px = fine ? kFineReachPx : kCoarseReachPx;
    const int stride = fine ? 1 : kCoarseStride;
    Agreement agreement;
    for (size_t i = 0; i < views_.size(); i += static_cast<size_t>(stride)) {
      const View& view = views_[i];
      const Vec3 p_color = view.T_color_world * p;
      if (p_color.z() < kMargin) continue;
      const Vec2 pixel = color_camera_.Project(p_color);
      if (!color_camera_.Contains(pixel)) continue;
      const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
      if (view.explained(at.x(), at.y())) continue;
      const double distance = view.to_crest(at.x(), at.y()) / kDistanceUnits;
      const bool seen = distance <= reach_px;
      if (!seen && BehindIn(view, p) < -kHidingDistance) continue;
      const StripEvidence& evidence = fine ? view.fine : view.coarse;
      const Image<float>& told = seen ? evidence.seen : evidence.not_seen;
      ++agreement.looked;
      agreement.seen += seen;
      agreement.evidence += stride * told(at.x() / kCellPx, at.y() / kCellPx);
      if (seen) agreement.distances += distance * distance;
    }
    agreement.evidence *= agreement.looked * stride < kMinLooks ? 0 : kCorrelation;
    return agreement;
  }

  // Whether depth shows something farther behind a place in most of the images in which it tells.
  bool IsFree(const Vec3& p) const {
    int told = 0, free = 0;
    for (const View& view : views_) {
      const float behind = BehindIn(view, p);
      told += behind != 0;
      free += behind > kFreeDistance;
    }
    return free >= kFreeShare * told;
  }

  // The greatest distance of another camera from a line of sight, metres; not zero.
  double Baseline(const View& view, const Vec3& ray) const {
    double most = kMinBaseline;
    for (const View& other : views_)
      most = std::max(most, ray.cross(other.center - view.center).norm());
    return most;
  }

  // Metres along a line of sight by which a place moves so many pixels in the view where it moves
  // most.
  double Step(double distance, double baseline, double pixels) const {
    return pixels * distance * distance / (color_camera_.fx * baseline);
  }

  // The best place within a stretch of a line of sight.
  Peak Refined(const View& view, const Vec3& ray, double baseline, double from, double to) const {
    Peak peak;
    const double step = Step(0.5 * (from + to), baseline, kFinePx);
    double best = -1;
    peak.first = to;
    for (double at = from; at <= to; at += step) {
      const Vec3 p = view.center + at * ray;
      const Agreement agreement = AgreementAt(p, true);
      if (agreement.evidence < kFineEvidence) continue;
      peak.first = std::min(peak.first, at);
      peak.last = at;
      const double score =
          agreement.evidence - 0.5 * kCorrelation * agreement.distances / (kMiddlePx * kMiddlePx);
      if (score <= best) continue;
      best = score;
      peak.position = p;
      peak.agreement = agreement;
    }
    return peak;
  }

  // The place of the wire that a pixel shows, and how many images show it.
  std::optional<Peak> PlaceOn(const View& view, const Eigen::Vector2i& pixel) const {
    const RigidTransform T_world_color = view.T_color_world.inverse();
    const Vec3 ray =
        (T_world_color.linear() * color_camera_.Unproject(pixel.x(), pixel.y(), 1)).normalized();
    const auto range = RangeWithin(view.center, ray);
    if (!range) return std::nullopt;
    const double baseline = Baseline(view, ray);
    std::vector<Peak> peaks;
    double begin = -1;  // of a stretch that agrees roughly
    for (double at = range->first; at <= range->second;) {
      const Vec3 p = view.center + at * ray;
      if (BehindIn(view, p) < -kHidingDistance) break;
      const double step = Step(at, baseline, kCoarsePx);
      const bool agrees = AgreementAt(p, false).evidence >= kCoarseEvidence;
      if (agrees && begin < 0) begin = at - step;
      if (!agrees && begin >= 0) {
        AddPeak(Refined(view, ray, baseline, begin, at), peaks);
        begin = -1;
      }
      at += step;
    }
    if (begin >= 0) AddPeak(Refined(view, ray, baseline, begin, range->second), peaks);
    if (peaks.empty()) return std::nullopt;
    std::sort(peaks.begin(), peaks.end(), [](const Peak& a, const Peak& b) {
      return a.agreement.evidence > b.agreement.evidence;
    });
    const Peak& best = peaks.front();
    const bool is_ambiguous =
        peaks.size() > 1 && peaks[1].agreement.evidence > best.agreement.evidence - kAmbiguous;
    if (is_ambiguous || best.last - best.first > kMaxPeak || !IsFree(best.position)) {
      return std::nullopt;
    }
    return best;
  }

  static void AddPeak(const Peak& peak, std::vector<Peak>& peaks) {
    if (peak.agreement.seen > 0) peaks.push_back(peak);
  }

  // Where a line enters and leaves the bounds, metres from its start.
  std::optional<std::pair<double, double>> RangeWithin(const Vec3& start, const Vec3& ray) const {
    double from = kMargin, to = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(ray[axis]) < 1e-9) continue;
      double a = (bounds_.min()[axis] - start[axis]) / ray[axis];
      double b = (bounds_.max()[axis] - start[axis]) / ray[axis];
      if (a > b) std::swap(a, b);
      from = std::max(from, a);
      to = std::min(to, b);
    }
    if (from >= to) return std::nullopt;
    return std::pair(from, to);
  }

  PinholeCamera depth_camera_;
  PinholeCamera color_camera_;
  Eigen::AlignedBox3d bounds_;
  std::vector<View> views_;
};

}  // namespace

ObservedPoints FindColourCandidates(const SkeletonGraph& skeleton, const Sequence& sequence,
                                    const std::vector<int>& frames,
                                    const std::vector<PosteriorImage>& posteriors) {
  if (skeleton.empty() || frames.empty()) return {};
  return CandidateSearch(skeleton, sequence, frames, posteriors).Find();
}

}  // namespace curvefusion
