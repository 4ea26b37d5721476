#include "graph/frechet_matching.h"

#include <algorithm>
#include <cassert>

#include "kernel/exact_chords.h"

namespace curvefusion {

namespace {

// Which part of a segment of one curve can be reached with a vertex of the other: of what lies
// within the distance of that vertex, what does not come before the chord of an earlier vertex.
struct Reach {
  int segment;
  int latest;  // of the vertices so far, the one whose chord begins last
};

Segment SegmentOf(const Polyline& points, int i) { return {points[i], points[i + 1]}; }

bool IsNear(const Polyline& points, int segment, const Vec3& p, double distance) {
  return AreWithin({p, p}, SegmentOf(points, segment), distance);
}

// Where a reachable part goes on at the next vertex; negative if nowhere.
int LatestAfter(const Polyline& points, int segment, const Polyline& other, int latest, int next,
                double distance) {
  const Segment s = SegmentOf(points, segment);
  if (!AreInOrder(s, other[latest], other[next], distance)) return -1;
  return BeginsLater(s, other[latest], other[next], distance) ? latest : next;
}

// The free space of two curves, column by column: a column is a segment of a, its rows are the
// segments of b.
class FreeSpace {
 public:
  FreeSpace(const Polyline& a, const Polyline& b, double distance)
      : a_(a), b_(b), distance_(distance) {}

  // What can be reached of b with the first point of a.
  std::vector<Reach> FirstColumn() const {
    std::vector<Reach> reached;
    for (int j = 0; j + 1 < Size(b_) && AreNear(0, j); ++j) reached.push_back({j, 0});
    return reached;
  }

  // What can be reached of b with point i + 1 of a, from what can be with point i.
  std::vector<Reach> NextColumn(int i, const std::vector<Reach>& left) {
    std::vector<Reach> right;
    // The vertex of b from which the segment of a is entered from below, if it can be.
    is_start_near_ = is_start_near_ && AreNear(i, 0);
    int below = is_start_near_ ? 0 : -1;
    size_t next = 0;
    int j = 0;
    while (true) {
      if (below < 0) {
        if (next == left.size()) break;
        j = left[next].segment;
      }
      const bool has_left = next < left.size() && left[next].segment == j;
      const int entry = has_left ? left[next++].latest : -1;
      if (IsNear(b_, j, a_[i + 1], distance_)) {
        const int latest = below >= 0 ? i + 1 : LatestAfter(b_, j, a_, entry, i + 1, distance_);
        if (latest >= 0) right.push_back({j, latest});
      }
      if (j + 2 == Size(b_)) break;
      below = Above(i, j, below, has_left);
      ++j;
    }
    return right;
  }

  bool AreNear(int i, int j) const { return AreWithin({a_[i], a_[i]}, {b_[j], b_[j]}, distance_); }

  PolylinePlace FirstPlace(const Reach& reach) const {
    return {static_cast<size_t>(reach.segment),
            ChordBegin(SegmentOf(b_, reach.segment), a_[reach.latest], distance_)};
  }

  static int Size(const Polyline& points) { return static_cast<int>(points.size()); }

 private:
  // The vertex of b whose chord bounds what can be reached of segment i of a with vertex j + 1 of
  // b; negative where nothing can.
  int Above(int i, int j, int below, bool has_left) const {
    if ((below < 0 && !has_left) || !IsNear(a_, i, b_[j + 1], distance_)) return -1;
    if (has_left) return j + 1;
    return LatestAfter(a_, i, b_, below, j + 1, distance_);
  }

  const Polyline& a_;
  const Polyline& b_;
  double distance_;
  bool is_start_near_ = true;  // all points of a so far are within the distance of b's first
};

}  // namespace

std::optional<std::vector<PolylinePlace>> MatchInOrder(const Polyline& a, const Polyline& b,
                                                       double distance) {
  assert(a.size() >= 2 && b.size() >= 2);
  FreeSpace space(a, b, distance);
  const int last = FreeSpace::Size(a) - 1;
  if (!space.AreNear(last, FreeSpace::Size(b) - 1)) return std::nullopt;
  std::vector<PolylinePlace> places;
  std::vector<Reach> reached = space.FirstColumn();
  for (int i = 0; !reached.empty(); ++i) {
    places.push_back(space.FirstPlace(reached.front()));
    if (i == last) break;
    reached = space.NextColumn(i, reached);
  }
  if (reached.empty() || reached.back().segment + 2 != FreeSpace::Size(b)) return std::nullopt;
  return places;
}

}  // namespace curvefusion
