#include "meshing/contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "kernel/angle.h"
#include "kernel/box_pairs.h"
#include "kernel/disjoint_sets.h"
#include "kernel/exact.h"

namespace curvefusion {

namespace {

// Mitred corners and the polygon's corners stand out of the round tube by this factor at most.
constexpr double kReach = 1.1;
// Tubes are clear of each other from this gap on, in radii of the thinner one. What comes closer is
// united exactly, so the gap only has to outlast the rounding and cleaning of unions.
constexpr double kClearance = 0.1;
// Tubes graze where their axes pass through this range of distances, of the sum of the radii: up to
// where they are clear, with what axes err, and down to where the hole among three or four tubes
// closes.
constexpr double kLeastGrazing = 0.8;
constexpr double kGreatestGrazing = 1.1;
// The cosine of the angle between a tube and the shortest way to the other one: 0 where they pass
// each other, more where they come together at a node (.5 for two that enclose 60 degrees).
constexpr double kGreatestSlant = 0.3;
// In radii, to either side: noise does not turn a chord of that length.
constexpr double kDirectionReach = 1.5;
// A tube may come back to itself only after it has turned by more than this in total.
constexpr double kTurnOfReturn = 2.0 * std::numbers::pi / 3;

struct TubeSegment {
  int path, index;
  Segment line;
  double radius_a, radius_b;
  double radius() const { return std::max(radius_a, radius_b); }
};

std::vector<TubeSegment> SegmentsOf(const std::vector<TubePath>& paths) {
  std::vector<TubeSegment> segments;
  for (int p = 0; p < static_cast<int>(paths.size()); ++p) {
    const TubeAxis& axis = paths[p].axis;
    for (int i = 0; i < paths[p].segment_count(); ++i) {
      const size_t j = (i + 1) % axis.points.size();
      segments.push_back({p, i, {axis.points[i], axis.points[j]}, axis.radii[i], axis.radii[j]});
    }
  }
  return segments;
}

double ClearDistance(double radius, double other_radius) {
  return kReach * (radius + other_radius) + kClearance * std::min(radius, other_radius);
}

bool ComeNear(const TubeSegment& s, const TubeSegment& t) {
  return ClosestDistance(s.line, t.line) < ClearDistance(s.radius(), t.radius());
}

std::vector<std::pair<int, int>> NearPairs(const std::vector<TubeSegment>& segments) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const TubeSegment& s : segments) {
    const Vec3 reach = Vec3::Constant((kReach + kClearance) * s.radius());
    Eigen::AlignedBox3d box(Vec3(s.line.a.cwiseMin(s.line.b) - reach),
                            Vec3(s.line.a.cwiseMax(s.line.b) + reach));
    boxes.push_back(box);
  }
  return OverlappingBoxes(boxes);
}

// Per path, the sum of all turns before each segment; one more entry holds the total of a closed
// path.
std::vector<std::vector<double>> TurnSums(const std::vector<TubePath>& paths) {
  std::vector<std::vector<double>> sums;
  for (const TubePath& path : paths) {
    const Polyline& points = path.axis.points;
    const size_t n = points.size();
    std::vector<double> sum = {0.0};
    for (int i = 1; i < path.segment_count() + (path.closed ? 1 : 0); ++i) {
      sum.push_back(sum.back() + AngleBetween(points[i % n] - points[i - 1],
                                              points[(i + 1) % n] - points[i % n]));
    }
    sums.push_back(std::move(sum));
  }
  return sums;
}

// Whether two segments are near only because one follows the other along a tube.
bool FollowEachOther(const std::vector<TubePath>& paths,
                     const std::vector<std::vector<double>>& turn_sums, const TubeSegment& s,
                     const TubeSegment& t) {
  if (s.path != t.path) return false;
  const std::vector<double>& sums = turn_sums[s.path];
  const double turn = std::abs(sums[t.index] - sums[s.index]);
  if (paths[s.path].closed) return std::min(turn, sums.back() - turn) < kTurnOfReturn;
  return turn < kTurnOfReturn;
}

// The points at which one path must be cut, given the pairs of its segments that touch.
std::vector<int> CutPoints(const std::vector<std::pair<int, int>>& touching) {
  std::map<int, int> last_touched;  // for every segment, the last earlier one it touches
  for (const auto& [i, j] : touching) {
    int& last = last_touched.try_emplace(j, i).first->second;
    last = std::max(last, i);
  }
  std::vector<int> cuts;
  int piece_start = 0;
  for (const auto& [segment, earlier] : last_touched) {
    if (earlier < piece_start) continue;
    piece_start = (earlier + segment + 1) / 2;
    cuts.push_back(piece_start);
  }
  return cuts;
}

std::vector<TubePath> CutOpenPath(TubePath path, const std::vector<int>& cuts) {
  std::vector<TubePath> pieces;
  for (auto cut = cuts.rbegin(); cut != cuts.rend(); ++cut) {
    std::vector<TubePath> parts = CutPath(path, *cut);
    pieces.push_back(std::move(parts[1]));
    path = std::move(parts[0]);
  }
  pieces.push_back(std::move(path));
  std::reverse(pieces.begin(), pieces.end());
  return pieces;
}

// Marks the rings at the ends of segment s that are too near to t for a cut.
void MarkCrowdedRings(const std::vector<TubePath>& paths, const TubeSegment& s,
                      const TubeSegment& t, std::vector<std::vector<char>>& crowded) {
  const size_t next = (s.index + 1) % paths[s.path].axis.points.size();
  if (ClosestDistance({s.line.a, s.line.a}, t.line) < ClearDistance(s.radius_a, t.radius())) {
    crowded[s.path][s.index] = 1;
  }
  if (ClosestDistance({s.line.b, s.line.b}, t.line) < ClearDistance(s.radius_b, t.radius())) {
    crowded[s.path][next] = 1;
  }
}

// The group of every segment, as the index of the group's first segment.
std::vector<int> GroupOfSegments(const std::vector<TubePath>& paths,
                                 const std::vector<TubeSegment>& segments) {
  const std::vector<std::vector<double>> turn_sums = TurnSums(paths);
  DisjointSets groups(segments.size());
  std::vector<std::vector<char>> crowded;
  for (const TubePath& path : paths) crowded.emplace_back(path.axis.points.size(), 0);
  for (const auto& [i, j] : NearPairs(segments)) {
    const TubeSegment& s = segments[i];
    const TubeSegment& t = segments[j];
    if (FollowEachOther(paths, turn_sums, s, t)) continue;
    if (ComeNear(s, t)) groups.Unite(i, j);
    MarkCrowdedRings(paths, s, t, crowded);
    MarkCrowdedRings(paths, t, s, crowded);
  }
  int first_of_path = 0;
  for (size_t i = 0; i < segments.size(); ++i) {
    const TubeSegment& s = segments[i];
    if (s.index == 0) first_of_path = static_cast<int>(i);
    if (!crowded[s.path][s.index] || (s.index == 0 && !paths[s.path].closed)) continue;
    const int before =
        s.index == 0 ? first_of_path + paths[s.path].segment_count() - 1 : static_cast<int>(i) - 1;
    groups.Unite(before, static_cast<int>(i));
  }
  std::vector<int> group(segments.size());
  for (size_t i = 0; i < segments.size(); ++i) group[i] = groups.Root(static_cast<int>(i));
  return group;
}

// Splits a path into maximal stretches of one group each; `group` holds the groups of its segments.
std::vector<TubeStretch> StretchesOfPath(int path, bool closed, const int* group, int count) {
  int start = 0;
  if (closed) {
    while (start < count && group[start] == group[(start + count - 1) % count]) ++start;
    if (start == count) return {{path, 0, count}};
  }
  std::vector<TubeStretch> stretches;
  for (int i = start; i < start + count; ++i) {
    if (i > start && group[i % count] == group[(i - 1) % count]) {
      ++stretches.back().last;
    } else {
      stretches.push_back({path, i, i + 1});
    }
  }
  return stretches;
}

// The direction of each segment of a path, noise averaged out.
std::vector<Vec3> DirectionsAlong(const TubePath& path) {
  Polyline points = path.axis.points;
  if (path.closed) points.push_back(points.front());
  const std::vector<double> along = CumulativeLength(points);
  std::vector<Vec3> directions;
  for (int i = 0; i < path.segment_count(); ++i) {
    const double reach = kDirectionReach * path.axis.radii[i];
    const double middle = (along[i] + along[i + 1]) / 2;
    const Vec3 chord =
        PointAt(points, along, middle + reach) - PointAt(points, along, middle - reach);
    directions.push_back(chord.normalized());
  }
  return directions;
}

// Whether s passes t side by side, at a distance at which they touch, at its nearest point or at
// one of its ends.
bool Grazes(const TubeSegment& s, const TubeSegment& t, const Vec3& along_s, const Vec3& along_t) {
  const double touch = s.radius() + t.radius();
  const double nearest = ClosestPoints(s.line.a, s.line.b, t.line.a, t.line.b).s;
  for (const double at : {0.0, nearest, 1.0}) {
    const Vec3 p = s.line.a + at * (s.line.b - s.line.a);
    const double on_t = ClosestParameter(t.line.a, t.line.b, p);
    const Vec3 offset = t.line.a + on_t * (t.line.b - t.line.a) - p;
    const double distance = offset.norm();
    if (distance < kLeastGrazing * touch || distance > kGreatestGrazing * touch) continue;
    const double slant = std::max(std::abs(offset.dot(along_s)), std::abs(offset.dot(along_t)));
    if (slant < kGreatestSlant * distance) return true;
  }
  return false;
}

std::vector<std::vector<std::pair<int, int>>> SelfContacts(const std::vector<TubePath>& paths) {
  const std::vector<TubeSegment> segments = SegmentsOf(paths);
  const std::vector<std::vector<double>> turn_sums = TurnSums(paths);
  std::vector<std::vector<std::pair<int, int>>> contacts(paths.size());
  for (const auto& [i, j] : NearPairs(segments)) {
    const TubeSegment& s = segments[i];
    const TubeSegment& t = segments[j];
    if (s.path != t.path || FollowEachOther(paths, turn_sums, s, t)) continue;
    if (ComeNear(s, t)) {
      contacts[s.path].emplace_back(s.index, t.index);
    }
  }
  return contacts;
}

}  // namespace

std::vector<TubePath> CutSelfContacts(std::vector<TubePath> paths) {
  std::vector<std::vector<std::pair<int, int>>> contacts = SelfContacts(paths);
  for (size_t p = 0; p < paths.size(); ++p) {
    if (paths[p].closed && !contacts[p].empty()) {
      paths[p] = CutPath(paths[p], contacts[p].front().second)[0];
    }
  }
  contacts = SelfContacts(paths);
  std::vector<TubePath> cut_paths;
  for (size_t p = 0; p < paths.size(); ++p) {
    for (TubePath& piece : CutOpenPath(std::move(paths[p]), CutPoints(contacts[p]))) {
      cut_paths.push_back(std::move(piece));
    }
  }
  return cut_paths;
}

std::vector<std::vector<TubeStretch>> GroupContacts(const std::vector<TubePath>& paths) {
  const std::vector<TubeSegment> segments = SegmentsOf(paths);
  const std::vector<int> group = GroupOfSegments(paths, segments);
  std::map<int, std::vector<TubeStretch>> stretches;
  int first = 0;
  for (int p = 0; p < static_cast<int>(paths.size()); ++p) {
    const int count = paths[p].segment_count();
    for (const TubeStretch& s : StretchesOfPath(p, paths[p].closed, &group[first], count)) {
      stretches[group[first + s.first % count]].push_back(s);
    }
    first += count;
  }
  std::vector<std::vector<TubeStretch>> groups;
  for (auto& [root, members] : stretches) groups.push_back(std::move(members));
  return groups;
}

std::vector<std::vector<char>> FindGrazingSegments(const std::vector<TubePath>& paths) {
  const std::vector<TubeSegment> segments = SegmentsOf(paths);
  const std::vector<std::vector<double>> turn_sums = TurnSums(paths);
  std::vector<std::vector<char>> grazing;
  std::vector<std::vector<Vec3>> directions;
  for (const TubePath& path : paths) {
    grazing.emplace_back(path.segment_count(), 0);
    directions.push_back(DirectionsAlong(path));
  }
  for (const auto& [i, j] : NearPairs(segments)) {
    const TubeSegment& s = segments[i];
    const TubeSegment& t = segments[j];
    if (FollowEachOther(paths, turn_sums, s, t)) continue;
    const Vec3& along_s = directions[s.path][s.index];
    const Vec3& along_t = directions[t.path][t.index];
    if (Grazes(s, t, along_s, along_t)) grazing[s.path][s.index] = 1;
    if (Grazes(t, s, along_t, along_s)) grazing[t.path][t.index] = 1;
  }
  return grazing;
}

}  // namespace curvefusion
