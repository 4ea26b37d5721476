#include "graph/contacts.h"

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "kernel/disjoint_sets.h"
#include "kernel/exact.h"

namespace curvefusion {

namespace {

// Parts of one curve with less than so many thresholds between them are always near each other.
constexpr double kTrivialReach = 1.5;
// Stretches of contact with less than so many thresholds between them along both edges are one.
constexpr double kStretchGap = 3;
constexpr int kMaxPiecesPerSegment = 64;
constexpr double kFar = std::numeric_limits<double>::infinity();

// A segment or, where it is longer than the threshold, an equal part of it.
struct Piece {
  int curve;    // index into PieceTable::edges
  int segment;  // index of its first point
  int part;
  int parts;
  double begin;  // arc length along the edge
  double end;
};

struct PieceTable {
  const SkeletonGraph& graph;
  std::vector<EdgeId> edges;
  std::vector<double> lengths;  // of the edges
  std::vector<Piece> pieces;    // in order along the edges

  const SkeletonEdge& edge(int curve) const { return graph.edge(edges[curve]); }

  SegmentPart Part(int piece) const {
    const Piece& p = pieces[piece];
    const Polyline& points = edge(p.curve).points;
    return {points[p.segment], points[p.segment + 1], p.part, p.part + 1, p.parts};
  }

  // The rounded end points of a piece.
  std::array<Vec3, 2> Ends(int piece) const {
    const SegmentPart part = Part(piece);
    const Vec3 d = (part.b - part.a) / part.count;
    return {part.a + part.first * d, part.a + part.last * d};
  }
};

PieceTable CutIntoPieces(const SkeletonGraph& graph, double threshold) {
  PieceTable table{graph, graph.Edges(), {}, {}};
  for (size_t curve = 0; curve < table.edges.size(); ++curve) {
    const Polyline& points = graph.edge(table.edges[curve]).points;
    double arc = 0;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
      const double length = (points[i + 1] - points[i]).norm();
      const double wanted = threshold > 0 ? std::ceil(length / threshold) : 1;
      const int parts =
          static_cast<int>(std::clamp(wanted, 1.0, static_cast<double>(kMaxPiecesPerSegment)));
      for (int k = 0; k < parts; ++k) {
        table.pieces.push_back({static_cast<int>(curve), static_cast<int>(i), k, parts,
                                arc + length * k / parts, arc + length * (k + 1) / parts});
      }
      arc += length;
    }
    table.lengths.push_back(arc);
  }
  return table;
}

// Arc length between two pieces along their edge or over one shared node; kFar if there is none.
double Gap(const PieceTable& table, int g, int h) {
  const Piece& p = table.pieces[g];
  const Piece& q = table.pieces[h];
  const std::array<NodeId, 2>& p_nodes = table.edge(p.curve).nodes;
  const std::array<NodeId, 2>& q_nodes = table.edge(q.curve).nodes;
  double gap = kFar;
  if (p.curve == q.curve) gap = std::max(0.0, std::max(q.begin - p.end, p.begin - q.end));
  const std::array<double, 2> from_p = {p.begin, table.lengths[p.curve] - p.end};
  const std::array<double, 2> from_q = {q.begin, table.lengths[q.curve] - q.end};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (p.curve == q.curve && i == j) continue;
      if (p_nodes[i] == q_nodes[j]) gap = std::min(gap, from_p[i] + from_q[j]);
    }
  }
  return gap;
}

// Two pieces within the threshold, g < h.
struct PiecePair {
  int g;
  int h;
  auto operator<=>(const PiecePair&) const = default;
};

// A quick no for pairs whose boxes meet but whose bounding spheres are clearly apart. The margin is
// far above the rounding of these few operations.
bool ClearlyApart(const std::array<Vec3, 2>& s, const std::array<Vec3, 2>& t, double threshold) {
  const double reach = (s[1] - s[0]).norm() / 2 + (t[1] - t[0]).norm() / 2 + threshold;
  const Vec3 between = (s[0] + s[1] - t[0] - t[1]) / 2;
  const double margin = 1e-9 * reach + 1e-12 * (s[0].norm() + t[0].norm());
  return between.norm() > reach + margin;
}

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

std::vector<Box> InflatedBoxes(const PieceTable& table, double threshold) {
  std::vector<Box> boxes;
  boxes.reserve(table.pieces.size());
  for (size_t i = 0; i < table.pieces.size(); ++i) {
    const auto [a, b] = table.Ends(static_cast<int>(i));
    const Vec3 largest = a.cwiseAbs().cwiseMax(b.cwiseAbs());
    const Vec3 margin = Vec3::Constant(threshold * (0.5 + 1e-9)) + 1e-12 * largest;
    Vec3 low = a.cwiseMin(b) - margin;
    Vec3 high = a.cwiseMax(b) + margin;
    boxes.emplace_back(low.data(), high.data(), static_cast<int>(i));
  }
  return boxes;
}

// All pairs within the threshold but those next to each other along the graph, ascending.
std::vector<PiecePair> ClosePairs(const PieceTable& table, double threshold) {
  std::vector<Box> boxes = InflatedBoxes(table, threshold);
  std::vector<PiecePair> pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const int g = std::min(a.info(), b.info());
    const int h = std::max(a.info(), b.info());
    if (Gap(table, g, h) <= kTrivialReach * threshold) return;
    if (ClearlyApart(table.Ends(g), table.Ends(h), threshold)) return;
    if (AreWithin(table.Part(g), table.Part(h), threshold)) pairs.push_back({g, h});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// Calls visit(g', h') for the up to eight pairs around (g, h) on the same edges.
template <class Visit>
void VisitNeighbours(const PieceTable& table, const PiecePair& pair, const Visit& visit) {
  const auto same_edge = [&table](int i, int j) {
    return j >= 0 && j < static_cast<int>(table.pieces.size()) &&
           table.pieces[i].curve == table.pieces[j].curve;
  };
  for (int dg = -1; dg <= 1; ++dg) {
    for (int dh = -1; dh <= 1; ++dh) {
      if ((dg != 0 || dh != 0) && same_edge(pair.g, pair.g + dg) && same_edge(pair.h, pair.h + dh))
        visit(pair.g + dg, pair.h + dh);
    }
  }
}

// Unites pairs that are neighbours of each other in the table of pairs.
DisjointSets ConnectPairs(const PieceTable& table, const std::vector<PiecePair>& pairs) {
  DisjointSets sets(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    VisitNeighbours(table, pairs[i], [&](int g, int h) {
      const PiecePair neighbour{std::min(g, h), std::max(g, h)};
      if (neighbour < pairs[i]) return;
      const auto found = std::lower_bound(pairs.begin(), pairs.end(), neighbour);
      if (found != pairs.end() && *found == neighbour)
        sets.Unite(static_cast<int>(i), static_cast<int>(found - pairs.begin()));
    });
  }
  return sets;
}

// Drops the pairs that are near each other because one grows out of the other: reachable from
// neighbours along the graph over close pairs less than kConnectedReach thresholds apart.
std::vector<PiecePair> WithoutConnected(const PieceTable& table,
                                        const std::vector<PiecePair>& pairs, double threshold) {
  std::vector<PiecePair> near;
  std::vector<PiecePair> rest;
  for (const PiecePair& pair : pairs) {
    const bool is_near = Gap(table, pair.g, pair.h) < kConnectedReach * threshold;
    (is_near ? near : rest).push_back(pair);
  }
  DisjointSets sets = ConnectPairs(table, near);
  std::vector<char> connected(near.size(), 0);
  for (size_t i = 0; i < near.size(); ++i) {
    VisitNeighbours(table, near[i], [&](int g, int h) {
      if (Gap(table, g, h) <= kTrivialReach * threshold) connected[sets.Root(i)] = 1;
    });
  }
  for (size_t i = 0; i < near.size(); ++i)
    if (!connected[sets.Root(i)]) rest.push_back(near[i]);
  std::sort(rest.begin(), rest.end());
  return rest;
}

// A contact together with what is needed to unite it with others.
struct Stretch {
  std::array<int, 2> curves;
  std::array<double, 2> low = {kFar, kFar};  // arc lengths on both edges
  std::array<double, 2> high = {-kFar, -kFar};
  Contact contact;
};

void AddPair(const PieceTable& table, const PiecePair& pair, Stretch& stretch) {
  const Piece& p = table.pieces[pair.g];
  const Piece& q = table.pieces[pair.h];
  const auto [a, b] = table.Ends(pair.g);
  const auto [c, d] = table.Ends(pair.h);
  const ClosestParameters nearest = ClosestPoints(a, b, c, d);
  const double distance = (a + nearest.s * (b - a) - c - nearest.t * (d - c)).norm();
  const LocationPair here = {{table.edges[p.curve], p.begin + nearest.s * (p.end - p.begin)},
                             {table.edges[q.curve], q.begin + nearest.t * (q.end - q.begin)}};
  const double gap = Gap(table, pair.g, pair.h);
  Contact& contact = stretch.contact;
  if (stretch.high[0] < 0 || distance < contact.distance) {
    contact.closest = here;
    contact.distance = distance;
  }
  if (here.first.arc_length < stretch.low[0]) {
    contact.first = here;
    contact.first_gap = gap;
  }
  if (here.first.arc_length > stretch.high[0]) {
    contact.last = here;
    contact.last_gap = gap;
  }
  stretch.curves = {p.curve, q.curve};
  const std::array<double, 2> arcs = {here.first.arc_length, here.second.arc_length};
  for (int i = 0; i < 2; ++i) {
    stretch.low[i] = std::min(stretch.low[i], arcs[i]);
    stretch.high[i] = std::max(stretch.high[i], arcs[i]);
  }
}

void Unite(Stretch& into, const Stretch& other) {
  Contact& contact = into.contact;
  if (other.contact.distance < contact.distance) {
    contact.closest = other.contact.closest;
    contact.distance = other.contact.distance;
  }
  if (other.low[0] < into.low[0]) {
    contact.first = other.contact.first;
    contact.first_gap = other.contact.first_gap;
  }
  if (other.high[0] > into.high[0]) {
    contact.last = other.contact.last;
    contact.last_gap = other.contact.last_gap;
  }
  for (int i = 0; i < 2; ++i) {
    into.low[i] = std::min(into.low[i], other.low[i]);
    into.high[i] = std::max(into.high[i], other.high[i]);
  }
}

bool AreOneStretch(const Stretch& a, const Stretch& b, double gap) {
  if (a.curves != b.curves) return false;
  for (int i = 0; i < 2; ++i)
    if (std::max(a.low[i] - b.high[i], b.low[i] - a.high[i]) > gap) return false;
  return true;
}

// One stretch per connected set of pairs.
std::vector<Stretch> Stretches(const PieceTable& table, const std::vector<PiecePair>& pairs) {
  DisjointSets sets = ConnectPairs(table, pairs);
  std::vector<Stretch> stretches;
  std::vector<int> stretch_of_root(pairs.size(), -1);
  for (size_t i = 0; i < pairs.size(); ++i) {
    int& index = stretch_of_root[sets.Root(static_cast<int>(i))];
    if (index < 0) {
      index = static_cast<int>(stretches.size());
      stretches.emplace_back();
    }
    AddPair(table, pairs[i], stretches[index]);
  }
  return stretches;
}

// Noise breaks curves that run side by side into many short stretches: unites them.
std::vector<Stretch> UnitedStretches(std::vector<Stretch> stretches, double gap) {
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
    return std::tie(a.curves, a.low) < std::tie(b.curves, b.low);
  });
  std::vector<Stretch> united;
  for (const Stretch& stretch : stretches) {
    if (!united.empty() && AreOneStretch(united.back(), stretch, gap)) {
      Unite(united.back(), stretch);
    } else {
      united.push_back(stretch);
    }
  }
  return united;
}

}  // namespace

std::vector<Contact> FindContacts(const SkeletonGraph& graph, double threshold) {
  const PieceTable table = CutIntoPieces(graph, threshold);
  const std::vector<PiecePair> pairs =
      WithoutConnected(table, ClosePairs(table, threshold), threshold);
  std::vector<Contact> contacts;
  for (Stretch& stretch : UnitedStretches(Stretches(table, pairs), kStretchGap * threshold)) {
    const double extent = stretch.high[0] - stretch.low[0] + stretch.high[1] - stretch.low[1];
    stretch.contact.overlap = extent > kConnectedReach * threshold;
    contacts.push_back(stretch.contact);
  }
  return contacts;
}

std::vector<LocationPair> PlacesToJoin(const Contact& contact, double threshold) {
  if (!contact.overlap) return {contact.closest};
  // A stretch that begins where FindContacts stops to excuse a shared node goes on to that node.
  const double at_node = (kConnectedReach + 2) * threshold;
  std::vector<LocationPair> places;
  if (contact.first_gap > at_node) places.push_back(contact.first);
  if (contact.last_gap > at_node) places.push_back(contact.last);
  if (places.empty()) places.push_back(contact.closest);
  return places;
}

}  // namespace curvefusion
