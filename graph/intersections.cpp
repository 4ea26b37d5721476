#include "graph/intersections.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "graph/contacts.h"
#include "graph/edge_curve.h"
#include "graph/junctions.h"
#include "graph/merge.h"

namespace curvefusion {

namespace {

// Real and simulated skeletons need two to five rounds.
constexpr int kMaxRounds = 12;
// A loop of this many thresholds is nowhere wider than the threshold.
constexpr double kLoop = 3;
// Curves that were joined at both ends of a stretch within the threshold may part a little between.
constexpr double kParallelSlack = 1.5;

// Brings a graph to the form in which contacts are looked for; every step removes edges, so it
// ends.
void Tidy(SkeletonGraph& graph, double threshold) {
  RemoveZeroLengthSegments(graph);
  for (int edges = -1; edges != graph.edge_count();) {
    edges = graph.edge_count();
    graph.DissolveDegree2Nodes();
    RemoveSmallLoops(graph, kLoop * threshold);
    MergeParallelEdges(graph, kParallelSlack * threshold);
  }
}

void JoinContacts(SkeletonGraph& graph, const std::vector<Contact>& contacts, double threshold) {
  std::vector<LocationPair> places;
  for (const Contact& contact : contacts) {
    const std::vector<LocationPair> joined = PlacesToJoin(contact, threshold);
    places.insert(places.end(), joined.begin(), joined.end());
  }
  JoinLocations(graph, places, threshold);
}

using Interval = std::pair<double, double>;

// Removes every segment of an edge that meets one of the intervals of arc length.
void CutAway(SkeletonGraph& graph, EdgeId id, const std::vector<Interval>& intervals) {
  const SkeletonEdge whole = graph.edge(id);
  const std::vector<double> arcs = CumulativeLength(whole.points);
  const auto is_kept = [&](size_t segment) {
    return std::none_of(intervals.begin(), intervals.end(), [&](const Interval& interval) {
      return arcs[segment] <= interval.second && arcs[segment + 1] >= interval.first;
    });
  };
  const size_t segments = whole.points.size() - 1;
  graph.RemoveEdge(id);
  for (size_t first = 0; first < segments;) {
    size_t last = first;
    while (last < segments && is_kept(last)) ++last;
    if (last > first) {
      SkeletonEdge part = PartOfEdge(whole, arcs, arcs[first], arcs[last]);
      part.nodes[0] = first == 0 ? whole.nodes[0] : graph.AddNode(part.points.front());
      part.nodes[1] = last == segments ? whole.nodes[1] : graph.AddNode(part.points.back());
      graph.AddEdge(std::move(part));
    }
    first = last + 1;
  }
}

Interval Ordered(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

// Cuts the shorter edge of every contact away along it.
void CutContactsAway(SkeletonGraph& graph, const std::vector<Contact>& contacts) {
  std::map<EdgeId, std::vector<Interval>> cuts;
  for (const Contact& contact : contacts) {
    const EdgeId a = contact.closest.first.edge;
    const EdgeId b = contact.closest.second.edge;
    const bool cut_first = Length(graph.edge(a).points) < Length(graph.edge(b).points);
    const auto arc = [cut_first](const LocationPair& pair) {
      return cut_first ? pair.first.arc_length : pair.second.arc_length;
    };
    Interval interval = Ordered(arc(contact.first), arc(contact.last));
    interval.first = std::min(interval.first, arc(contact.closest));
    interval.second = std::max(interval.second, arc(contact.closest));
    cuts[cut_first ? a : b].push_back(interval);
  }
  for (const auto& [edge, intervals] : cuts) CutAway(graph, edge, intervals);
  graph.RemoveIsolatedNodes();
}

}  // namespace

void ResolveIntersections(SkeletonGraph& graph, double threshold) {
  for (int round = 0; true; ++round) {
    Tidy(graph, threshold);
    const std::vector<Contact> contacts = FindContacts(graph, threshold);
    if (contacts.empty()) return;
    if (round < kMaxRounds) {
      JoinContacts(graph, contacts, threshold);
    } else {
      CutContactsAway(graph, contacts);
    }
  }
}

}  // namespace curvefusion
