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
constexpr double kEndReach = 0.005;  // metres; the wires at its ends are next to it there
constexpr double kStep = 0.001;      // metres
constexpr double kMinCovered = 0.8;  // of the rung
constexpr double kMinAcross = 0.5;   // of the sum of four unit vectors

// Across a rung, in the plane of the wires at its ends; zero where they do not run across.
Vec3 AcrossRung(const SkeletonGraph& skeleton, EdgeId rung) {
  const SkeletonEdge& edge = skeleton.edge(rung);
  Vec3 sum = Vec3::Zero();
  for (const NodeId node : edge.nodes) {
    for (const OpenEnd& wire : EndsAt(skeleton, node, kEndPiece)) {
      if (wire.edge == rung) continue;
      sum += wire.outward.dot(sum) < 0 ? Vec3(-wire.outward) : wire.outward;
    }
  }
  const Vec3 along = (edge.points.back() - edge.points.front()).normalized();
  const Vec3 across = sum - sum.dot(along) * along;
  return across.norm() < kMinAcross ? Vec3(Vec3::Zero()) : Vec3(across.normalized());
}

bool IsInSheet(const WireSilhouettes& silhouettes, double min_share, const SkeletonGraph& skeleton,
               EdgeId rung) {
  const Polyline& points = skeleton.edge(rung).points;
  const Vec3 beside = kBeside * AcrossRung(skeleton, rung);
  if (beside.isZero()) return false;
  int looked = 0, covered = 0;
  for (const Vec3& p : Resample(points, kStep)) {
    if ((p - points.front()).norm() < kEndReach || (p - points.back()).norm() < kEndReach) continue;
    ++looked;
    covered +=
        silhouettes.Share(p + beside) >= min_share && silhouettes.Share(p - beside) >= min_share
            ? 1
            : 0;
  }
  return looked > 0 && covered >= kMinCovered * looked;
}

}  // namespace

int DropRungsInSheets(const WireSilhouettes& silhouettes, double min_share,
                      SkeletonGraph& skeleton) {
  std::map<EdgeId, int> ends;  // that nothing continues, at junctions
  for (const OpenEnd& end : OpenEnds(skeleton, kEndPiece)) ends[end.edge] += end.is_free ? 0 : 1;
  std::vector<EdgeId> rungs;
  for (const auto& [edge, open] : ends) {
    if (open == 2 && Length(skeleton.edge(edge).points) <= kMaxRung &&
        IsInSheet(silhouettes, min_share, skeleton, edge))
      rungs.push_back(edge);
  }
  for (const EdgeId rung : rungs) skeleton.RemoveEdge(rung);
  skeleton.DissolveDegree2Nodes();
  return static_cast<int>(rungs.size());
}

}  // namespace curvefusion
