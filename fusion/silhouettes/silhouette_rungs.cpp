#include "fusion/silhouettes/silhouette_rungs.h"

#include <map>
#include <vector>

#include "graph/open_ends.h"
#include "kernel/polyline.h"

namespace curvefusion {

namespace {

constexpr EndPiece kEndPiece{.length = 0.015};
constexpr double kMaxRung = 0.035;   // metres; farther apart, depth tells wires from one another
constexpr double kBeside = 0.008;    // metres; clear of the rung itself
constexpr double kEndReach = 0.005;  // metres; wires at its ends are next to it there
constexpr double kStep = 0.001;      // metres
constexpr double kMinCovered = 0.8;  // of the curve
constexpr double kMinAcross = 0.5;   // of a unit vector, or the sum of four

// The sum of the directions of the wires at both ends of a rung.
Vec3 WiresAt(const SkeletonGraph& skeleton, EdgeId rung) {
  Vec3 sum = Vec3::Zero();
  for (const NodeId node : skeleton.edge(rung).nodes) {
    for (const OpenEnd& wire : EndsAt(skeleton, node, kEndPiece)) {
      if (wire.edge == rung) continue;
      sum += wire.outward.dot(sum) < 0 ? Vec3(-wire.outward) : wire.outward;
    }
  }
  return sum;
}

}  // namespace

bool IsInSheet(const WireSilhouettes& silhouettes, double min_share, const Polyline& curve,
               const Vec3& across) {
  const Vec3 along = (curve.back() - curve.front()).normalized();
  const Vec3 aside = across - across.dot(along) * along;
  if (aside.norm() < kMinAcross) return false;
  const Vec3 beside = kBeside * aside.normalized();
  int looked = 0, covered = 0;
  for (const Vec3& p : Resample(curve, kStep)) {
    if ((p - curve.front()).norm() < kEndReach || (p - curve.back()).norm() < kEndReach) continue;
    ++looked;
    covered +=
        silhouettes.Share(p + beside) >= min_share && silhouettes.Share(p - beside) >= min_share
            ? 1
            : 0;
  }
  return looked > 0 && covered >= kMinCovered * looked;
}

int DropRungsInSheets(const WireSilhouettes& silhouettes, double min_share,
                      SkeletonGraph& skeleton) {
  std::map<EdgeId, int> ends;  // that nothing continues, at junctions
  for (const OpenEnd& end : OpenEnds(skeleton, kEndPiece)) ends[end.edge] += end.is_free ? 0 : 1;
  std::vector<EdgeId> rungs;
  for (const auto& [edge, open] : ends) {
    if (open == 2 && Length(skeleton.edge(edge).points) <= kMaxRung &&
        IsInSheet(silhouettes, min_share, skeleton.edge(edge).points, WiresAt(skeleton, edge)))
      rungs.push_back(edge);
  }
  for (const EdgeId rung : rungs) skeleton.RemoveEdge(rung);
  skeleton.DissolveDegree2Nodes();
  return static_cast<int>(rungs.size());
}

}  // namespace curvefusion
