#include "fusion/adjustment/curve_vertices.h"

#include <algorithm>
#include <map>
#include <utility>

#include "graph/edge_curve.h"
#include "kernel/angle.h"

namespace curvefusion {

namespace {

// Chosen, 20 degrees: two ends of wires welded to a third are one curve where they turn by less
// than this.
constexpr double kThroughAngle = 0.35;

double TurnAngle(const Vec3& before, const Vec3& here, const Vec3& behind) {
  return AngleBetween(here - before, behind - here);
}

void AddRow(const std::vector<Vec3>& positions, const std::array<int, 3>& row, double max_turn,
            std::vector<std::array<int, 3>>& rows) {
  if (TurnAngle(positions[row[0]], positions[row[1]], positions[row[2]]) < max_turn) {
    rows.push_back(row);
  }
}

// The vertices next to each node, one for every end of an edge.
std::map<int, std::vector<int>> NeighboursOfNodes(const CurveVertices& vertices) {
  std::map<int, std::vector<int>> neighbours;
  for (const std::vector<int>& edge : vertices.edges) {
    neighbours[edge.front()].push_back(edge[1]);
    neighbours[edge.back()].push_back(edge[edge.size() - 2]);
  }
  return neighbours;
}

// Curves go on through nodes: pairs of ends, the straightest first, each end in one pair.
void AddRowsThroughNodes(double corner_angle, CurveVertices& vertices) {
  for (auto& [node, ends] : NeighboursOfNodes(vertices)) {
    const double max_turn = ends.size() == 2 ? corner_angle : kThroughAngle;
    std::vector<std::pair<double, std::array<int, 3>>> pairs;
    for (size_t i = 0; i < ends.size(); ++i) {
      for (size_t j = i + 1; j < ends.size(); ++j) {
        const double turn = TurnAngle(vertices.positions[ends[i]], vertices.positions[node],
                                      vertices.positions[ends[j]]);
        if (turn < max_turn) pairs.push_back({turn, {ends[i], node, ends[j]}});
      }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<int> taken;
    for (const auto& [turn, row] : pairs) {
      const auto is_taken = [&](int end) {
        return std::find(taken.begin(), taken.end(), end) != taken.end();
      };
      if (is_taken(row[0]) || is_taken(row[2])) continue;
      vertices.rows.push_back(row);
      taken.insert(taken.end(), {row[0], row[2]});
    }
  }
}

}  // namespace

CurveVertices SampleVertices(const SkeletonGraph& skeleton, double step, double corner_angle) {
  CurveVertices vertices;
  std::map<NodeId, int> vertex_of_node;
  const auto add = [&](const Vec3& position, double radius) {
    vertices.positions.push_back(position);
    vertices.radii.push_back(radius);
    return static_cast<int>(vertices.positions.size()) - 1;
  };
  for (const NodeId node : skeleton.Nodes()) {
    if (skeleton.Degree(node) > 0) vertex_of_node[node] = add(skeleton.position(node), 0);
  }
  for (const EdgeId id : skeleton.Edges()) {
    const SkeletonEdge edge = Resampled(skeleton.edge(id), step);
    const auto radius = [&edge](size_t i) { return edge.radii.empty() ? 0 : edge.radii[i]; };
    std::vector<int> along = {vertex_of_node[edge.nodes[0]]};
    for (size_t i = 1; i + 1 < edge.points.size(); ++i) {
      along.push_back(add(edge.points[i], radius(i)));
    }
    along.push_back(vertex_of_node[edge.nodes[1]]);
    for (const size_t end : {size_t{0}, edge.points.size() - 1}) {
      double& node_radius = vertices.radii[end == 0 ? along.front() : along.back()];
      node_radius = std::max(node_radius, radius(end));
    }
    for (size_t i = 1; i + 1 < along.size(); ++i) {
      AddRow(vertices.positions, {along[i - 1], along[i], along[i + 1]}, corner_angle,
             vertices.rows);
    }
    vertices.edges.push_back(std::move(along));
  }
  AddRowsThroughNodes(corner_angle, vertices);
  return vertices;
}

SkeletonGraph WithVertices(const SkeletonGraph& skeleton, const CurveVertices& vertices,
                           double step) {
  SkeletonGraph moved = skeleton;
  const std::vector<EdgeId> ids = skeleton.Edges();
  for (size_t e = 0; e < ids.size(); ++e) {
    const std::vector<int>& along = vertices.edges[e];
    const auto& nodes = skeleton.edge(ids[e]).nodes;
    moved.MoveNode(nodes[0], vertices.positions[along.front()]);
    moved.MoveNode(nodes[1], vertices.positions[along.back()]);
  }
  for (size_t e = 0; e < ids.size(); ++e) {
    SkeletonEdge edge = Resampled(skeleton.edge(ids[e]), step);
    for (size_t i = 0; i < edge.points.size(); ++i) {
      edge.points[i] = vertices.positions[vertices.edges[e][i]];
    }
    moved.SetCurve(ids[e], std::move(edge.points), std::move(edge.radii),
                   std::move(edge.observations));
  }
  RemoveZeroLengthSegments(moved);
  return moved;
}

}  // namespace curvefusion
