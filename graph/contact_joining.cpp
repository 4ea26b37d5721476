#include "graph/contact_joining.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace curvefusion {

namespace {

// Nodes of overlaps that are joined in one go keep so many thresholds from each other. Chosen: more
// than the one within which they would become one.
constexpr double kClearance = 2;

// Parts of edges, none of which meet.
class OccupiedParts {
 public:
  bool Meets(EdgeId edge, double low, double high) const {
    const auto parts = parts_.find(edge);
    if (parts == parts_.end()) return false;
    const auto next = parts->second.upper_bound(high);
    return next != parts->second.begin() && std::prev(next)->second >= low;
  }

  // Adds a part; what it meets becomes part of it.
  void Add(EdgeId edge, double low, double high) {
    std::map<double, double>& parts = parts_[edge];
    auto next = parts.upper_bound(high);
    while (next != parts.begin() && std::prev(next)->second >= low) {
      const auto met = std::prev(next);
      low = std::min(low, met->first);
      high = std::max(high, met->second);
      next = parts.erase(met);
    }
    parts.emplace(low, high);
  }

 private:
  std::map<EdgeId, std::map<double, double>> parts_;  // high ends by low ends
};

struct Part {
  EdgeId edge;
  double low;
  double high;
};

// The parts of both edges that a contact covers.
std::array<Part, 2> PartsOf(const Contact& contact, double margin) {
  const auto part = [margin](const CurveLocation& a, const CurveLocation& b,
                             const CurveLocation& c) -> Part {
    const auto [low, high] = std::minmax({a.arc_length, b.arc_length, c.arc_length});
    return {a.edge, low - margin, high + margin};
  };
  return {part(contact.first.first, contact.last.first, contact.closest.first),
          part(contact.first.second, contact.last.second, contact.closest.second)};
}

double ExtentOf(const Contact& contact) {
  double extent = 0;
  for (const Part& part : PartsOf(contact, 0)) extent += part.high - part.low;
  return extent;
}

// Overlaps, the longest first, then crossings; contacts of equal rank in their order.
std::vector<const Contact*> ByRank(const std::vector<Contact>& contacts) {
  std::vector<std::pair<double, const Contact*>> overlaps;
  for (const Contact& contact : contacts)
    if (contact.overlap) overlaps.emplace_back(ExtentOf(contact), &contact);
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Contact*> sorted;
  sorted.reserve(contacts.size());
  for (const auto& [extent, contact] : overlaps) sorted.push_back(contact);
  for (const Contact& contact : contacts)
    if (!contact.overlap) sorted.push_back(&contact);
  return sorted;
}

// A vertex of the graph: a node, or a point of an edge by its index.
struct Vertex {
  NodeId node = -1;
  EdgeId edge = -1;
  size_t index = 0;
  CurveLocation location;
  double away = 0;  // arc length from the place it was looked up for

  std::tuple<NodeId, EdgeId, size_t> Key() const { return {node, edge, index}; }
};

class VertexFinder {
 public:
  explicit VertexFinder(const SkeletonGraph& graph) : graph_(graph) {}

  // The vertices of an edge nearest to a place along it, on both sides; the nearer first.
  std::array<Vertex, 2> Nearest(const CurveLocation& place) {
    const std::vector<double>& arcs = ArcsOf(place.edge);
    const auto next = std::lower_bound(arcs.begin() + 1, arcs.end() - 1, place.arc_length);
    const size_t index = static_cast<size_t>(next - arcs.begin());
    std::array<Vertex, 2> nearest = {At(place, index - 1), At(place, index)};
    if (nearest[1].away < nearest[0].away) std::swap(nearest[0], nearest[1]);
    return nearest;
  }

  // Two different vertices near a pair of places.
  std::array<Vertex, 2> NearestTwo(const LocationPair& places) {
    const std::array<Vertex, 2> a = Nearest(places.first);
    const std::array<Vertex, 2> b = Nearest(places.second);
    if (a[0].Key() != b[0].Key()) return {a[0], b[0]};
    if (a[1].Key() != b[0].Key() && a[1].away <= b[1].away) return {a[1], b[0]};
    return {a[0], b[1]};
  }

 private:
  Vertex At(const CurveLocation& place, size_t index) {
    const std::vector<double>& arcs = ArcsOf(place.edge);
    Vertex vertex;
    vertex.location = {place.edge, arcs[index]};
    vertex.away = std::abs(arcs[index] - place.arc_length);
    if (index == 0 || index + 1 == arcs.size()) {
      vertex.node = graph_.edge(place.edge).nodes[index == 0 ? 0 : 1];
    } else {
      vertex.edge = place.edge;
      vertex.index = index;
    }
    return vertex;
  }

  const std::vector<double>& ArcsOf(EdgeId edge) {
    const auto [entry, is_new] = arcs_.try_emplace(edge);
    if (is_new) entry->second = CumulativeLength(graph_.edge(edge).points);
    return entry->second;
  }

  const SkeletonGraph& graph_;
  std::map<EdgeId, std::vector<double>> arcs_;
};

}  // namespace

void JoinContacts(SkeletonGraph& graph, const std::vector<Contact>& contacts, double threshold,
                  JoinSelection selection) {
  const double reach = selection == JoinSelection::kAll ? 0 : kConnectedReach * threshold;
  OccupiedParts occupied;
  std::vector<LocationPair> places;
  for (const Contact* contact : ByRank(contacts)) {
    const std::array<Part, 2> parts = PartsOf(*contact, kClearance * threshold);
    const bool is_free = std::none_of(parts.begin(), parts.end(), [&occupied](const Part& part) {
      return occupied.Meets(part.edge, part.low, part.high);
    });
    if (!is_free) continue;
    if (contact->overlap && selection == JoinSelection::kApart)
      for (const Part& part : parts) occupied.Add(part.edge, part.low, part.high);
    const std::vector<LocationPair> joined = PlacesToJoin(*contact, threshold, reach);
    places.insert(places.end(), joined.begin(), joined.end());
  }
  JoinLocations(graph, places, threshold);
}

void MergeContactVertices(SkeletonGraph& graph, const std::vector<Contact>& contacts) {
  std::vector<const Contact*> nearest_first;
  nearest_first.reserve(contacts.size());
  for (const Contact& contact : contacts) nearest_first.push_back(&contact);
  std::stable_sort(nearest_first.begin(), nearest_first.end(),
                   [](const Contact* a, const Contact* b) { return a->distance < b->distance; });
  VertexFinder finder(graph);
  std::set<std::tuple<NodeId, EdgeId, size_t>> used;
  std::vector<LocationPair> pairs;
  for (const Contact* contact : nearest_first) {
    const std::array<Vertex, 2> two = finder.NearestTwo(contact->closest);
    if (used.count(two[0].Key()) + used.count(two[1].Key()) > 0) continue;
    used.insert({two[0].Key(), two[1].Key()});
    pairs.emplace_back(two[0].location, two[1].location);
  }
  JoinLocations(graph, pairs, 0);
}

}  // namespace curvefusion
