#include "fusion/curve_graph/candidate_curves.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fusion/curve_graph/candidate_proof.h"
#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/curve_graph/strip_snapping.h"
#include "fusion/curve_graph/tip_tracking.h"
#include "graph/connected_parts.h"
#include "graph/edge_curve.h"
#include "graph/edge_parts.h"
#include "graph/set_radius.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

// Chosen like those of colour_candidates.cpp.
constexpr double kBeside = 0.004;  // metres; nearer to a curve a candidate is the curve itself
constexpr double kSame = 0.0002;   // metres; a curve is where it was
// Chosen likewise, for gaps: strips are not told within some pixels of known curves, nor where
// wires cross in many images.
constexpr double kJoin = 0.004;           // metres; points of curves are nearer to each other
constexpr double kStep = 0.0015;          // metres
constexpr double kMaxGap = 0.06;          // metres
constexpr double kMaxGapPerLength = 1.2;  // of the curve that ends

std::vector<Vec3> PointsOf(const SkeletonGraph& skeleton) {
  std::vector<Vec3> points;
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& curve = skeleton.edge(id).points;
    points.insert(points.end(), curve.begin(), curve.end());
  }
  return points;
}

// Leaves what lies beside the points of known curves.
void KeepNewWires(const std::vector<Vec3>& known, SkeletonGraph& found) {
  const PointGrid curves(known, kBeside);
  for (const EdgeId id : found.Edges()) {
    const Polyline points = found.edge(id).points;
    const auto is_new = [&](size_t i) { return curves.Nearest(points[i], kBeside) < 0; };
    KeepParts(id, PartsWhere(points.size(), is_new), kMinPiece, found);
  }
  found.RemoveIsolatedNodes();
}

// Removes joins that images do not show: straight lines, as yet without points on them.
void DropJoinsNotShown(const std::vector<Vec3>& curves, const StripViews& views,
                       SkeletonGraph& skeleton) {
  for (const EdgeId id : skeleton.Edges()) {
    const Polyline& points = skeleton.edge(id).points;
    bool has_join = false;
    for (size_t i = 1; i < points.size(); ++i)
      has_join |= (points[i] - points[i - 1]).norm() > kJoin;
    if (!has_join) continue;
    SkeletonEdge dense = Resampled(skeleton.edge(id), kStep);
    skeleton.SetCurve(id, std::move(dense.points), std::move(dense.radii),
                      std::move(dense.observations));
  }
  const PointGrid known(curves, kJoin);
  const SharesOfCurve shares_of = [&](const Polyline& points) {
    std::vector<double> shares = views.SharesAlong(points);
    for (size_t i = 0; i < points.size(); ++i)
      if (known.Nearest(points[i], kJoin) >= 0) shares[i] = 1;
    return shares;
  };
  DropRefutedParts(shares_of, kMinStripShare, {}, skeleton);
}

// Removes parts of the graph in which nothing lies on the curves given.
void DropDetached(const std::vector<Vec3>& curves, SkeletonGraph& skeleton) {
  const PointGrid grid(curves, kBeside);
  const auto is_known = [&](EdgeId id) {
    const Polyline& points = skeleton.edge(id).points;
    return std::any_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return grid.Nearest(p, kSame) >= 0; });
  };
  for (const std::vector<EdgeId>& part : ConnectedEdges(skeleton)) {
    if (std::any_of(part.begin(), part.end(), is_known)) continue;
    for (const EdgeId id : part) skeleton.RemoveEdge(id);
  }
  skeleton.RemoveIsolatedNodes();
}

}  // namespace

AddedCurves AddCandidateCurves(const Sequence& sequence, const ObservedPoints& candidates,
                               const RidgeOptions& options, double radius, StripViews& views,
                               SkeletonGraph& skeleton) {
  const std::vector<Vec3> known = PointsOf(skeleton);
  if (candidates.empty()) return {};
  SkeletonGraph found = ExtractRidgeSkeleton(candidates, options);
  SnapToStrips(views, found);
  KeepNewWires(known, found);
  CandidateProof proof =
      KeepProvenCandidates(sequence, skeleton, candidates.positions, radius, views, found);
  AddedCurves added = {0, std::move(proof.stretches)};
  if (found.empty()) return added;
  const double length = skeleton.TotalLength();
  SetRadius(radius, found);
  Append(found, skeleton);
  TrackTips(radius, views, skeleton);
  FreeEndOptions reach = options.free_ends;
  reach.max_gap = kMaxGap;
  reach.max_gap_per_length = kMaxGapPerLength;
  const std::vector<Vec3> with_candidates = PointsOf(skeleton);
  CloseFreeEnds(skeleton, reach, candidates);
  DropJoinsNotShown(with_candidates, views, skeleton);
  std::vector<Vec3>& kept = proof.stand_alone;
  kept.insert(kept.end(), known.begin(), known.end());
  DropDetached(kept, skeleton);
  added.length = skeleton.TotalLength() - length;
  return added;
}

}  // namespace curvefusion
