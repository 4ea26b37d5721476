#include "fusion/paper/skeleton_fusion.h"

#include <cassert>
#include <set>
#include <utility>
#include <vector>

#include "fusion/paper/curve_overlap.h"
#include "fusion/paper/new_parts.h"
#include "fusion/paper/overlap_averaging.h"
#include "graph/edge_curve.h"
#include "graph/intersections.h"
#include "graph/merge.h"
#include "graph/smoothing.h"
#include "graph/validate.h"

namespace curvefusion {

namespace {

constexpr int kMaxCleaningRounds = 10;  // chosen: one is the rule

// "We represent each curve as a polyline whose vertex positions are uniformly sampled."
SkeletonGraph Prepared(const SkeletonGraph& graph, double step) {
  SkeletonGraph prepared = graph;
  prepared.RemoveIsolatedNodes();
  RemoveZeroLengthSegments(prepared);
  prepared.DissolveDegree2Nodes();
  ResampleGraph(prepared, step);
  return prepared;
}

std::set<NodeId> JunctionsOf(const SkeletonGraph& graph) {
  std::set<NodeId> junctions;
  for (const NodeId node : graph.Nodes())
    if (graph.Degree(node) >= 3) junctions.insert(node);
  return junctions;
}

// "We identify pairs of junctions of S_(i+1) and K_i that are close to each other within a
// specified distance threshold (set as 1 cm) and merge them with a similar weighted averaging."
// Pairs that match each other are one by now; what is left are junctions that a bundle has beside
// one of the partial skeleton, on a curve of it.
void MergeNewJunctions(SkeletonGraph& graph, const std::set<NodeId>& old_junctions,
                       double distance) {
  std::vector<EdgeId> links;
  do {
    links.clear();
    for (const EdgeId id : graph.Edges()) {
      const SkeletonEdge& edge = graph.edge(id);
      const auto [a, b] = edge.nodes;
      if (a == b || graph.Degree(a) < 3 || graph.Degree(b) < 3) continue;
      if (old_junctions.count(a) == old_junctions.count(b)) continue;
      if (Length(edge.points) <= distance) links.push_back(id);
    }
    ContractEdges(graph, links);
  } while (!links.empty());
}

// (ii) Merging: overlapping parts, "while keeping the original curve segments for the
// non-overlapping areas", and junctions.
void Merge(SkeletonGraph& partial, const SkeletonGraph& bundle, int bundles_so_far,
           const SkeletonFusionOptions& options) {
  const auto matches = MatchGraphs(bundle, partial, options.step, options.overlap_distance);
  const double bundle_weight = 1.0 / (bundles_so_far + 1);  // "1/(i+1) for S_(i+1)"
  AverageOverlaps(partial, bundle, matches, {bundle_weight, options.junction_distance});
  const std::set<NodeId> old_junctions = JunctionsOf(partial);
  AddNewParts(partial, bundle, matches,
              {options.overlap_distance, options.junction_distance, options.intersection_distance});
  MergeNewJunctions(partial, old_junctions, options.junction_distance);
}

// Eq. 1 and nothing else: free ends, corners and bends are smoothed like any vertex.
SmoothingOptions Smoothing(const SkeletonFusionOptions& options) {
  SmoothingOptions smoothing = PaperSmoothingOptions();
  smoothing.step = options.step;
  smoothing.lambda = options.lambda;
  return smoothing;
}

// "If any two curve segments intersect (within a proximity threshold) at an internal point, we
// create a new junction at this intersection and split each of the segments accordingly. Finally,
// we remove any curve segment shorter than a threshold (2 mm)"; then (iii) Smoothing.
SkeletonGraph CleanedAndSmoothed(SkeletonGraph graph, const SkeletonFusionOptions& options) {
  ResolveIntersections(graph, options.intersection_distance);
  RemoveShortEdges(graph, options.min_edge_length);
  graph = SmoothGraph(graph, Smoothing(options));
  // Not in the paper: moved curves may touch anew, and new junctions leave short edges. One round
  // is the rule.
  for (int round = 0; round < kMaxCleaningRounds; ++round) {
    ResolveIntersections(graph, options.intersection_distance);
    const int edges = graph.edge_count();
    RemoveShortEdges(graph, options.min_edge_length);
    if (graph.edge_count() == edges) return graph;
  }
  ResolveIntersections(graph, options.intersection_distance);
  return graph;
}

}  // namespace

void VisitOptions(SkeletonFusionOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"overlap_distance", "m", 0.0005, 0.1,
                 "Curves nearer than this are merged. CurveFusion 4.3."},
                options.overlap_distance);
  visitor.Visit({"junction_distance", "m", 0.0005, 0.1,
                 "Junctions of both skeletons nearer than this become one. CurveFusion 4.3."},
                options.junction_distance);
  visitor.Visit({"intersection_distance", "m", 0.0001, 0.1,
                 "Curves that come nearer than this meet in a junction; CurveFusion 4.3 gives no "
                 "value."},
                options.intersection_distance);
  visitor.Visit(
      {"min_edge_length", "m", 0, 0.1, "Shorter edges are removed after merging. CurveFusion 4.3."},
      options.min_edge_length);
  visitor.Visit({"step", "m", 1e-4, 0.1, "Distance of vertices on curves. CurveFusion 4.3."},
                options.step);
  visitor.Visit(
      {"lambda", "", 0, 1e6, "Weight of smoothness against data. CurveFusion 4.3, Eq. 1."},
      options.lambda);
}

SkeletonGraph FuseSkeletons(const SkeletonGraph& partial, const SkeletonGraph& bundle,
                            int bundles_so_far, const SkeletonFusionOptions& options) {
  assert(bundles_so_far >= 1 || partial.empty());
  RequireComputable(partial, "partial skeleton");
  RequireComputable(bundle, "bundle skeleton");
  SkeletonGraph fused = Prepared(partial, options.step);
  SkeletonGraph next = Prepared(bundle, options.step);
  if (fused.empty()) return CleanedAndSmoothed(std::move(next), options);
  if (next.empty()) return fused;
  // "We further bring K_i closer to S_(i+1)": the partial skeleton moves. The bundle's samples are
  // those that are paired, as the bundle sees a part of the object only.
  fused = Transformed(fused, AlignSkeletons(next, fused, options.alignment).inverse());
  Merge(fused, next, bundles_so_far, options);
  return CleanedAndSmoothed(std::move(fused), options);
}

}  // namespace curvefusion
