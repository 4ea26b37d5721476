#include "graph/crossings.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "graph/connected_parts.h"
#include "graph/edge_curve.h"
#include "graph/open_ends.h"
#include "kernel/angle.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

// Chosen on 20 training scans, four of them of cables (docs/lab_notebook.md).
constexpr double kDrawn = 10 * kMillimetre;   // so far contraction draws crossing curves together
constexpr double kFitted = 25 * kMillimetre;  // of each branch beyond that
constexpr double kLeastFitted = 2.5 * kMillimetre;  // likewise; shorter branches tell nothing
constexpr double kMaxResidual = 0.8 * kMillimetre;
// Radians. Chosen from what was measured: cables have .35 at most, a star of four arms .64.
constexpr double kMaxKink = 0.45;
// Of the sum of the radii. Chosen from what was measured: axes that meet have .14 and less in the
// median of a scan, cables that touch .9 to 1.2.
constexpr double kMinApart = 0.6;
constexpr double kMaxApart = 1.5;
constexpr double kMinApartShare = 0.5;       // of the crossings of a connected part
constexpr double kMinLooseShare = 0.2;       // of these, of which a wire ends free and bends
constexpr double kStraight = 0.95;           // distance of the ends over the length of a wire
constexpr double kStraightOn = 0.87;         // cosine: turns by less than 30 degrees
constexpr int kSamples = 12;                 // of a branch
constexpr int kSteps = 20;                   // between two branches
constexpr double kScale = 30 * kMillimetre;  // of the parameter, so that powers stay near 1

// The end of an edge at a junction: of its two, 0 or 1.
using BranchEnd = std::pair<EdgeId, int>;

// A curve through a junction, from one branch to another.
struct Passage {
  std::array<BranchEnd, 2> branches;
  double radius = 0;
  double residual = 0;  // metres, root of the mean square
  Polyline points;      // between the places where the branches are left
  double apart = std::numeric_limits<double>::infinity();  // from the next, over both radii
  size_t nearest = 0;                                      // of the points, to it
};

// A junction that wires pass through.
struct Crossing {
  std::vector<Passage> passages;
  bool is_apart = false;  // wires touch; otherwise axes meet
};

// Points of a branch beyond where curves are drawn together, by their distance along it.
struct Samples {
  std::array<Vec3, kSamples> points;
  double step = 0;
};

SkeletonEdge FromJunction(const SkeletonGraph& graph, const BranchEnd& branch) {
  SkeletonEdge edge = graph.edge(branch.first);
  if (branch.second == 1) Reverse(edge);
  return edge;
}

std::optional<Samples> SamplesOf(const SkeletonGraph& graph, const BranchEnd& branch) {
  const SkeletonEdge edge = FromJunction(graph, branch);
  const std::vector<double> arc_lengths = CumulativeLength(edge.points);
  const double length = std::min(kFitted, arc_lengths.back() - kDrawn);
  if (edge.radii.empty() || length < kLeastFitted) return std::nullopt;
  Samples samples;
  samples.step = length / (kSamples - 1);
  for (int i = 0; i < kSamples; ++i)
    samples.points[i] = PointAt(edge.points, arc_lengths, kDrawn + i * samples.step);
  return samples;
}

Eigen::RowVector4d Powers(double t) {
  t /= kScale;
  return {1, t, t * t, t * t * t};
}

// A cubic fitted to both branches, moved to begin and end where they do.
Passage PassageBetween(const Samples& before, const Samples& after) {
  const double half = 0.5 * (before.points[0] - after.points[0]).norm();
  Eigen::Matrix<double, 2 * kSamples, 4> powers;
  Eigen::Matrix<double, 2 * kSamples, 3> values;
  for (int i = 0; i < kSamples; ++i) {
    powers.row(i) = Powers(-half - i * before.step);
    values.row(i) = before.points[i].transpose();
    powers.row(kSamples + i) = Powers(half + i * after.step);
    values.row(kSamples + i) = after.points[i].transpose();
  }
  const Eigen::Matrix<double, 4, 3> cubic = powers.colPivHouseholderQr().solve(values);
  Passage passage;
  passage.residual = std::sqrt((powers * cubic - values).squaredNorm() / (2 * kSamples));
  const Vec3 at_begin = before.points[0] - (Powers(-half) * cubic).transpose();
  const Vec3 at_end = after.points[0] - (Powers(half) * cubic).transpose();
  for (int i = 0; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    const Vec3 p = (Powers((2 * share - 1) * half) * cubic).transpose();
    passage.points.emplace_back(p + (1 - share) * at_begin + share * at_end);
  }
  passage.points.front() = before.points[0];
  passage.points.back() = after.points[0];
  return passage;
}

// Radians by which a wire turns between two branches beyond what they bend themselves: chords of
// branches lie (kDrawn + length / 2) from the junction each, those of their halves length / 2 from
// each other.
double Kink(const Samples& before, const Samples& after) {
  const auto bend = [](const Samples& s) {
    const Vec3& middle = s.points[kSamples / 2];
    return AngleBetween(middle - s.points.front(), s.points.back() - middle);
  };
  const auto middle = [](const Samples& s) { return kDrawn + 0.5 * (kSamples - 1) * s.step; };
  const double turn = AngleBetween(before.points.front() - before.points.back(),
                                   after.points.back() - after.points.front());
  const double bent = bend(before) / ((kSamples - 1) * before.step) +
                      bend(after) / ((kSamples - 1) * after.step);  // radians a metre
  return turn - bent * (middle(before) + middle(after));
}

double RadiusOf(const SkeletonGraph& graph, const BranchEnd& branch) {
  return Median(graph.edge(branch.first).radii);
}

// All branches in pairs that go on as smooth curves, the smoothest first; none where one is left.
std::vector<Passage> PassagesOf(const SkeletonGraph& graph,
                                const std::vector<BranchEnd>& branches) {
  std::vector<Samples> samples;
  for (const BranchEnd& branch : branches) {
    const std::optional<Samples> found = SamplesOf(graph, branch);
    if (!found) return {};
    samples.push_back(*found);
  }
  std::vector<Passage> all;
  for (size_t i = 0; i < branches.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      Passage passage = PassageBetween(samples[i], samples[j]);
      if (passage.residual > kMaxResidual || Kink(samples[i], samples[j]) > kMaxKink) continue;
      passage.branches = {branches[i], branches[j]};
      passage.radius = 0.5 * (RadiusOf(graph, branches[i]) + RadiusOf(graph, branches[j]));
      all.push_back(std::move(passage));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Passage& a, const Passage& b) { return a.residual < b.residual; });
  std::vector<Passage> passages;
  std::set<BranchEnd> used;
  for (Passage& passage : all) {
    const auto& [a, b] = passage.branches;
    if (used.contains(a) || used.contains(b)) continue;
    used.insert({a, b});
    passages.push_back(std::move(passage));
  }
  if (used.size() < branches.size()) passages.clear();
  return passages;
}

// Finds where two passages come nearest to each other.
void Measure(Passage& first, Passage& second) {
  double least = std::numeric_limits<double>::infinity();
  size_t of_first = 0, of_second = 0;
  for (size_t i = 0; i < first.points.size(); ++i) {
    for (size_t j = 0; j < second.points.size(); ++j) {
      const double distance = (first.points[i] - second.points[j]).norm();
      if (distance >= least) continue;
      least = distance;
      of_first = i;
      of_second = j;
    }
  }
  const double apart = least / (first.radius + second.radius);
  for (const auto& [passage, nearest] :
       {std::pair(&first, of_first), std::pair(&second, of_second)}) {
    if (apart >= passage->apart) continue;
    passage->apart = apart;
    passage->nearest = nearest;
  }
}

// Whether a passage lies on another as wires do that touch, between its branches.
bool LiesOnAnother(const Passage& passage) {
  return passage.nearest > 0 && passage.nearest < kSteps && passage.apart > kMinApart &&
         passage.apart < kMaxApart;
}

std::vector<BranchEnd> BranchesAt(const SkeletonGraph& graph, NodeId node) {
  std::vector<BranchEnd> branches;
  for (const EdgeId edge : graph.IncidentEdges(node))
    branches.emplace_back(edge, graph.edge(edge).nodes[0] == node ? 0 : 1);
  return branches;
}

std::vector<Crossing> FindCrossings(const SkeletonGraph& graph) {
  std::vector<Crossing> crossings;
  for (const NodeId node : graph.Nodes()) {
    const int degree = graph.Degree(node);
    if (degree != 4 && degree != 6) continue;
    Crossing crossing = {PassagesOf(graph, BranchesAt(graph, node))};
    if (crossing.passages.empty()) continue;
    for (size_t i = 0; i < crossing.passages.size(); ++i)
      for (size_t j = 0; j < i; ++j) Measure(crossing.passages[i], crossing.passages[j]);
    crossing.is_apart =
        std::all_of(crossing.passages.begin(), crossing.passages.end(), LiesOnAnother);
    crossings.push_back(std::move(crossing));
  }
  return crossings;
}

using Continuations = std::map<BranchEnd, BranchEnd>;

// At other junctions a wire goes on where two branches run straight on, the straightest first.
void AddStraightOn(const SkeletonGraph& graph, NodeId node, Continuations& next) {
  const std::vector<BranchEnd> branches = BranchesAt(graph, node);
  const std::vector<OpenEnd> ends = EndsAt(graph, node, {kDrawn, kFitted});
  std::vector<std::tuple<double, BranchEnd, BranchEnd>> pairs;
  for (size_t i = 0; i < ends.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (const double cosine = -ends[i].outward.dot(ends[j].outward); cosine > kStraightOn)
        pairs.emplace_back(-cosine, branches[i], branches[j]);
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [cosine, a, b] : pairs) {
    if (next.contains(a) || next.contains(b)) continue;
    next[a] = b;
    next[b] = a;
  }
}

Continuations ContinuationsOf(const SkeletonGraph& graph, const std::vector<Crossing>& crossings) {
  Continuations next;
  for (const Crossing& crossing : crossings) {
    for (const Passage& passage : crossing.passages) {
      next[passage.branches[0]] = passage.branches[1];
      next[passage.branches[1]] = passage.branches[0];
    }
  }
  for (const NodeId node : graph.Nodes()) AddStraightOn(graph, node, next);
  return next;
}

// A wire from a crossing on, through others, to where it ends.
struct Reach {
  double length = 0;
  Vec3 end;
  bool is_free = false;
};

Reach ReachOf(const SkeletonGraph& graph, const Continuations& next, BranchEnd branch) {
  Reach reach;
  for (size_t i = 0; i <= next.size(); ++i) {
    const SkeletonEdge& edge = graph.edge(branch.first);
    const BranchEnd far = {branch.first, 1 - branch.second};
    reach.length += Length(edge.points);
    reach.end = graph.position(edge.nodes[far.second]);
    reach.is_free = graph.Degree(edge.nodes[far.second]) == 1;
    const auto found = next.find(far);
    if (found == next.end()) break;
    branch = found->second;
  }
  return reach;
}

bool IsLoose(const SkeletonGraph& graph, const Continuations& next, const Passage& passage) {
  const Reach one = ReachOf(graph, next, passage.branches[0]);
  const Reach other = ReachOf(graph, next, passage.branches[1]);
  return (one.is_free || other.is_free) &&
         (one.end - other.end).norm() < kStraight * (one.length + other.length);
}

// The branch from a node on, along a passage and then as it was.
SkeletonEdge Along(const Polyline& passage, double radius, const SkeletonEdge& branch) {
  const std::vector<double> arc_lengths = CumulativeLength(branch.points);
  // The passage at its other end may have made the branch shorter.
  const double from = std::min(kDrawn, arc_lengths.back() - kLeastFitted);
  const SkeletonEdge rest = PartOfEdge(branch, arc_lengths, from, arc_lengths.back());
  SkeletonEdge edge;
  edge.points = passage;
  edge.points.insert(edge.points.end(), rest.points.begin() + 1, rest.points.end());
  edge.radii.assign(passage.size(), radius);
  edge.radii.insert(edge.radii.end(), rest.radii.begin() + 1, rest.radii.end());
  if (!rest.observations.empty()) {
    edge.observations.assign(passage.size(), rest.observations.front());
    edge.observations.insert(edge.observations.end(), rest.observations.begin() + 1,
                             rest.observations.end());
  }
  return edge;
}

void Separate(const Crossing& crossing, std::map<BranchEnd, BranchEnd>& now, SkeletonGraph& graph) {
  for (const Passage& passage : crossing.passages) {
    const auto nearest = static_cast<std::ptrdiff_t>(passage.nearest);
    const NodeId node = graph.AddNode(passage.points[passage.nearest]);
    const Polyline back(passage.points.rend() - nearest - 1, passage.points.rend());
    const Polyline ahead(passage.points.begin() + nearest, passage.points.end());
    for (const auto& [way, end] :
         {std::pair(back, passage.branches[0]), std::pair(ahead, passage.branches[1])}) {
      const auto moved = now.find(end);
      const BranchEnd branch = moved == now.end() ? end : moved->second;
      SkeletonEdge old = FromJunction(graph, branch);
      SkeletonEdge edge = Along(way, passage.radius, old);
      edge.nodes = {node, old.nodes[1]};
      graph.RemoveEdge(branch.first);
      const EdgeId added = graph.AddEdge(std::move(edge));
      now[{end.first, 1 - end.second}] = {added, 1};
    }
  }
}

// So that no edge ends twice at one junction.
void SplitLoops(SkeletonGraph& graph) {
  for (const EdgeId id : graph.Edges()) {
    const SkeletonEdge& edge = graph.edge(id);
    if (edge.nodes[0] == edge.nodes[1] && graph.Degree(edge.nodes[0]) > 2 &&
        edge.points.size() > 2) {
      graph.SplitEdge(id, edge.points.size() / 2);
    }
  }
}

// Of a connected part of the graph.
struct Counts {
  int crossings = 0;
  int apart = 0;
  int loose = 0;  // of those apart
};

// The crossings of parts that are loose wires.
std::vector<Crossing> LooseCrossings(const SkeletonGraph& graph, std::vector<Crossing> crossings) {
  const Continuations next = ContinuationsOf(graph, crossings);
  std::map<EdgeId, int> part_of;
  int parts = 0;
  for (const std::vector<EdgeId>& part : ConnectedEdges(graph)) {
    for (const EdgeId id : part) part_of[id] = parts;
    ++parts;
  }
  const auto part = [&part_of](const Crossing& crossing) {
    return part_of.at(crossing.passages[0].branches[0].first);
  };
  std::vector<Counts> counts(parts);
  for (const Crossing& crossing : crossings) {
    Counts& count = counts[part(crossing)];
    ++count.crossings;
    if (!crossing.is_apart) continue;
    ++count.apart;
    count.loose +=
        std::any_of(crossing.passages.begin(), crossing.passages.end(),
                    [&](const Passage& passage) { return IsLoose(graph, next, passage); });
  }
  std::erase_if(crossings, [&](const Crossing& crossing) {
    const Counts& count = counts[part(crossing)];
    return !crossing.is_apart || count.apart < kMinApartShare * count.crossings ||
           count.loose < kMinLooseShare * count.apart;
  });
  return crossings;
}

}  // namespace

int SeparateCrossings(SkeletonGraph& graph) {
  int separated = 0;
  // More crossings can be told once branches are longer.
  for (;;) {
    SplitLoops(graph);
    const std::vector<Crossing> crossings = LooseCrossings(graph, FindCrossings(graph));
    std::map<BranchEnd, BranchEnd> now;  // ends of edges that were replaced
    for (const Crossing& crossing : crossings) Separate(crossing, now, graph);
    graph.RemoveIsolatedNodes();
    graph.DissolveDegree2Nodes();
    if (crossings.empty()) return separated;
    separated += static_cast<int>(crossings.size());
  }
}

}  // namespace curvefusion
