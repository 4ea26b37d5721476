#include "fusion/registration/skeleton_fusion.h"

#include <cassert>
#include <set>
#include <utility>
#include <vector>

#include "fusion/registration/new_parts.h"
#include "fusion/registration/overlap.h"
#include "fusion/registration/overlap_merging.h"
#include "graph/cycles.h"
#include "graph/edge_curve.h"
#include "graph/intersections.h"
#include "graph/merge.h"
#include "graph/validate.h"

namespace curvefusion {

namespace {

constexpr int kMaxCleaningRounds = 10;

// The graph at even steps, every point with observations.
SkeletonGraph Prepared(const SkeletonGraph& graph, double observations, double step) {
  SkeletonGraph prepared = graph;
  prepared.RemoveIsolatedNodes();
  for (const EdgeId id : prepared.Edges()) {
    SkeletonEdge edge = prepared.edge(id);
    if (edge.observations.empty()) edge.observations.assign(edge.points.size(), observations);
    prepared.SetCurve(id, std::move(edge.points), std::move(edge.radii),
                      std::move(edge.observations));
  }
  RemoveZeroLengthSegments(prepared);
  prepared.DissolveDegree2Nodes();
  ResampleGraph(prepared, step);
  return prepared;
}

// Paper, (i) Alignment: brings one skeleton to the other.
AlignmentResult Align(SkeletonGraph& partial, SkeletonGraph& bundle,
                      const SkeletonFusionOptions& options) {
  if (!options.align) return {};
  const AlignmentResult result = AlignSkeletons(bundle, partial, options.alignment);
  const double angle = Eigen::AngleAxisd(result.T_target_source.linear()).angle();
  if (result.inlier_fraction < options.min_inlier_fraction || angle > options.max_rotation)
    return result;
  if (options.move_partial) {
    partial = Transformed(partial, result.T_target_source.inverse());
  } else {
    bundle = Transformed(bundle, result.T_target_source);
  }
  return result;
}

std::set<NodeId> JunctionsOf(const SkeletonGraph& graph) {
  std::set<NodeId> junctions;
  for (const NodeId node : graph.Nodes())
    if (graph.Degree(node) >= 3) junctions.insert(node);
  return junctions;
}

// Paper: "we identify pairs of junctions [of both skeletons] that are close to each other [...] and
// merge them". Pairs that match each other are one by now; what is left are junctions that a bundle
// has beside one of the partial skeleton, on a curve of it.
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

// Paper, (ii) Merging: overlapping parts, junctions, and what is new.
void Merge(SkeletonGraph& partial, const SkeletonGraph& bundle, int bundles_so_far,
           const SkeletonFusionOptions& options) {
  const OverlapCriteria criteria{options.overlap_distance, options.max_overlap_angle,
                                 options.keep_neighbours, options.intersection_distance};
  const auto matches = MatchGraphs(bundle, partial, options.smoothing.step, criteria);
  AverageOverlaps(
      partial, bundle, matches,
      {options.weights_by_observation, 1.0 / (bundles_so_far + 1), options.junction_distance});
  const std::set<NodeId> old_junctions = JunctionsOf(partial);
  AddNewParts(partial, bundle, matches,
              {options.overlap_distance, options.junction_distance, options.intersection_distance});
  MergeNewJunctions(partial, old_junctions, options.junction_distance);
}

// Paper, end of (ii) and (iii) Smoothing.
SkeletonGraph CleanedAndSmoothed(SkeletonGraph graph, const SkeletonFusionOptions& options) {
  ResolveIntersections(graph, options.intersection_distance);
  RemoveSmallCycles(graph, options.min_cycle_length);
  RemoveShortEdges(graph, options.min_edge_length);
  graph = SmoothGraph(graph, options.smoothing);
  // Moved curves may touch anew, and new junctions leave short edges. One round is the rule.
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
  visitor.Visit({"align", "", 0, 1, "Align each bundle before it is merged. CurveFusion 3.3 (i)."},
                options.align);
  visitor.Visit({"move_partial", "", 0, 1,
                 "Move the partial skeleton to the bundle as the paper does. Deviation: the best "
                 "profile moves the bundle, so that the result stays in the frame of the first."},
                options.move_partial);
  visitor.Visit(
      {"min_inlier_fraction", "", 0, 1,
       "Alignments that bring less of the bundle onto the partial skeleton are not used."},
      options.min_inlier_fraction);
  visitor.Visit({"max_rotation", "rad", 0, 3.2,
                 "Alignments that turn the bundle by more are not used: no drift between "
                 "neighbouring bundles does."},
                options.max_rotation);
  visitor.Visit({"overlap_distance", "m", 0.0005, 0.1,
                 "Curves nearer than this are merged. CurveFusion 3.3."},
                options.overlap_distance);
  visitor.Visit({"max_overlap_angle", "rad", 0, 1.6,
                 "Curves that run in directions farther apart cross instead of overlapping."},
                options.max_overlap_angle);
  visitor.Visit({"keep_neighbours", "", 0, 1,
                 "Deviation: a curve is not merged with one that another curve of its bundle fits "
                 "better, so that wires nearer than the overlap distance stay apart."},
                options.keep_neighbours);
  visitor.Visit({"weights_by_observation", "", 0, 1,
                 "Deviation: average by how often each part was seen instead of i/(i+1) and "
                 "1/(i+1), which favours what was seen first."},
                options.weights_by_observation);
  visitor.Visit({"junction_distance", "m", 0.0005, 0.1,
                 "Junctions of both skeletons nearer than this become one. CurveFusion 3.3."},
                options.junction_distance);
  visitor.Visit({"intersection_distance", "m", 0.0001, 0.1,
                 "Curves that come nearer than this meet in a junction; CurveFusion 3.3 gives no "
                 "value."},
                options.intersection_distance);
  visitor.Visit(
      {"min_edge_length", "m", 0, 0.1, "Shorter edges are removed after merging. CurveFusion 3.3."},
      options.min_edge_length);
  visitor.Visit({"min_cycle_length", "m", 0, 1,
                 "Deviation: shorter cycles are opened; spurs that touch a neighbouring branch "
                 "make them. 0 keeps all, as the paper does."},
                options.min_cycle_length);
}

SkeletonFusionOptions PaperSkeletonFusionOptions() {
  SkeletonFusionOptions options;
  options.move_partial = true;
  options.keep_neighbours = false;
  options.weights_by_observation = false;
  options.min_cycle_length = 0;
  options.alignment = PaperAlignmentOptions();
  options.smoothing = PaperSmoothingOptions();
  return options;
}

SkeletonGraph FuseSkeletons(const SkeletonGraph& partial, const SkeletonGraph& bundle,
                            int bundles_so_far, const SkeletonFusionOptions& options,
                            AlignmentResult* alignment) {
  assert(bundles_so_far >= 1 || partial.empty());
  RequireComputable(partial, "partial skeleton");
  RequireComputable(bundle, "bundle skeleton");
  const double step = options.smoothing.step;
  SkeletonGraph fused = Prepared(partial, bundles_so_far, step);
  SkeletonGraph next = Prepared(bundle, 1, step);
  ResolveIntersections(next, options.intersection_distance);
  ResampleGraph(next, step);
  if (fused.empty()) return CleanedAndSmoothed(std::move(next), options);
  const AlignmentResult aligned = Align(fused, next, options);
  if (alignment != nullptr) *alignment = aligned;
  Merge(fused, next, bundles_so_far, options);
  return CleanedAndSmoothed(std::move(fused), options);
}

}  // namespace curvefusion
