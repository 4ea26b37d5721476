#include "graph/contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "kernel/disjoint_sets.h"

namespace curvefusion {

namespace {

// Stretches of contact with less than so many thresholds between them along both edges are one
// (chosen).
constexpr double kStretchGap = 3;
// Lines that are within rounding of each other for so many times its size lie on one another
// (chosen).
constexpr double kCollinearExtent = 1e6;
constexpr double kFar = std::numeric_limits<double>::infinity();

// Where a contact of two curves lies: arc lengths on both.
using Arcs = std::array<double, 2>;

// Arc length between two places along their curve or over one shared node.
double Gap(const SegmentTable& table, const std::array<int, 2>& curves, const Arcs& arcs) {
  const auto [a, b] = curves;
  double gap = a == b ? std::abs(arcs[0] - arcs[1]) : kFar;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if ((a == b && i == j) || table.curves[a].nodes[i] != table.curves[b].nodes[j]) continue;
      gap = std::min(gap, (i == 0 ? arcs[0] : table.Length(a) - arcs[0]) +
                              (j == 0 ? arcs[1] : table.Length(b) - arcs[1]));
    }
  }
  return gap;
}

struct Interval {
  double low = kFar;
  double high = -kFar;

  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Adds the parameters in [0, 1] at which |w + x u| <= radius.
void AddWithinSphere(const Vec3& w, const Vec3& u, double radius, Interval& within) {
  const double uu = u.squaredNorm();
  const double middle = -w.dot(u) / uu;
  const double half = (radius * radius - (w + middle * u).squaredNorm()) / uu;
  if (!(half >= 0)) return;
  const double low = std::max(0.0, middle - std::sqrt(half));
  const double high = std::min(1.0, middle + std::sqrt(half));
  if (low > high) return;
  within.Add(low);
  within.Add(high);
}

// Adds the parameters of s at which it is within the radius of the line of t, beside t.
void AddWithinTube(const Segment& s, const Segment& t, double radius, Interval& within) {
  const Vec3 along = (t.b - t.a).normalized();
  const Vec3 w = s.a - t.a;
  const Vec3 u = s.b - s.a;
  const double rise = u.dot(along);
  double low = 0;
  double high = 1;
  if (rise != 0) {
    const double enter = -w.dot(along) / rise;
    const double leave = ((t.b - t.a).norm() - w.dot(along)) / rise;
    low = std::max(low, std::min(enter, leave));
    high = std::min(high, std::max(enter, leave));
  }
  if (low > high) return;
  const Vec3 across = u - rise * along;
  const Vec3 start = w + low * u - (w + low * u).dot(along) * along;
  if (across.squaredNorm() <= 1e-20 * u.squaredNorm()) {
    if (start.norm() > radius) return;
    within.Add(low);
    within.Add(high);
    return;
  }
  Interval part;
  AddWithinSphere(start, (high - low) * across, radius, part);
  if (part.low > part.high) return;
  within.Add(low + part.low * (high - low));
  within.Add(low + part.high * (high - low));
}

// The parameters of s at which it is within the radius of t; the nearest one at least.
Interval WithinInterval(const Segment& s, const Segment& t, double radius, double nearest) {
  Interval within;
  within.Add(nearest);
  AddWithinSphere(s.a - t.a, s.b - s.a, radius, within);
  AddWithinSphere(s.a - t.b, s.b - s.a, radius, within);
  AddWithinTube(s, t, radius, within);
  return within;
}

// A contact together with what is needed to unite it with others.
struct Stretch {
  std::array<int, 2> curves;
  std::array<Interval, 2> extent;  // arc lengths on both
  Arcs closest;
  Arcs first;
  Arcs last;
  double distance = kFar;

  void AddEnd(const Arcs& place) {
    if (place[0] < extent[0].low) first = place;
    if (place[0] > extent[0].high) last = place;
    for (int i = 0; i < 2; ++i) extent[i].Add(place[i]);
  }

  void Add(const Stretch& other) {
    if (std::tie(other.distance, other.closest) < std::tie(distance, closest)) {
      distance = other.distance;
      closest = other.closest;
    }
    AddEnd(other.first);
    AddEnd(other.last);
    for (int i = 0; i < 2; ++i) {
      extent[i].Add(other.extent[i].low);
      extent[i].Add(other.extent[i].high);
    }
  }
};

// The part of two segments that is in contact for a threshold: where they are within the radius.
Stretch StretchOf(const SegmentTable& table, const SegmentPair& pair, double threshold,
                  double radius) {
  const Segment s = table.At(pair.s);
  const Segment t = table.At(pair.t);
  const double reach = kConnectedReach * threshold;
  const std::vector<LinearGap> paths = ShortPaths(table, pair, reach);
  const ClosestParameters at = ClosestPointsBeyond(s, t, paths, reach);
  const auto arc_s = [&](double x) {
    return table.points[pair.s].arc_length +
           x * (table.points[pair.s + 1].arc_length - table.points[pair.s].arc_length);
  };
  const auto arc_t = [&](double y) {
    return table.points[pair.t].arc_length +
           y * (table.points[pair.t + 1].arc_length - table.points[pair.t].arc_length);
  };
  Stretch stretch;
  stretch.curves = {table.curve_of[pair.s], table.curve_of[pair.t]};
  stretch.closest = {arc_s(at.s), arc_t(at.t)};
  stretch.distance = (s.a + at.s * (s.b - s.a) - t.a - at.t * (t.b - t.a)).norm();
  const Interval on_s = WithinInterval(s, t, radius, at.s);
  const Interval on_t = WithinInterval(t, s, radius, at.t);
  stretch.AddEnd(stretch.closest);
  for (const double x : {on_s.low, on_s.high}) {
    const double y = ClosestParameter(t.a, t.b, s.a + x * (s.b - s.a));
    stretch.AddEnd({arc_s(x), arc_t(y)});
  }
  stretch.extent[1].Add(arc_t(on_t.low));
  stretch.extent[1].Add(arc_t(on_t.high));
  return stretch;
}

// Calls visit(neighbour) for the up to eight pairs that follow a pair on the same two curves.
template <class Visit>
void VisitNeighbours(const SegmentTable& table, const SegmentPair& pair, const Visit& visit) {
  const auto follows = [&table](int from, int to) {
    return table.IsSegment(to) && table.curve_of[from] == table.curve_of[to];
  };
  for (int ds = -1; ds <= 1; ++ds) {
    for (int dt = -1; dt <= 1; ++dt) {
      const SegmentPair next{pair.s + ds, pair.t + dt};
      if ((ds != 0 || dt != 0) && follows(pair.s, next.s) && follows(pair.t, next.t)) visit(next);
    }
  }
}

// Unites pairs that follow each other.
DisjointSets ConnectPairs(const SegmentTable& table, const std::vector<SegmentPair>& pairs) {
  DisjointSets sets(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i) {
    VisitNeighbours(table, pairs[i], [&](const SegmentPair& neighbour) {
      if (neighbour < pairs[i]) return;
      const auto found = std::lower_bound(pairs.begin(), pairs.end(), neighbour);
      if (found != pairs.end() && *found == neighbour)
        sets.Unite(static_cast<int>(i), static_cast<int>(found - pairs.begin()));
    });
  }
  return sets;
}

// One stretch per connected set of pairs.
std::vector<Stretch> Stretches(const SegmentTable& table, const std::vector<SegmentPair>& pairs,
                               double threshold, double radius) {
  DisjointSets sets = ConnectPairs(table, pairs);
  size_t count = 0;
  for (int i = 0; i < static_cast<int>(pairs.size()); ++i) count += sets.Root(i) == i;
  std::vector<Stretch> stretches;
  stretches.reserve(count);
  std::vector<int> stretch_of_root(pairs.size(), -1);
  for (size_t i = 0; i < pairs.size(); ++i) {
    const Stretch here = StretchOf(table, pairs[i], threshold, radius);
    int& index = stretch_of_root[sets.Root(static_cast<int>(i))];
    if (index < 0) {
      index = static_cast<int>(stretches.size());
      stretches.push_back(here);
    } else {
      stretches[index].Add(here);
    }
  }
  return stretches;
}

std::vector<Stretch> StretchesOf(const SegmentTable& table, const std::vector<SegmentPair>& pairs,
                                 double threshold, double radius) {
  std::vector<Stretch> stretches;
  stretches.reserve(pairs.size());
  for (const SegmentPair& pair : pairs)
    stretches.push_back(StretchOf(table, pair, threshold, radius));
  return stretches;
}

bool AreOneStretch(const Stretch& a, const Stretch& b, double gap) {
  if (a.curves != b.curves) return false;
  for (int i = 0; i < 2; ++i) {
    const double apart =
        std::max(a.extent[i].low - b.extent[i].high, b.extent[i].low - a.extent[i].high);
    if (apart > gap) return false;
  }
  return true;
}

// Noise breaks curves that run side by side into many short stretches: unites them.
std::vector<Stretch> UnitedStretches(std::vector<Stretch> stretches, double gap) {
  std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
    return std::tie(a.curves, a.extent[0].low, a.extent[1].low) <
           std::tie(b.curves, b.extent[0].low, b.extent[1].low);
  });
  size_t united = 0;  // those in front
  for (size_t i = 0; i < stretches.size(); ++i) {
    if (united > 0 && AreOneStretch(stretches[united - 1], stretches[i], gap)) {
      stretches[united - 1].Add(stretches[i]);
    } else {
      stretches[united++] = stretches[i];
    }
  }
  stretches.resize(united);
  return stretches;
}

Contact ToContact(const SegmentTable& table, const Stretch& stretch, double overlap_extent) {
  const auto place = [&](const Arcs& arcs) -> LocationPair {
    return {{table.curves[stretch.curves[0]].edge, arcs[0]},
            {table.curves[stretch.curves[1]].edge, arcs[1]}};
  };
  Contact contact;
  contact.closest = place(stretch.closest);
  contact.distance = stretch.distance;
  contact.closest_gap = Gap(table, stretch.curves, stretch.closest);
  contact.first = place(stretch.first);
  contact.last = place(stretch.last);
  contact.first_gap = Gap(table, stretch.curves, stretch.first);
  contact.last_gap = Gap(table, stretch.curves, stretch.last);
  double extent = 0;
  for (const Interval& interval : stretch.extent) extent += interval.high - interval.low;
  contact.overlap = extent > overlap_extent;
  return contact;
}

std::vector<Contact> ContactsOf(const SegmentTable& table, const std::vector<SegmentPair>& pairs,
                                double threshold, double radius) {
  // Two lines that cross at the angle of arms that have parted within the reach; where only lines
  // that have a point in common are in contact, lines that have more.
  const double overlap_extent =
      radius > threshold ? kCollinearExtent * radius : 2 * kConnectedReach * radius;
  // There each pair of segments is a contact of its own, as a curve may run over a place any number
  // of times: the ends of a stretch that is put together of several say little then.
  const std::vector<Stretch> stretches =
      radius > threshold
          ? StretchesOf(table, pairs, threshold, radius)
          : UnitedStretches(Stretches(table, pairs, threshold, radius), kStretchGap * radius);
  std::vector<Contact> contacts;
  contacts.reserve(stretches.size());
  for (const Stretch& stretch : stretches)
    contacts.push_back(ToContact(table, stretch, overlap_extent));
  return contacts;
}

// Whether the two places of a pair come together where their edge folds.
bool IsFold(const LocationPair& places, double gap) {
  const auto& [a, b] = places;
  return a.edge == b.edge && std::abs(a.arc_length - b.arc_length) <= gap;
}

}  // namespace

std::vector<Contact> FindContacts(const SkeletonGraph& graph, double threshold) {
  return ContactSearch(threshold).Find(graph);
}

ContactSearch::ContactSearch(double threshold) : threshold_(threshold), pairs_(threshold) {}

std::vector<Contact> ContactSearch::Find(const SkeletonGraph& graph) {
  pairs_.Update(graph);
  const double radius = std::max(threshold_, ResolutionAt(pairs_.largest_coordinate()));
  return ContactsOf(pairs_.table(), pairs_.pairs(), threshold_, radius);
}

std::vector<LocationPair> PlacesToJoin(const Contact& contact, double snap, double reach) {
  if (!contact.overlap) {
    if (contact.closest_gap > snap) return {contact.closest};
    return {contact.first_gap > contact.last_gap ? contact.first : contact.last};
  }
  // A stretch that begins where FindContacts stops to excuse a shared node goes on to that node.
  const double at_node = reach + 2 * snap;
  std::vector<LocationPair> places;
  bool is_joined = false;
  for (const bool at_first : {true, false}) {
    const LocationPair& end = at_first ? contact.first : contact.last;
    if ((at_first ? contact.first_gap : contact.last_gap) > at_node) {
      places.push_back(end);
      is_joined = true;
    } else if (IsFold(end, at_node)) {
      const double middle = (end.first.arc_length + end.second.arc_length) / 2;
      places.push_back({{end.first.edge, middle}, {end.first.edge, middle}});
    }
  }
  if (!is_joined) places.push_back(contact.closest);
  return places;
}

}  // namespace curvefusion
