#pragma once

#include <array>
#include <vector>

#include "fusion/silhouettes/wire_silhouettes.h"
#include "graph/skeleton_graph.h"

namespace curvefusion {

/// A piece of wire that has been added.
struct FoundPiece {
  std::array<NodeId, 2> ends;
  double length = 0;  ///< metres
};

/// Adds curves where the images show wire that no curve of the skeleton accounts for: places around
/// the skeleton that (nearly) all images show as wire and some of them beside all projected curves.
/// What hangs together of them becomes a straight piece with free ends, where it is as thin as a
/// wire; JoinEndsToSides and BridgeOpenEnds carry the pieces on. Nothing where all images look from
/// about the same side, which tells no depth. Needs radii.
std::vector<FoundPiece> AddUnexplainedWires(const WireSilhouettes& silhouettes,
                                            SkeletonGraph& skeleton);

}  // namespace curvefusion
