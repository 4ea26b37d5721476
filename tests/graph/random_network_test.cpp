// Random networks through every operation, each against an oracle over all pairs of segments in
// exact arithmetic. CURVEFUSION_NETWORKS sets how many fixed seeds are tried (200 otherwise),
// CURVEFUSION_FIRST_NETWORK with which to begin; RC_PARAMS="max_success=1000 seed=7" does for the
// random ones.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "graph/canonical_form.h"
#include "graph/contacts.h"
#include "graph/cycles.h"
#include "graph/edge_curve.h"
#include "graph/free_ends.h"
#include "graph/graph_io.h"
#include "graph/intersections.h"
#include "graph/merge.h"
#include "graph/smoothing.h"
#include "graph/validate.h"
#include "kernel/disjoint_sets.h"
#include "tests/graph/contact_oracle.h"
#include "tests/graph/random_networks.h"

namespace curvefusion {
namespace {

std::string AsText(const SkeletonGraph& graph) { return SkeletonToJson(CanonicalForm(graph)); }

std::string FirstOf(const std::vector<std::string>& violations) {
  return violations.empty() ? "" : violations[0];
}

// The graph with the repeated points removed that no distance can be measured with.
SkeletonGraph WithoutPoints(SkeletonGraph graph) {
  RemoveZeroLengthSegments(graph);
  return graph;
}

std::string CheckContacts(const SkeletonGraph& graph, double threshold) {
  const std::vector<SegmentPair> expected = AllPairsInContact(graph, threshold);
  if (SegmentPairsInContact(SegmentTable(graph), threshold) != expected)
    return "the pairs in contact are not those of the oracle";
  if (FindContacts(graph, threshold).empty() != expected.empty())
    return "contacts without pairs or pairs without contact";
  return "";
}

// Number of pieces that hang together by nodes or by contacts.
int ComponentsWithContacts(const SkeletonGraph& graph, double threshold) {
  const SegmentTable table(graph);
  DisjointSets curves(table.edges.size());
  for (const SegmentPair& pair : SegmentPairsInContact(table, threshold))
    curves.Unite(table.curves[pair.s], table.curves[pair.t]);
  std::map<NodeId, int> curve_of_node;
  for (int i = 0; i < static_cast<int>(table.nodes.size()); ++i)
    for (const NodeId node : table.nodes[i])
      curves.Unite(i, curve_of_node.try_emplace(node, i).first->second);
  int count = 0;
  for (int i = 0; i < static_cast<int>(table.nodes.size()); ++i) count += curves.Root(i) == i;
  return count;
}

std::string CheckResolution(const RandomNetwork& network, uint64_t seed) {
  SkeletonGraph resolved = network.graph;
  ResolveIntersections(resolved, network.threshold);
  const std::string fault = FirstOf(Violations(resolved, network.threshold));
  if (!fault.empty()) return "resolved: " + fault;
  if (!AllPairsInContact(resolved, network.threshold).empty())
    return "resolved: the oracle finds a contact";
  // Above zero, making two curves one may move them away from a third.
  // Above zero, making two curves one may move them away from a third.
  if (network.threshold == 0 &&
      resolved.ComponentCount() >
          ComponentsWithContacts(WithoutPoints(network.graph), network.threshold))
    return "resolving tears apart what hung together";
  const std::string text = SkeletonToJson(resolved);
  SkeletonGraph again = resolved;
  ResolveIntersections(again, network.threshold);
  if (SkeletonToJson(again) != text) return "resolving twice changes the graph";
  SkeletonGraph shuffled = Shuffled(network.graph, seed);
  ResolveIntersections(shuffled, network.threshold);
  if (AsText(shuffled) != AsText(resolved)) return "the order of edges matters";
  return "";
}

struct NamedOperation {
  const char* name;
  std::function<void(SkeletonGraph&, double threshold)> run;
};

const std::vector<NamedOperation>& Operations() {
  static const std::vector<NamedOperation> operations = {
      {"MergeNearbyJunctions",
       [](SkeletonGraph& graph, double t) { MergeNearbyJunctions(graph, 3 * t); }},
      {"MergeParallelEdges", [](SkeletonGraph& graph, double t) { MergeParallelEdges(graph, t); }},
      {"MergeOverlappingEdges",
       [](SkeletonGraph& graph, double t) { MergeOverlappingEdges(graph, t); }},
      {"RemoveShortEdges", [](SkeletonGraph& graph, double t) { RemoveShortEdges(graph, 2 * t); }},
      {"PruneSpurs", [](SkeletonGraph& graph, double t) { PruneSpurs(graph, 3 * t); }},
      {"RemoveSmallCycles",
       [](SkeletonGraph& graph, double t) { RemoveSmallCycles(graph, 10 * t); }},
      {"DissolveDegree2Nodes", [](SkeletonGraph& graph, double) { graph.DissolveDegree2Nodes(); }},
      {"ResampleGraph",
       [](SkeletonGraph& graph, double t) { ResampleGraph(graph, t > 0 ? t / 2 : 0.01); }},
      {"SmoothGraph",
       [](SkeletonGraph& graph, double t) {
         SmoothingOptions options;
         options.step = t > 0 ? t / 2 : 0.01;
         graph = SmoothGraph(graph, options);
       }},
      {"CloseFreeEnds", [](SkeletonGraph& graph, double) { CloseFreeEnds(graph, {}); }},
      {"SplitEdge",
       [](SkeletonGraph& graph, double) {
         for (const EdgeId id : graph.Edges())
           if (graph.edge(id).points.size() > 2) graph.SplitEdge(id, 1);
       }},
  };
  return operations;
}

// Operations are made for coordinates of an object: far from it their steps would be without
// number.
bool IsOfObjectSize(const RandomNetwork& network) {
  for (const EdgeId id : network.graph.Edges())
    for (const Vec3& p : network.graph.edge(id).points)
      if (p.norm() > 10) return false;
  return true;
}

std::string CheckOperations(const RandomNetwork& network) {
  if (!IsOfObjectSize(network)) return "";
  const SkeletonGraph original = WithoutPoints(network.graph);
  SegmentPairSearch searched(network.threshold);
  searched.Update(original);
  for (const NamedOperation& operation : Operations()) {
    SkeletonGraph graph = original;
    operation.run(graph, network.threshold);
    const std::string fault = FirstOf(Faults(graph));
    if (!fault.empty()) return std::string(operation.name) + ": " + fault;
    SegmentPairSearch search = searched;
    search.Update(graph);
    if (Named(search.table(), search.pairs()) !=
        Named(SegmentTable(graph), SegmentPairsInContact(SegmentTable(graph), network.threshold)))
      return std::string(operation.name) + ": a change is not noticed";
  }
  return "";
}

std::string FirstFault(uint64_t seed, int size) {
  const RandomNetwork network = MakeRandomNetwork(seed, size);
  std::string fault = CheckContacts(WithoutPoints(network.graph), network.threshold);
  if (fault.empty()) fault = CheckResolution(network, seed);
  if (fault.empty()) fault = CheckOperations(network);
  return fault;
}

int FromEnvironment(const char* name, int otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? std::atoi(value) : otherwise;
}

TEST(RandomNetworks, OfFixedSeedsHoldEveryPromise) {
  const int first = FromEnvironment("CURVEFUSION_FIRST_NETWORK", 0);
  const int count = FromEnvironment("CURVEFUSION_NETWORKS", 200);
  for (int seed = first; seed < first + count; ++seed)
    EXPECT_EQ(FirstFault(seed, 3 + seed % 16), "") << "seed " << seed << ", size " << 3 + seed % 16;
}

TEST(RandomNetworks, OfRandomSeedsHoldEveryPromise) {
  EXPECT_TRUE(rc::check("all promises hold", [](uint64_t seed) {
    const int size = *rc::gen::inRange(1, 20);
    RC_ASSERT(FirstFault(seed, size) == std::string());
  }));
}

}  // namespace
}  // namespace curvefusion
