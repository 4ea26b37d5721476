#include "fusion/silhouettes/view_evidence.h"

#include <algorithm>
#include <cmath>

#include "capture/depth_noise.h"
#include "capture/frame_stream.h"
#include "fusion/curve_graph/strip_views.h"
#include "fusion/strips/radius.h"
#include "graph/sampled_curves.h"
#include "kernel/point_grid.h"
#include "kernel/polyline.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kSampling = 0.003;  // metres; chosen: of curves that may lie near a place
// chosen (lampshade, basket, umbrella, of white wires): at half of the images, or 20 mm clear of
// others, wires in the shade are cut that depth shows; at a tenth nothing more is kept.
constexpr double kShownShare = 0.25;
constexpr double kClear = 0.01;  // metres
constexpr int kMinSeen = StripAgreement::kMinLooks;

enum class Sight { kOutside, kHidden, kMissed, kSeen };

// Looks at the pixels around the projection of a point on a wire's axis.
Sight LookAt(const DepthImage& depth, const PinholeCamera& camera, const Vec3& p_camera,
             double radius, double tolerance) {
  if (p_camera.z() <= radius) return Sight::kOutside;
  const Vec2 pixel = camera.Project(p_camera);
  if (!camera.Contains(pixel)) return Sight::kOutside;
  const double near_side = p_camera.z() - radius;
  const double reach = camera.fx * radius / p_camera.z() + kBesidePx;
  const int u0 = std::max(0, static_cast<int>(std::ceil(pixel.x() - reach)));
  const int u1 = std::min(depth.width() - 1, static_cast<int>(std::floor(pixel.x() + reach)));
  const int v0 = std::max(0, static_cast<int>(std::ceil(pixel.y() - reach)));
  const int v1 = std::min(depth.height() - 1, static_cast<int>(std::floor(pixel.y() + reach)));
  double farthest = 0;
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) {
      const double measured = depth(u, v);
      if (!(measured > 0)) continue;
      if (std::abs(measured - near_side) <= tolerance) return Sight::kSeen;
      farthest = std::max(farthest, measured);
    }
  }
  return farthest > 0 && farthest < near_side ? Sight::kHidden : Sight::kMissed;
}

void LookThroughFrame(const DecodedFrame& frame, const Sequence& sequence,
                      const SkeletonGraph& skeleton, double tolerance, ViewEvidence& evidence) {
  const RigidTransform T_camera_world = sequence.frames[frame.index].T_world_camera.inverse();
  for (EdgeViews& views : evidence.edges) {
    const SkeletonEdge& edge = skeleton.edge(views.edge);
    for (size_t i = 0; i < edge.points.size(); ++i) {
      const double radius = edge.radii.empty() ? kUnknownRadius : edge.radii[i];
      const Sight sight = LookAt(frame.depth, sequence.depth_camera,
                                 T_camera_world * edge.points[i], radius, tolerance);
      views.points[i].looked += sight == Sight::kSeen || sight == Sight::kMissed;
      views.points[i].seen += sight == Sight::kSeen;
    }
  }
}

}  // namespace

ViewEvidence CountViews(const SkeletonGraph& skeleton, const Sequence& sequence,
                        const ViewEvidenceOptions& options) {
  ViewEvidence evidence;
  for (const EdgeId id : skeleton.Edges()) {
    evidence.edges.push_back({id, std::vector<ViewCount>(skeleton.edge(id).points.size())});
  }
  if (evidence.edges.empty()) return evidence;
  if (!sequence.has_depth) return evidence;
  const std::vector<int> frames = EvenlyThinned(AllFrames(sequence), options.max_frames);
  evidence.frames = static_cast<int>(frames.size());
  ForEachFrame(sequence, frames, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    LookThroughFrame(frame, sequence, skeleton, options.tolerance, evidence);
  });
  return evidence;
}

ViewCount TypicalViews(const std::vector<ViewCount>& points) {
  std::vector<double> looked, seen;
  for (const ViewCount& point : points) {
    looked.push_back(point.looked);
    seen.push_back(point.seen);
  }
  if (points.empty()) return {};
  return {static_cast<int>(Median(std::move(looked))), static_cast<int>(Median(std::move(seen)))};
}

std::vector<Vec3> PlacesShownByDepth(const ViewEvidence& evidence, const SkeletonGraph& skeleton) {
  const SampledCurves samples = SampleCurvesOf(skeleton, kSampling);
  const PointGrid grid(samples.positions, kClear);
  std::vector<Vec3> shown;
  for (const EdgeViews& views : evidence.edges) {
    const Polyline& points = skeleton.edge(views.edge).points;
    const std::vector<double> arc_lengths = CumulativeLength(points);
    for (size_t i = 0; i < points.size(); ++i) {
      const ViewCount& count = views.points[i];
      if (count.seen < kMinSeen || count.seen < kShownShare * count.looked) continue;
      bool is_clear = true;
      grid.ForEachWithin(points[i], kClear, [&](int other, const Vec3&) {
        const CurveLocation& at = samples.locations[other];
        is_clear = is_clear && at.edge == views.edge &&
                   std::abs(at.arc_length - arc_lengths[i]) < 2 * kClear;
      });
      if (is_clear) shown.push_back(points[i]);
    }
  }
  return shown;
}

void AssignObservations(const ViewEvidence& evidence, SkeletonGraph& skeleton) {
  for (const EdgeViews& views : evidence.edges) {
    const SkeletonEdge& edge = skeleton.edge(views.edge);
    std::vector<double> observations;
    for (const ViewCount& point : views.points) observations.push_back(point.seen);
    skeleton.SetCurve(views.edge, edge.points, edge.radii, std::move(observations));
  }
}

void VisitOptions(ViewEvidenceOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"max_frames", "frames", 1, 1000000,
                 "Depth images in which the result is looked for, to say how often each part of it "
                 "was seen; more are thinned evenly."},
                options.max_frames);
  visitor.Visit({"tolerance", "m", 0.001, 0.1,
                 "A depth this near to the wire is one of it: drift and noise of far wires "
                 "together."},
                options.tolerance);
  visitor.Visit({"min_probability", "", 0, 0.99,
                 "Curves that are wires with less than this probability, by all that depth and "
                 "colour images show of them, go to uncertain.json; 0 = none do."},
                options.min_probability);
}

}  // namespace curvefusion
