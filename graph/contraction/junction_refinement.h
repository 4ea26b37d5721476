#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/options.h"

namespace curvefusion {

/// How junctions are placed. Deviation: CurveFusion 4.2 takes the cluster of non-branch points as
/// the junction, which blurs it by the kernel's width.
struct JunctionRefinementOptions {
  double inner_radius = 0.007;
  double fit_length = 0.018;  ///< metres: length of the lines fitted to branches beyond that
  double reach = 0.025;
  double merge_distance = 0.014;
  double min_distance = 0.0085;
  /// Metres: greatest distance of a branch's line from a merged junction, and of two wires where
  /// one forks off the other.
  double max_residual = 0.0035;
  double fork_clearance = 0.0085;  ///< metres: wires that part at a small angle blend up to this
  double fork_fit_length = 0.05;
};
void VisitOptions(JunctionRefinementOptions& options, OptionVisitor& visitor);

/// Moves every node with three or more branches to where lines fitted to the branches beyond the
/// blurred zone (between the two radii) meet in the least-squares sense, and straightens the
/// branches inside the inner radius. Where wires part at a small angle, the smooth curves that the
/// branches follow farther out are carried on to where they meet (ForkPosition). Junctions joined
/// by an edge shorter than `merge_distance` become one where the lines of all their branches meet
/// within `max_residual`, and in any case where it is shorter than `min_distance`: a crossing of
/// three wires stays one junction of valence 6.
void RefineJunctions(SkeletonGraph& graph, const JunctionRefinementOptions& options);

/// Moves a junction to where lines fitted to its branches meet, straightening these as
/// RefineJunctions does, if at least so many are clear enough. For curves that are exact.
void PlaceByLines(SkeletonGraph& graph, NodeId node, int least_lines,
                  const JunctionRefinementOptions& options);

/// Merges junctions that are parts of one hub: joined by an edge shorter than `merge_distance`, and
/// the lines of at least four of their branches meet in one point to 2 mm (standard deviation). No
/// other junction moves. For curves that are exact; contraction blurs more.
void MergeHubs(SkeletonGraph& graph, const JunctionRefinementOptions& options);

}  // namespace curvefusion
