#include "graph/intersections.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "graph/canonical_form.h"
#include "graph/contact_joining.h"
#include "graph/contacts.h"
#include "graph/edge_curve.h"
#include "graph/merge.h"
#include "graph/parallel_edges.h"
#include "graph/validate.h"
#include "kernel/disjoint_sets.h"
#include "kernel/error.h"

namespace curvefusion {

namespace {

// Chosen: far above the two to five rounds that real and simulated skeletons need.
constexpr int kMaxJoiningRounds = 30;
// Chosen: so often may joining leave the numbers of nodes, edges and contacts as they were.
constexpr int kMaxStalls = 2;
// Derived: the widest loop, a circle, of so many thresholds is 3 / pi of a threshold wide.
constexpr double kLoop = 3;
// Chosen: curves that were joined at both ends of a stretch within the threshold may part a little
// between.
constexpr double kParallelSlack = 1.5;

// What every step of tidying makes less of.
struct Counts {
  int nodes = 0;
  int edges = 0;
  size_t vertices = 0;  // nodes and points inside edges
  bool operator==(const Counts&) const = default;
};

Counts CountsOf(const SkeletonGraph& graph) {
  const auto nodes = static_cast<size_t>(graph.node_count());
  const auto edges = static_cast<size_t>(graph.edge_count());
  return {graph.node_count(), graph.edge_count(), nodes + graph.point_count() - 2 * edges};
}

// Brings a graph to the form in which contacts are looked for; every step removes edges, so it
// ends. Edges that were split only to become parallel are merged before their nodes dissolve. What
// was tidy for the same threshold at a version and has not changed since is left alone. There must
// be no segments of length zero.
void Tidy(SkeletonGraph& graph, double threshold, int since) {
  for (bool changed = true; changed;) {
    const int before = graph.version();
    RemoveSmallLoops(graph, kLoop * threshold, since);
    const int edges = graph.edge_count();
    MergeParallelEdges(graph, kParallelSlack * threshold, since);
    graph.DissolveDegree2Nodes(since);
    changed = graph.edge_count() != edges;
    if (changed) RemoveZeroLengthSegments(graph, before);
    since = before;
  }
}

// Removes an edge, or where others hang together by nothing else shrinks it to a node.
void DropEdge(SkeletonGraph& graph, EdgeId edge) {
  const auto [kept, other] = graph.edge(edge).nodes;
  const int components = graph.ComponentCount();
  graph.RemoveEdge(edge);
  if (graph.ComponentCount() > components) graph.MergeNodes(kept, other);
}

// Merges vertices of a tidy graph; where rounding hides them, drops the shorter edge of the first
// contact and returns false. Either way there are fewer vertices or edges afterwards, and what
// hangs together stays together.
bool MergeOrDrop(SkeletonGraph& graph, const std::vector<Contact>& contacts, double threshold) {
  const size_t vertices = CountsOf(graph).vertices;
  const EdgeId a = contacts[0].closest.first.edge;
  const EdgeId b = contacts[0].closest.second.edge;
  const EdgeId shorter = Length(graph.edge(a).points) < Length(graph.edge(b).points) ? a : b;
  const int before = graph.version();
  SkeletonGraph dropped = graph;
  MergeContactVertices(graph, contacts);
  Tidy(graph, threshold, before);
  if (CountsOf(graph).vertices < vertices) return true;
  DropEdge(dropped, shorter);
  RemoveZeroLengthSegments(dropped, before);
  graph = std::move(dropped);
  Tidy(graph, threshold, before);
  return false;
}

// Contacts of curves that do not hang together yet.
std::vector<Contact> ContactsBetweenComponents(const SkeletonGraph& graph,
                                               const std::vector<Contact>& contacts) {
  const std::vector<NodeId> nodes = graph.Nodes();
  DisjointSets sets(nodes.empty() ? 0 : static_cast<size_t>(nodes.back()) + 1);
  for (const EdgeId id : graph.Edges())
    sets.Unite(graph.edge(id).nodes[0], graph.edge(id).nodes[1]);
  const auto component = [&](const CurveLocation& place) {
    return sets.Root(graph.edge(place.edge).nodes[0]);
  };
  std::vector<Contact> between;
  for (const Contact& contact : contacts)
    if (component(contact.closest.first) != component(contact.closest.second))
      between.push_back(contact);
  return between;
}

// The state of one resolution.
class Resolution {
 public:
  // Of a graph in canonical form; the original is emptied as soon as it is known that the graph
  // changes, as its memory is needed.
  Resolution(SkeletonGraph graph, SkeletonGraph& original, double threshold)
      : graph_(std::move(graph)), original_(original), threshold_(threshold), search_(threshold) {}

  void Run() {
    double largest = LargestCoordinate(graph_);
    while (TidyAtScale(std::max(threshold_, ResolutionAt(largest)))) {
      for (std::vector<Contact> contacts = search_.Find(graph_); !contacts.empty();
           contacts = search_.Find(graph_)) {
        original_ = SkeletonGraph();
        Step(contacts);
      }
      largest = search_.largest_coordinate();
    }
  }

  const SkeletonGraph& graph() const { return graph_; }
  SkeletonGraph TakeGraph() {
    search_ = ContactSearch(threshold_);  // its memory is needed for the canonical form
    return std::move(graph_);
  }
  const ResolutionRounds& rounds() const { return rounds_; }

 private:
  // Where the threshold is below what rounding amounts to, junctions are still made at its scale.
  // That grows with the coordinates, by powers of two; false where it has not since the last call.
  bool TidyAtScale(double scale) {
    if (scale <= scale_) return false;
    scale_ = scale;
    RemoveZeroLengthSegments(graph_);
    if (threshold_ > 0) {
      Tidy(graph_, scale, 0);
      tidied_ = graph_.version();
    } else {
      // Curves stay where they are until all that touches them is tied to them by a node.
      graph_.DissolveDegree2Nodes();
      tidied_ = 0;
    }
    return true;
  }

  void Join(const std::vector<Contact>& contacts) {
    ++rounds_.joining;
    JoinContacts(graph_, contacts, scale_,
                 scale_ > threshold_ ? JoinSelection::kAll : JoinSelection::kApart);
    Tidy(graph_, scale_, tidied_);
    tidied_ = graph_.version();
  }

  // A step after which there are fewer components or, with as many, fewer vertices or edges.
  void StepDown(const std::vector<Contact>& contacts) {
    std::vector<Contact> between;
    if (threshold_ == 0) between = ContactsBetweenComponents(graph_, contacts);
    if (!between.empty()) {
      Join(between);
      return;
    }
    ++(MergeOrDrop(graph_, contacts, scale_) ? rounds_.merging : rounds_.dropping);
    tidied_ = graph_.version();
  }

  // Whether the last round joined and that left the graph as it was, or the numbers for some
  // rounds.
  bool IsStuck(const Counts& now) {
    if (!joined_) return false;
    const bool is_stall =
        now.nodes == joined_->nodes && now.edges == joined_->edges && is_repeated_;
    stalls_ = is_stall ? stalls_ + 1 : 0;
    return now == *joined_ || stalls_ > kMaxStalls;
  }

  void Step(const std::vector<Contact>& contacts) {
    const Counts now = CountsOf(graph_);
    if (IsStuck(now) || rounds_.joining >= kMaxJoiningRounds) {
      StepDown(contacts);
      joined_.reset();
      return;
    }
    joined_ = now;
    is_repeated_ = contacts.size() == last_contacts_;
    last_contacts_ = contacts.size();
    Join(contacts);
  }

  SkeletonGraph graph_;
  SkeletonGraph& original_;
  double threshold_;
  ContactSearch search_;
  double scale_ = -1;
  int tidied_ = 0;  // the version up to which the graph is tidy
  ResolutionRounds rounds_;
  std::optional<Counts> joined_;  // before the last round, where that joined
  bool is_repeated_ = false;      // it found as many contacts as the one before
  int stalls_ = 0;
  size_t last_contacts_ = 0;
};

void RequireThreshold(double threshold) {
  if (std::isfinite(threshold) && threshold >= 0) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("threshold of intersections is {}, must be 0 m or more", threshold));
}

}  // namespace

ResolutionRounds ResolveIntersections(SkeletonGraph& graph, double threshold) {
  RequireThreshold(threshold);
  RequireComputable(graph, "graph with intersections to resolve");
  LentCanonicalForm lent(graph);
  Resolution resolution(lent.Take(), graph, threshold);
  resolution.Run();
  const bool has_changed =
      resolution.rounds().joining > 0 || CountsOf(resolution.graph()) != CountsOf(graph);
  if (has_changed) {
    graph = CanonicalForm(resolution.TakeGraph());
  } else {
    lent.Return(resolution.TakeGraph());
  }
  return resolution.rounds();
}

}  // namespace curvefusion
