#include "fusion/silhouettes/silhouette_continuations.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "fusion/silhouettes/silhouette_rungs.h"
#include "graph/branch_continuations.h"

namespace curvefusion {

namespace {

constexpr int kMaxRounds = 8;
constexpr double kStep = 0.002;       // metres
constexpr double kMinLength = 0.012;  // metres; shorter ways lie beside curves
constexpr double kEndReach = 0.008;   // metres; so near to its ends a way lies beside others
constexpr double kClearance = 0.004;  // metres

// The least share of the images that show a place of a curve as wire.
double LeastShare(const WireSilhouettes& silhouettes, const Polyline& curve) {
  const std::vector<double> shares = silhouettes.SharesAlong(Resample(curve, kStep));
  return *std::min_element(shares.begin(), shares.end());
}

// Whether the inside of a curve comes near another.
bool RunsBeside(const Polyline& curve, const Polyline& other) {
  const std::vector<double> arc_length = CumulativeLength(curve);
  for (size_t i = 0; i < curve.size(); ++i) {
    if (std::min(arc_length[i], arc_length.back() - arc_length[i]) < kEndReach) continue;
    if (Project(other, curve[i]).distance < kClearance) return true;
  }
  return false;
}

// Whether a way ends inside an edge, where it may cross a sheet of wires seen along their plane.
bool CrossesSheet(const WireSilhouettes& silhouettes, double min_share,
                  const SkeletonGraph& skeleton, const BranchContinuation& way) {
  if (way.to >= 0) return false;
  const Polyline& target = skeleton.edge(way.target.edge).points;
  const std::vector<double> arc_length = CumulativeLength(target);
  const Vec3 across = PointAt(target, arc_length, way.target.arc_length + kStep) -
                      PointAt(target, arc_length, way.target.arc_length - kStep);
  return IsInSheet(silhouettes, min_share, way.curve, across.normalized());
}

// Of all ways ahead those that are wire, each turned to where the images show it best.
std::vector<BranchContinuation> WiresAhead(const WireSilhouettes& silhouettes, double min_share,
                                           const SkeletonGraph& skeleton,
                                           const ContinuationOptions& options) {
  std::vector<BranchContinuation> wires;
  for (const BranchContinuation& way : FindContinuations(skeleton, options)) {
    double most = 0;
    BranchContinuation best;
    for (BranchContinuation& turned : WithShifts(skeleton, way)) {
      const double least = LeastShare(silhouettes, turned.curve);
      if (least <= most) continue;
      most = least;
      best = std::move(turned);
    }
    if (most < min_share || Length(best.curve) < kMinLength ||
        CrossesSheet(silhouettes, min_share, skeleton, best))
      continue;
    const Polyline curve = Resample(best.curve, kStep);
    if (std::none_of(wires.begin(), wires.end(),
                     [&](const auto& wire) { return RunsBeside(curve, wire.curve); }))
      wires.push_back(std::move(best));
  }
  return wires;
}

}  // namespace

int ContinueWires(const WireSilhouettes& silhouettes, double min_share, SkeletonGraph& skeleton) {
  const ContinuationOptions options;
  int count = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto wires = WiresAhead(silhouettes, min_share, skeleton, options);
    if (wires.empty()) break;
    AddContinuations(skeleton, wires, options);
    count += static_cast<int>(wires.size());
  }
  return count;
}

}  // namespace curvefusion
