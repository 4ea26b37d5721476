#include "meshing/tube_paths.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "kernel/angle.h"

namespace curvefusion {

namespace {

// Radii that differ by a smaller factor can be one tube.
constexpr double kSameRadius = 0.9;
// A tube that runs through is preferred over an end that is thicker by less than this factor.
constexpr double kPreferThrough = 0.98;
// The disc of a flat end keeps this part of the radius of the ball that covers it: clear of the
// ball's facets, and meeting them at an angle at which intersections are well conditioned.
constexpr double kCoveredPart = 0.92;
// In radii: a tube that runs through a node straight on within this needs no ring there.
constexpr double kStraightJoint = 0.04;

// The links of a network: which end continues in which, at which turn.
struct Chaining {
  std::vector<std::array<BranchEnd, 2>> next;  // per branch and side; branch -1 = a tube ends here
  std::vector<std::array<double, 2>> turn;     // per branch and side, 0 where the tube ends
  std::vector<std::array<TubeEnd, 2>> ends;
};

Vec3 InwardDirection(const TubeAxis& axis, int side) {
  const size_t n = axis.points.size();
  return side == 0 ? Vec3(axis.points[1] - axis.points[0])
                   : Vec3(axis.points[n - 2] - axis.points[n - 1]);
}

double EndRadius(const TubeAxis& axis, int side) {
  return side == 0 ? axis.radii.front() : axis.radii.back();
}

// The turn at the other point of the segment that ends at this end.
double TurnBefore(const TubeNetwork& network, const Chaining& chaining, BranchEnd end) {
  const Polyline& points = network.branches[end.branch].axis.points;
  const size_t n = points.size();
  if (n == 2) return chaining.turn[end.branch][1 - end.side];
  return TurnAngleAt(points, end.side == 0 ? 1 : n - 2);
}

bool WouldFold(const TubeNetwork& network, const Chaining& chaining, BranchEnd end, double turn,
               double radius) {
  const Vec3 segment = InwardDirection(network.branches[end.branch].axis, end.side);
  return StripFolds(segment.norm(), radius, turn, TurnBefore(network, chaining, end));
}

struct ThroughCandidate {
  double turn;
  BranchEnd a, b;
};

std::vector<ThroughCandidate> CandidatesAtNode(const TubeNetwork& network,
                                               const std::vector<BranchEnd>& ends,
                                               double max_turn) {
  std::vector<ThroughCandidate> candidates;
  for (size_t i = 0; i < ends.size(); ++i) {
    for (size_t j = i + 1; j < ends.size(); ++j) {
      const TubeAxis& a = network.branches[ends[i].branch].axis;
      const TubeAxis& b = network.branches[ends[j].branch].axis;
      const double turn =
          AngleBetween(-InwardDirection(a, ends[i].side), InwardDirection(b, ends[j].side));
      const auto [thin, thick] =
          std::minmax({EndRadius(a, ends[i].side), EndRadius(b, ends[j].side)});
      if (turn <= max_turn && thin >= kSameRadius * thick) {
        candidates.push_back({turn, ends[i], ends[j]});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& x, const auto& y) { return x.turn < y.turn; });
  return candidates;
}

// Links the straightest pairs at a node; returns the radius of the thickest tube that runs through.
double LinkAtNode(const TubeNetwork& network, const std::vector<BranchEnd>& ends, double max_turn,
                  Chaining& chaining) {
  double thickest = 0;
  const auto taken = [&](BranchEnd e) { return chaining.next[e.branch][e.side].branch >= 0; };
  for (const auto& [turn, a, b] : CandidatesAtNode(network, ends, max_turn)) {
    if (taken(a) || taken(b)) continue;
    const double radius = std::max(EndRadius(network.branches[a.branch].axis, a.side),
                                   EndRadius(network.branches[b.branch].axis, b.side));
    if (WouldFold(network, chaining, a, turn, radius) ||
        WouldFold(network, chaining, b, turn, radius)) {
      continue;
    }
    chaining.next[a.branch][a.side] = b;
    chaining.next[b.branch][b.side] = a;
    chaining.turn[a.branch][a.side] = chaining.turn[b.branch][b.side] = turn;
    thickest = std::max(thickest, radius);
  }
  return thickest;
}

// Decides which of the tubes that end at a node carries the ball.
void FinishEnds(const TubeNetwork& network, const std::vector<BranchEnd>& ends,
                double thickest_through, Chaining& chaining) {
  const BranchEnd* ball = nullptr;
  double ball_radius = thickest_through;
  for (const BranchEnd& end : ends) {
    if (chaining.next[end.branch][end.side].branch >= 0) continue;
    const double radius = EndRadius(network.branches[end.branch].axis, end.side);
    if (radius * (ball ? 1 : kPreferThrough) > ball_radius) {
      ball = &end;
      ball_radius = radius;
    }
  }
  for (const BranchEnd& end : ends) {
    const double radius = EndRadius(network.branches[end.branch].axis, end.side);
    const bool rounded = ball && ball->branch == end.branch && ball->side == end.side;
    chaining.ends[end.branch][end.side] = {rounded, std::min(radius, kCoveredPart * ball_radius),
                                           ends.size() > 1};
  }
}

Chaining LinkBranches(const TubeNetwork& network, double max_turn) {
  const size_t n = network.branches.size();
  Chaining chaining{std::vector<std::array<BranchEnd, 2>>(n, {BranchEnd{-1, 0}, BranchEnd{-1, 0}}),
                    std::vector<std::array<double, 2>>(n, {0.0, 0.0}),
                    std::vector<std::array<TubeEnd, 2>>(n)};
  const std::vector<std::vector<BranchEnd>> ends = network.EndsAtNodes();
  for (int node = 0; node < network.node_count; ++node) {
    const double through = LinkAtNode(network, ends[node], max_turn, chaining);
    FinishEnds(network, ends[node], through, chaining);
  }
  return chaining;
}

// Drops the point at which two branches were joined where the tube runs straight through: a ring
// there would double the facets that meet the other tubes.
void DropStraightJoint(size_t joint, TubeAxis& axis) {
  if (joint == 0 || ChordDeviation(axis, joint - 1, joint, joint + 1) > kStraightJoint) return;
  axis.points.erase(axis.points.begin() + static_cast<std::ptrdiff_t>(joint));
  axis.radii.erase(axis.radii.begin() + static_cast<std::ptrdiff_t>(joint));
}

// Appends a branch, entered at `from.side`, with points at the spacing of rings; the point it
// shares with the path so far is averaged or dropped.
void AppendBranch(const TubeNetwork& network, BranchEnd from, double ring_spacing, TubeAxis& axis) {
  TubeAxis piece = SubdivideAxis(network.branches[from.branch].axis, ring_spacing);
  if (from.side == 1) {
    std::reverse(piece.points.begin(), piece.points.end());
    std::reverse(piece.radii.begin(), piece.radii.end());
  }
  const size_t joint = axis.points.empty() ? 0 : axis.points.size() - 1;
  if (!axis.points.empty()) {
    axis.radii.back() = (axis.radii.back() + piece.radii.front()) / 2;
    piece.points.erase(piece.points.begin());
    piece.radii.erase(piece.radii.begin());
  }
  AppendAxis(piece, axis);
  DropStraightJoint(joint, axis);
}

// Follows the links from an end, which is a tube's end or lies on a ring without ends.
TubePath FollowLinks(const TubeNetwork& network, const Chaining& chaining, BranchEnd start,
                     double ring_spacing, std::vector<char>& used) {
  TubePath path;
  BranchEnd entry = start;
  while (true) {
    used[entry.branch] = 1;
    AppendBranch(network, entry, ring_spacing, path.axis);
    path.curves.push_back(network.branches[entry.branch].curve);
    const BranchEnd exit{entry.branch, 1 - entry.side};
    entry = chaining.next[exit.branch][exit.side];
    if (entry.branch < 0) {
      path.ends = {chaining.ends[start.branch][start.side], chaining.ends[exit.branch][exit.side]};
      return path;
    }
    if (used[entry.branch]) break;
  }
  path.closed = true;
  return path;
}

void RemoveRepeatedEnd(TubeAxis& axis) {
  axis.points.pop_back();
  axis.radii.front() = (axis.radii.front() + axis.radii.back()) / 2;
  axis.radii.pop_back();
}

}  // namespace

std::vector<TubePath> ChainTubes(const TubeNetwork& network, double max_turn, double ring_spacing) {
  const Chaining chaining = LinkBranches(network, max_turn);
  std::vector<char> used(network.branches.size(), 0);
  std::vector<TubePath> paths;
  for (const bool rings : {false, true}) {
    for (int branch = 0; branch < static_cast<int>(network.branches.size()); ++branch) {
      for (int side = 0; side < 2; ++side) {
        if (used[branch] || (!rings && chaining.next[branch][side].branch >= 0)) continue;
        paths.push_back(FollowLinks(network, chaining, {branch, side}, ring_spacing, used));
        if (paths.back().closed) RemoveRepeatedEnd(paths.back().axis);
      }
    }
  }
  return paths;
}

std::vector<TubePath> CutPath(const TubePath& path, int point_index) {
  const int n = static_cast<int>(path.axis.points.size());
  const double radius = path.axis.radii[point_index];
  const TubeEnd rounded{true, radius, true};
  const TubeEnd flat{false, kCoveredPart * radius};
  if (path.closed) {
    TubePath open{path.axis, false, {flat, rounded}, path.curves};
    std::rotate(open.axis.points.begin(), open.axis.points.begin() + point_index,
                open.axis.points.end());
    std::rotate(open.axis.radii.begin(), open.axis.radii.begin() + point_index,
                open.axis.radii.end());
    open.axis.points.push_back(open.axis.points.front());
    open.axis.radii.push_back(open.axis.radii.front());
    return {open};
  }
  assert(point_index > 0 && point_index + 1 < n);
  return {{Slice(path.axis, 0, point_index), false, {path.ends[0], rounded}, path.curves},
          {Slice(path.axis, point_index, n - 1), false, {flat, path.ends[1]}, path.curves}};
}

}  // namespace curvefusion
