#pragma once

#include <array>
#include <vector>

#include "graph/skeleton_graph.h"
#include "meshing/tube_axis.h"

namespace curvefusion {

/// A stretch of tube that can be swept without folding, between two nodes (dense indices).
struct TubeBranch {
  std::array<int, 2> nodes{};
  TubeAxis axis;  ///< runs from nodes[0] to nodes[1]
  int curve = 0;  ///< of TubeNetwork::curves, of which it is a simplified part
};

/// One end of a branch: side 0 is axis.points.front(), side 1 the back.
struct BranchEnd {
  int branch = 0;
  int side = 0;
};

/// What the tubes of a skeleton are swept along.
struct TubeNetwork {
  int node_count = 0;
  std::vector<TubeBranch> branches;
  std::vector<TubeAxis> curves;  ///< as given, without repeated points

  /// The branch ends at every node; a loop stands there twice.
  std::vector<std::vector<BranchEnd>> EndsAtNodes() const;
};

/// Prepares a skeleton for sweeping: nodes at the same place, or joined by an edge shorter than
/// 0.15 radii, become one; degree-2 nodes are dissolved; curves are simplified and cut where they
/// turn by more than `max_turn` or more tightly than the tube is thick; a branch that lies inside
/// another between the same nodes is dropped. Edges without radii get `default_radius`. Throws
/// Error(kBadInput) for coordinates or radii that are not finite, radii that are not positive, or
/// ones too thin for float32 coordinates at their distance from the origin.
TubeNetwork PrepareTubes(const SkeletonGraph& graph, double default_radius,
                         const AxisOptions& options);

}  // namespace curvefusion
