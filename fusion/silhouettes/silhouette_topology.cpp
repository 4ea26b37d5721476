#include "fusion/silhouettes/silhouette_topology.h"

#include <utility>
#include <vector>

#include "fusion/curve_graph/refuted_parts.h"
#include "fusion/silhouettes/silhouette_continuations.h"
#include "graph/corners.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen: nearly all images show places of true curves of simulated scans as wire, at most .65 of
// them those of false links (docs/topology.md#why-it-works).
constexpr double kTrustedShare = 0.9;
// Radians; chosen: contraction rounds where wires meet at right angles.
constexpr double kCorner = 0.64;

}  // namespace

void VisitOptions(SilhouetteOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"max_frames", "frames", 0, 1000000,
                 "Deviation: images in whose silhouettes curves are looked for; more are thinned "
                 "evenly, 0 = none."},
                options.max_frames);
  visitor.Visit(
      {"min_share", "", 0, 1,
       "Deviation: without an adjustment to colours, parts of close wires that a smaller share of "
       "the images shows as wire are false."},
      options.min_share);
  visitor.Visit(
      {"max_bridge", "m", 0, 1,
       "Deviation: the longest path that silhouettes may show where depth shows none of it or "
       "little: between ends, ahead of one, or along the line of sight."},
      options.bridges.max_length);
  visitor.Visit({"min_bridge_share", "", 0, 1,
                 "Deviation: the least share of images that must show every place of a bridge."},
                options.bridges.min_share);
}

bool TellWires(const WireSilhouettes& silhouettes, const SkeletonGraph& skeleton) {
  std::vector<double> shares;
  for (const EdgeId id : skeleton.Edges()) {
    const std::vector<double> along = silhouettes.SharesAlong(skeleton.edge(id).points);
    shares.insert(shares.end(), along.begin(), along.end());
  }
  return !shares.empty() && Median(std::move(shares)) >= kTrustedShare;
}

SilhouetteChanges CorrectTopology(const WireSilhouettes& silhouettes, const SharesOfCurve& strips,
                                  const SilhouetteOptions& options,
                                  const std::vector<Vec3>& shown_by_depth,
                                  SkeletonGraph& skeleton) {
  SilhouetteChanges changes;
  changes.removed = DropRefutedParts(strips, kMinStripShare, shown_by_depth, skeleton);
  changes.continued = ContinueWires(silhouettes, options.bridges.min_share, skeleton);
  SplitAtCorners(skeleton, kCorner);
  changes.bridges = BridgeOpenEnds(silhouettes, options.bridges, skeleton);
  changes.joins = JoinEndsToSides(silhouettes, options.bridges, skeleton);
  return changes;
}

}  // namespace curvefusion
