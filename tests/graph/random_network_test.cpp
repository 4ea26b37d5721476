// Random networks through every operation, each against an oracle over all pairs of segments in
// exact arithmetic. CURVEFUSION_NETWORKS sets how many fixed seeds are tried (200 otherwise),
// CURVEFUSION_FIRST_NETWORK with which to begin; RC_PARAMS="max_success=1000 seed=7" does for the
// random ones.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <set>
#include <string>

#include "graph/canonical_form.h"
#include "graph/contacts.h"
#include "graph/contraction/free_ends.h"
#include "graph/edge_curve.h"
#include "graph/intersections.h"
#include "graph/io/graph_io.h"
#include "graph/merge.h"
#include "graph/parallel_edges.h"
#include "graph/smoothing.h"
#include "graph/validate.h"
#include "tests/graph/contact_oracle.h"
#include "tests/graph/random_networks.h"
#include "tests/graph/resolved_pieces.h"

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

// A network, what can be resolved of it, and the oracle's word on that.
struct Given {
  RandomNetwork network;
  SkeletonGraph graph;  // without repeated points
  std::vector<SegmentPair> contacts;
};

Given MakeGiven(uint64_t seed, int size) {
  Given given;
  given.network = MakeRandomNetwork(seed, size);
  given.graph = WithoutPoints(given.network.graph);
  given.contacts = AllPairsInContact(given.graph, given.network.threshold);
  return given;
}

std::string CheckContacts(const Given& given) {
  const double threshold = given.network.threshold;
  if (SegmentPairsInContact(SegmentTable(given.graph), threshold) != given.contacts)
    return "the pairs in contact are not those of the oracle";
  if (FindContacts(given.graph, threshold).empty() != given.contacts.empty())
    return "contacts without pairs or pairs without contact";
  return "";
}

// Where nothing is in contact only nodes inside curves disappear, and what is no wider than the
// threshold: then and with threshold 0, what is left is known bit for bit.
std::string CheckUntouched(const Given& given, const SkeletonGraph& resolved) {
  if (!given.contacts.empty()) return "";
  SkeletonGraph expected = CanonicalForm(given.graph);
  expected.DissolveDegree2Nodes();
  const double threshold = given.network.threshold;
  if (threshold > 0)
    for (const EdgeId id : expected.Edges())
      if (Length(expected.edge(id).points) < 20 * threshold) return "";
  return AsText(resolved) == AsText(expected) ? "" : "without contacts, something has changed";
}

// How far resolving with threshold 0 may move points, metres: places nearer than 64 ulps of the
// largest coordinate are one, and what was joined may be joined again.
double PieceBound(const SkeletonGraph& graph) {
  constexpr double kJoined = 4;
  return kJoined * ResolutionAt(LargestCoordinate(graph));
}

// With threshold 0, the pieces are known: those that hang together by nodes or contacts. Above,
// making two curves one may move them away from a third.
std::string CheckPieces(const Given& given, const SkeletonGraph& resolved) {
  if (given.network.threshold > 0) return "";
  const std::vector<int> pieces = PiecesOf(SegmentTable(given.graph), given.contacts);
  const std::set<int> different(pieces.begin(), pieces.end());
  if (resolved.ComponentCount() > static_cast<int>(different.size()))
    return "resolving tears apart what hung together";
  return DifferenceFromPieces(given.graph, given.contacts, resolved, PieceBound(given.graph));
}

std::string CheckResolution(const Given& given, uint64_t seed) {
  const auto& [graph, threshold] = given.network;
  SkeletonGraph resolved = graph;
  ResolveIntersections(resolved, threshold);
  const std::string fault = FirstOf(Violations(resolved, threshold));
  if (!fault.empty()) return "resolved: " + fault;
  if (!AllPairsInContact(resolved, threshold).empty())
    return "resolved: the oracle finds a contact";
  std::string difference = CheckUntouched(given, resolved);
  if (difference.empty()) difference = CheckPieces(given, resolved);
  if (!difference.empty()) return "resolved: " + difference;
  const std::string text = SkeletonToJson(resolved);
  SkeletonGraph again = resolved;
  ResolveIntersections(again, threshold);
  if (SkeletonToJson(again) != text) return "resolving twice changes the graph";
  SkeletonGraph shuffled = Shuffled(graph, seed);
  ResolveIntersections(shuffled, threshold);
  if (AsText(shuffled) != AsText(resolved)) return "the order of edges matters";
  return "";
}

struct NamedOperation {
  const char* name;
  std::function<void(SkeletonGraph&, double threshold)> run;
};

const std::vector<NamedOperation>& Operations() {
  static const std::vector<NamedOperation> operations = {
      {"MergeParallelEdges", [](SkeletonGraph& graph, double t) { MergeParallelEdges(graph, t); }},
      {"RemoveShortEdges", [](SkeletonGraph& graph, double t) { RemoveShortEdges(graph, 2 * t); }},
      {"PruneSpurs", [](SkeletonGraph& graph, double t) { PruneSpurs(graph, 3 * t); }},
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

std::string CheckOperations(const Given& given) {
  if (!IsOfObjectSize(given.network)) return "";
  const double threshold = given.network.threshold;
  SegmentPairSearch searched(threshold);
  searched.Update(given.graph);
  for (const NamedOperation& operation : Operations()) {
    SkeletonGraph graph = given.graph;
    operation.run(graph, threshold);
    const std::string fault = FirstOf(Faults(graph));
    if (!fault.empty()) return std::string(operation.name) + ": " + fault;
    SegmentPairSearch search = searched;
    search.Update(graph);
    if (Named(search.table(), search.pairs()) !=
        Named(SegmentTable(graph), SegmentPairsInContact(SegmentTable(graph), threshold)))
      return std::string(operation.name) + ": a change is not noticed";
  }
  return "";
}

std::string FirstFault(uint64_t seed, int size) {
  const Given given = MakeGiven(seed, size);
  std::string fault = CheckContacts(given);
  if (fault.empty()) fault = CheckResolution(given, seed);
  if (fault.empty()) fault = CheckOperations(given);
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
