#include "fusion/silhouettes/silhouette_continuations.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "graph/branch_continuations.h"

namespace curvefusion {

namespace {

// Chosen, kMinCovered on a rack and five chairs (training seeds): six false paths lie in a sheet,
// 23 true ones that meet a side on at most .37 of their places (docs/lab_notebook.md).
constexpr int kMaxRounds = 8;
constexpr double kStep = 0.002;         // metres
constexpr double kMinLength = 0.012;    // metres; shorter paths lie beside curves
constexpr double kEndReach = 0.008;     // metres; so near to its ends a path lies beside others
constexpr double kClearance = 0.004;    // metres
constexpr double kBeside = 0.008;       // metres; clear of the path itself
constexpr double kTargetReach = 0.005;  // metres; wires at its ends are next to it there
constexpr double kSheetStep = 0.001;    // metres
constexpr double kMinCovered = 0.8;     // of the path
constexpr double kMinAcross = 0.5;      // of a unit vector

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

// Whether images show wire on both sides of a curve along most of it, in a direction across: the
// curve lies in a sheet of wires that no image looks through, which shows any curve as wire.
bool IsInSheet(const WireSilhouettes& silhouettes, double min_share, const Polyline& curve,
               const Vec3& across) {
  const Vec3 along = (curve.back() - curve.front()).normalized();
  const Vec3 aside = across - across.dot(along) * along;
  if (aside.norm() < kMinAcross) return false;
  const Vec3 beside = kBeside * aside.normalized();
  int looked = 0, covered = 0;
  for (const Vec3& p : Resample(curve, kSheetStep)) {
    const bool is_inside =
        (p - curve.front()).norm() >= kTargetReach && (p - curve.back()).norm() >= kTargetReach;
    if (!is_inside) continue;
    ++looked;
    covered +=
        silhouettes.Share(p + beside) >= min_share && silhouettes.Share(p - beside) >= min_share;
  }
  return looked > 0 && covered >= kMinCovered * looked;
}

// Whether a path ends inside an edge, where it may cross a sheet of wires seen along their plane.
bool CrossesSheet(const WireSilhouettes& silhouettes, double min_share,
                  const SkeletonGraph& skeleton, const BranchContinuation& path) {
  if (path.to >= 0) return false;
  const Polyline& target = skeleton.edge(path.target.edge).points;
  const std::vector<double> arc_length = CumulativeLength(target);
  const Vec3 across = PointAt(target, arc_length, path.target.arc_length + kStep) -
                      PointAt(target, arc_length, path.target.arc_length - kStep);
  return IsInSheet(silhouettes, min_share, path.curve, across.normalized());
}

// Of all paths ahead those that are wire, each turned to where the images show it best.
std::vector<BranchContinuation> WiresAhead(const WireSilhouettes& silhouettes, double min_share,
                                           const SkeletonGraph& skeleton) {
  std::vector<BranchContinuation> wires;
  for (const BranchContinuation& path : FindContinuations(skeleton)) {
    double most = 0;
    BranchContinuation best;
    for (BranchContinuation& turned : WithShifts(skeleton, path)) {
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
  int count = 0;
  for (int round = 0; round < kMaxRounds; ++round) {
    const auto wires = WiresAhead(silhouettes, min_share, skeleton);
    if (wires.empty()) break;
    AddContinuations(skeleton, wires);
    count += static_cast<int>(wires.size());
  }
  return count;
}

}  // namespace curvefusion
