#include "meshing/tube_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "kernel/error.h"

namespace curvefusion {

namespace {

// In radii: nodes joined by less become one, ...
constexpr double kShortBranch = 0.15;
// ... and what begins and ends in it without leaving this distance is dropped.
constexpr double kShortLoop = 0.3;
// A tube that is all there is of its component is at least so long.
constexpr double kLeastLength = 0.05;
// Radii that differ by a smaller factor belong to one tube.
constexpr double kSameRadius = 0.9;
// A branch may stick out of the one that swallows it by so much of the radius.
constexpr double kContainment = 1.02;
// One step of float32 coordinates must be finer than this part of the radius.
constexpr double kFinestFloatStep = 2e-3;

void RequireUsableVertex(EdgeId id, const Vec3& p, double radius) {
  if (!p.allFinite() || !std::isfinite(radius)) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("skeleton edge {}: a point or radius is not a finite number", id));
  }
  if (radius <= 0) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("skeleton edge {}: radius {} m; tubes need a radius > 0 (set one, or "
                            "leave the edge without radii for the default)",
                            id, radius));
  }
  const double step = p.cwiseAbs().maxCoeff() * std::numeric_limits<float>::epsilon();
  if (step > kFinestFloatStep * radius) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("skeleton edge {}: radius {} m at ({}, {}, {}) is too thin for the "
                            "32-bit coordinates of mesh files, whose steps are {:.2g} m there; "
                            "move the skeleton to the origin",
                            id, radius, p.x(), p.y(), p.z(), step));
  }
}

TubeBranch BranchOfEdge(EdgeId id, const SkeletonEdge& edge, double default_radius) {
  TubeBranch branch{edge.nodes, {edge.points, edge.radii}};
  if (branch.axis.radii.empty()) branch.axis.radii.assign(edge.points.size(), default_radius);
  for (size_t i = 0; i < edge.points.size(); ++i) {
    RequireUsableVertex(id, branch.axis.points[i], branch.axis.radii[i]);
  }
  return branch;
}

bool StaysWithin(const TubeAxis& axis, const Vec3& centre, double distance) {
  return std::all_of(axis.points.begin(), axis.points.end(),
                     [&](const Vec3& p) { return (p - centre).norm() <= distance; });
}

// Which node every node becomes when nodes at the same place, or next to each other on a short
// branch, are merged. A merged node moves by no more than kShortBranch radii.
class NodeMerging {
 public:
  explicit NodeMerging(const std::vector<Vec3>& positions)
      : positions_(positions), root_(positions.size()), merged_(positions.size(), 0) {
    std::iota(root_.begin(), root_.end(), 0);
    std::map<std::tuple<double, double, double>, int> first_at;
    for (size_t i = 0; i < positions.size(); ++i) {
      const Vec3& p = positions[i];
      root_[i] = first_at.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(i)).first->second;
    }
  }

  int Root(int node) const {
    while (root_[node] != node) node = root_[node];
    return node;
  }

  void MergeAcross(const TubeBranch& branch) {
    const int a = Root(branch.nodes[0]);
    const int b = Root(branch.nodes[1]);
    const double radius = *std::min_element(branch.axis.radii.begin(), branch.axis.radii.end());
    if (a == b || !StaysWithin(branch.axis, positions_[a], kShortBranch * radius)) return;
    if (!merged_[b]) {
      root_[b] = a;
      merged_[a] = 1;
    } else if (!merged_[a]) {
      root_[a] = b;
    }
  }

 private:
  const std::vector<Vec3>& positions_;
  std::vector<int> root_;
  std::vector<char> merged_;
};

// What is left of a branch that shrank to a point: a short straight one to its farthest point.
TubeBranch Remnant(const TubeBranch& branch, int node_count) {
  const Polyline& points = branch.axis.points;
  const auto farthest = std::max_element(points.begin(), points.end(), [&](auto& p, auto& q) {
    return (p - points[0]).norm() < (q - points[0]).norm();
  });
  const double true_radius = *std::max_element(branch.axis.radii.begin(), branch.axis.radii.end());
  const double true_length = (*farthest - points[0]).norm();
  const double length = std::max(true_length, kLeastLength * true_radius);
  // As much thinner as keeps the volume of what is nearly a ball.
  const double radius = true_radius - (length - true_length) / 4;
  const Vec3 direction = (*farthest - points[0]).normalized();
  return {{branch.nodes[0], node_count},
          {{points[0], points[0] + length * direction}, {radius, radius}}};
}

// Keeps components that would vanish because they are shorter than the tube is thick.
void KeepLastOfShrunk(std::vector<TubeBranch> shrunk, TubeNetwork& network) {
  std::vector<char> used(network.node_count, 0);
  for (const TubeBranch& branch : network.branches) {
    used[branch.nodes[0]] = used[branch.nodes[1]] = 1;
  }
  for (const TubeBranch& branch : shrunk) {
    if (used[branch.nodes[0]] || Length(branch.axis.points) <= 0) continue;
    used[branch.nodes[0]] = 1;
    network.branches.push_back(Remnant(branch, network.node_count++));
  }
}

void MergeNodes(TubeNetwork& network, const std::vector<Vec3>& positions) {
  NodeMerging merging(positions);
  for (const TubeBranch& branch : network.branches) merging.MergeAcross(branch);
  std::vector<TubeBranch> kept;
  std::vector<TubeBranch> shrunk;
  for (TubeBranch& branch : network.branches) {
    TubeBranch moved = branch;
    for (int& node : moved.nodes) node = merging.Root(node);
    moved.axis.points.front() = positions[moved.nodes[0]];
    moved.axis.points.back() = positions[moved.nodes[1]];
    const double radius = *std::max_element(branch.axis.radii.begin(), branch.axis.radii.end());
    const bool is_short = moved.nodes[0] == moved.nodes[1] &&
                          StaysWithin(moved.axis, moved.axis.points[0], kShortLoop * radius);
    if (is_short) branch.nodes = moved.nodes;
    (is_short ? shrunk : kept).push_back(is_short ? std::move(branch) : std::move(moved));
  }
  network.branches = std::move(kept);
  KeepLastOfShrunk(std::move(shrunk), network);
}

void Reverse(TubeBranch& branch) {
  std::swap(branch.nodes[0], branch.nodes[1]);
  std::reverse(branch.axis.points.begin(), branch.axis.points.end());
  std::reverse(branch.axis.radii.begin(), branch.axis.radii.end());
}

// Appends `tail`, which starts in the node where `branch` ends.
void Append(TubeBranch& branch, const TubeBranch& tail) {
  branch.nodes[1] = tail.nodes[1];
  branch.axis.points.insert(branch.axis.points.end(), tail.axis.points.begin() + 1,
                            tail.axis.points.end());
  branch.axis.radii.insert(branch.axis.radii.end(), tail.axis.radii.begin() + 1,
                           tail.axis.radii.end());
}

void RemoveMarked(const std::vector<char>& marked, TubeNetwork& network) {
  std::vector<TubeBranch> kept;
  for (size_t i = 0; i < network.branches.size(); ++i) {
    if (!marked[i]) kept.push_back(std::move(network.branches[i]));
  }
  network.branches = std::move(kept);
}

bool SameRadius(double a, double b) { return std::min(a, b) >= kSameRadius * std::max(a, b); }

// Joins the branches at degree-2 nodes: bends are found on whole curves. A jump in radius stays.
void DissolveDegree2Nodes(TubeNetwork& network) {
  std::vector<std::vector<BranchEnd>> ends = network.EndsAtNodes();
  std::vector<char> gone(network.branches.size(), 0);
  for (std::vector<BranchEnd>& at_node : ends) {
    if (at_node.size() != 2 || at_node[0].branch == at_node[1].branch) continue;
    const int first_id = at_node[0].branch;
    const int second_id = at_node[1].branch;
    TubeBranch first = network.branches[first_id];
    TubeBranch second = network.branches[second_id];
    if (at_node[0].side == 0) Reverse(first);
    if (at_node[1].side == 1) Reverse(second);
    if (!SameRadius(first.axis.radii.back(), second.axis.radii.front())) continue;
    const int far_node = second.nodes[1];
    const int near_node = first.nodes[0];
    Append(first, second);
    network.branches[first_id] = std::move(first);
    gone[second_id] = 1;
    at_node.clear();
    // Both far ends are ends of the joined branch now.
    for (BranchEnd& end : ends[near_node]) {
      if (end.branch == first_id) end.side = 0;
    }
    for (BranchEnd& end : ends[far_node]) {
      if (end.branch == second_id) end = {first_id, 1};
    }
  }
  RemoveMarked(gone, network);
}

// Keeps every curve as it was given, for the branches made of it.
void SimplifyBranches(const AxisOptions& options, TubeNetwork& network) {
  for (TubeBranch& branch : network.branches) {
    branch.curve = static_cast<int>(network.curves.size());
    network.curves.push_back(WithoutRepeatedPoints(branch.axis));
    branch.axis = SimplifyAxis(SmoothAxis(branch.axis), options);
  }
}

void CutAtTightBends(TubeNetwork& network, double max_turn) {
  std::vector<TubeBranch> pieces;
  for (const TubeBranch& branch : network.branches) {
    int first = 0;
    int first_node = branch.nodes[0];
    for (const int cut : FindCuts(branch.axis, max_turn)) {
      pieces.push_back(
          {{first_node, network.node_count}, Slice(branch.axis, first, cut), branch.curve});
      first = cut;
      first_node = network.node_count++;
    }
    const int last = static_cast<int>(branch.axis.points.size()) - 1;
    pieces.push_back(
        {{first_node, branch.nodes[1]}, Slice(branch.axis, first, last), branch.curve});
  }
  network.branches = std::move(pieces);
}

// Whether the tube along `inner` lies inside the tube along `outer`, judged at the points of
// `inner` and halfway between them.
bool IsInside(const TubeAxis& inner, const TubeAxis& outer) {
  const double outer_radius = *std::min_element(outer.radii.begin(), outer.radii.end());
  const auto covered = [&](const Vec3& p, double radius) {
    return Project(outer.points, p).distance + radius <= kContainment * outer_radius;
  };
  for (size_t i = 0; i < inner.points.size(); ++i) {
    if (!covered(inner.points[i], inner.radii[i])) return false;
    if (i > 0 && !covered((inner.points[i - 1] + inner.points[i]) / 2, inner.radii[i]))
      return false;
  }
  return true;
}

void DropSwallowedBranches(TubeNetwork& network) {
  std::map<std::pair<int, int>, std::vector<size_t>> between;
  for (size_t i = 0; i < network.branches.size(); ++i) {
    const auto [a, b] = std::minmax(network.branches[i].nodes[0], network.branches[i].nodes[1]);
    between[{a, b}].push_back(i);
  }
  std::vector<char> gone(network.branches.size(), 0);
  for (const auto& [nodes, parallel] : between) {
    for (const size_t inner : parallel) {
      for (const size_t outer : parallel) {
        if (inner == outer || gone[outer] || gone[inner]) continue;
        gone[inner] = IsInside(network.branches[inner].axis, network.branches[outer].axis);
      }
    }
  }
  RemoveMarked(gone, network);
}

}  // namespace

std::vector<std::vector<BranchEnd>> TubeNetwork::EndsAtNodes() const {
  std::vector<std::vector<BranchEnd>> ends(node_count);
  for (size_t i = 0; i < branches.size(); ++i) {
    for (int side = 0; side < 2; ++side) {
      ends[branches[i].nodes[side]].push_back({static_cast<int>(i), side});
    }
  }
  return ends;
}

TubeNetwork PrepareTubes(const SkeletonGraph& graph, double default_radius,
                         const AxisOptions& options) {
  TubeNetwork network;
  std::map<NodeId, int> dense_node;
  std::vector<Vec3> positions;
  for (const NodeId node : graph.Nodes()) {
    dense_node[node] = network.node_count++;
    positions.push_back(graph.position(node));
  }
  for (const EdgeId id : graph.Edges()) {
    TubeBranch branch = BranchOfEdge(id, graph.edge(id), default_radius);
    for (int& node : branch.nodes) node = dense_node.at(node);
    network.branches.push_back(std::move(branch));
  }
  MergeNodes(network, positions);
  DissolveDegree2Nodes(network);
  SimplifyBranches(options, network);
  CutAtTightBends(network, options.max_turn);
  DropSwallowedBranches(network);
  return network;
}

}  // namespace curvefusion
