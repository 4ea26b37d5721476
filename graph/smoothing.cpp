#include "graph/smoothing.h"

#include <Eigen/Sparse>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "graph/edge_curve.h"
#include "graph/graph_smoother.h"
#include "graph/validate.h"
#include "kernel/angle.h"

namespace curvefusion {

namespace {

// Directions before and behind a corner are taken over this many steps. Chosen: longer than the
// noise, shorter than the bends of wires.
constexpr double kCornerWindow = 8;

// Twice what a file of curves may hold (kMaxTextBytes); measured: 840,000 take .6 s and 540 MB.
constexpr double kMaxVertices = 1e6;

// An edge at equal steps, and the indices of the points that are corners.
struct SampledEdge {
  SkeletonEdge edge;
  std::vector<size_t> corners;
};

double TurnAngle(const Vec3& before, const Vec3& here, const Vec3& behind) {
  return AngleBetween(here - before, behind - here);
}

// Arc lengths of the corners of a curve: where it turns by more than `angle` within a window, and
// most within that window.
std::vector<double> Corners(const Polyline& points, double angle, double window) {
  const std::vector<double> arcs = CumulativeLength(points);
  std::vector<std::pair<double, double>> turns;  // arc length, angle
  for (size_t i = 0; i < points.size(); ++i) {
    if (arcs[i] < window || arcs[i] > arcs.back() - window) continue;
    const double turn = TurnAngle(PointAt(points, arcs, arcs[i] - window), points[i],
                                  PointAt(points, arcs, arcs[i] + window));
    if (turn > angle) turns.emplace_back(arcs[i], turn);
  }
  std::vector<double> corners;
  for (const auto& [arc, turn] : turns) {
    const bool is_largest =
        std::all_of(turns.begin(), turns.end(), [&, arc = arc, turn = turn](const auto& other) {
          return std::abs(other.first - arc) > window || other.second < turn ||
                 (other.second == turn && other.first >= arc);
        });
    if (is_largest) corners.push_back(arc);
  }
  return corners;
}

void Append(const SkeletonEdge& part, SkeletonEdge& whole) {
  const auto append = [](const auto& from, auto& to) {
    to.insert(to.end(), from.begin() + (to.empty() || from.empty() ? 0 : 1), from.end());
  };
  append(part.points, whole.points);
  append(part.radii, whole.radii);
  append(part.observations, whole.observations);
}

SampledEdge Sampled(const SkeletonEdge& edge, const SmoothingOptions& options) {
  const std::vector<double> arcs = CumulativeLength(edge.points);
  std::vector<double> cuts;
  if (options.corner_angle < M_PI)
    cuts = Corners(edge.points, options.corner_angle, kCornerWindow * options.step);
  cuts.push_back(arcs.back());
  SampledEdge sampled{{edge.nodes, {}, {}, {}}, {}};
  double from = 0;
  for (const double to : cuts) {
    Append(Resampled(PartOfEdge(edge, arcs, from, to), options.step), sampled.edge);
    sampled.corners.push_back(sampled.edge.points.size() - 1);
    from = to;
  }
  sampled.corners.pop_back();
  // A closed curve shorter than three steps would become a point and back.
  if (edge.points.front() == edge.points.back() && sampled.edge.points.size() < 4)
    return {edge, {}};
  return sampled;
}

// The unknowns: one per node, then one per inner point of every edge.
class VertexTable {
 public:
  VertexTable(const SkeletonGraph& graph, const std::vector<SampledEdge>& edges) {
    const std::vector<NodeId> nodes = graph.Nodes();
    index_of_node_.assign(nodes.empty() ? 0 : nodes.back() + 1, -1);
    for (const NodeId node : nodes) index_of_node_[node] = count_++;
    for (const SampledEdge& sampled : edges) {
      first_inner_.push_back(count_);
      count_ += static_cast<int>(sampled.edge.points.size()) - 2;
    }
  }

  int count() const { return count_; }
  int OfNode(NodeId node) const { return index_of_node_[node]; }

  int OfPoint(size_t edge_index, const SkeletonEdge& edge, size_t point) const {
    if (point == 0) return OfNode(edge.nodes[0]);
    if (point + 1 == edge.points.size()) return OfNode(edge.nodes[1]);
    return first_inner_[edge_index] + static_cast<int>(point) - 1;
  }

 private:
  std::vector<int> index_of_node_;
  std::vector<int> first_inner_;
  int count_ = 0;
};

// The normal equations of Eq. 1. Held vertices keep their position: their rows are the identity,
// and what they contribute to others stands on the right-hand side.
class NormalEquations {
 public:
  explicit NormalEquations(int vertices)
      : start_(Eigen::MatrixX3d::Zero(vertices, 3)),
        weights_(Eigen::VectorXd::Zero(vertices)),
        held_(vertices, 0) {}

  void SetStart(int vertex, const Vec3& position) { start_.row(vertex) = position.transpose(); }
  void Hold(int vertex) { held_[vertex] = 1; }

  // weight |v - v0|^2.
  void AddDataTerm(int vertex, double weight) { weights_[vertex] += weight; }

  // lambda |a - 2 b + c|^2. All held vertices must be known.
  void AddSmoothnessTerm(const std::array<int, 3>& vertices, double lambda) {
    for (int i = 0; i < 3; ++i) {
      if (held_[vertices[i]]) continue;
      for (int j = 0; j < 3; ++j) {
        const double entry = lambda * kSecondDifference[i] * kSecondDifference[j];
        if (held_[vertices[j]]) {
          to_held_.emplace_back(vertices[i], vertices[j], entry);
        } else if (vertices[j] <= vertices[i]) {
          entries_.emplace_back(vertices[i], vertices[j], entry);
        }
      }
    }
  }

  // The minimum; with twicing, plus the minimum for what is left of the data.
  Eigen::MatrixX3d Solve(bool twicing, SparseSolver& solver) const {
    const int n = static_cast<int>(start_.rows());
    std::vector<Eigen::Triplet<double>> lower = entries_;
    lower.reserve(lower.size() + n);
    for (int i = 0; i < n; ++i) lower.emplace_back(i, i, weights_[i]);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(lower.begin(), lower.end());
    solver.Factorise(matrix);  // positive definite: every vertex has a data term
    Eigen::MatrixX3d smooth = solver.Solve(RightHandSide(start_));
    if (!twicing) return smooth;
    const Eigen::MatrixX3d lost = start_ - smooth;
    return smooth + solver.Solve(RightHandSide(lost));
  }

 private:
  Eigen::MatrixX3d RightHandSide(const Eigen::MatrixX3d& data) const {
    Eigen::MatrixX3d rhs = weights_.asDiagonal() * data;
    for (const Eigen::Triplet<double>& entry : to_held_)
      rhs.row(entry.row()) -= entry.value() * data.row(entry.col());
    return rhs;
  }

  Eigen::MatrixX3d start_;
  Eigen::VectorXd weights_;
  std::vector<char> held_;
  std::vector<Eigen::Triplet<double>> entries_;  // lower triangle, without the data terms
  std::vector<Eigen::Triplet<double>> to_held_;  // of free vertices in the columns of held ones
};

// An end of an edge: its index, and whether it is the last point.
using EdgeEnd = std::pair<size_t, bool>;

// The ends of edges at every node.
std::vector<std::vector<EdgeEnd>> EndsAtNodes(const std::vector<SampledEdge>& edges,
                                              const VertexTable& table) {
  std::vector<std::vector<EdgeEnd>> ends(table.count());
  for (size_t e = 0; e < edges.size(); ++e) {
    const SkeletonEdge& edge = edges[e].edge;
    ends[table.OfNode(edge.nodes[0])].emplace_back(e, false);
    ends[table.OfNode(edge.nodes[1])].emplace_back(e, true);
  }
  return ends;
}

// A node of degree 2 is a point of one curve and counts once, as if it were dissolved.
double DataWeight(const SkeletonGraph& graph, const SkeletonEdge& edge, size_t point) {
  const bool is_end = point == 0 || point + 1 == edge.points.size();
  return is_end && graph.Degree(edge.nodes[point == 0 ? 0 : 1]) == 2 ? 0.5 : 1;
}

void AddEdgeTerms(const SkeletonGraph& graph, const std::vector<SampledEdge>& edges,
                  const VertexTable& table, double lambda, NormalEquations& equations) {
  for (size_t e = 0; e < edges.size(); ++e) {
    const auto& [edge, corners] = edges[e];
    for (size_t i = 0; i < edge.points.size(); ++i)
      equations.AddDataTerm(table.OfPoint(e, edge, i), DataWeight(graph, edge, i));
    for (size_t i = 1; i + 1 < edge.points.size(); ++i) {
      if (std::binary_search(corners.begin(), corners.end(), i)) continue;
      equations.AddSmoothnessTerm(
          {table.OfPoint(e, edge, i - 1), table.OfPoint(e, edge, i), table.OfPoint(e, edge, i + 1)},
          lambda);
    }
  }
}

// The smoothness term centred at nodes of degree 2, unless the curve has a corner there.
void AddNodeTerms(const SkeletonGraph& graph, const std::vector<SampledEdge>& edges,
                  const VertexTable& table, const SmoothingOptions& options,
                  NormalEquations& equations) {
  const std::vector<std::vector<EdgeEnd>> ends = EndsAtNodes(edges, table);
  for (const NodeId node : graph.Nodes()) {
    const int vertex = table.OfNode(node);
    if (ends[vertex].size() != 2) continue;
    std::array<Vec3, 2> ahead;
    std::array<int, 2> beside;
    for (int side = 0; side < 2; ++side) {
      const auto& [e, from_end] = ends[vertex][side];
      SkeletonEdge edge = edges[e].edge;
      beside[side] = table.OfPoint(e, edge, from_end ? edge.points.size() - 2 : 1);
      if (from_end) Reverse(edge);
      ahead[side] =
          PointAt(edge.points, CumulativeLength(edge.points), kCornerWindow * options.step);
    }
    if (TurnAngle(ahead[0], graph.position(node), ahead[1]) > options.corner_angle) continue;
    equations.AddSmoothnessTerm({beside[0], vertex, beside[1]}, options.lambda);
  }
}

// The graph with smoothed positions in place of the sampled ones.
SkeletonGraph WithPositions(SkeletonGraph graph, std::vector<SampledEdge> edges,
                            const VertexTable& table, const Eigen::MatrixX3d& positions) {
  for (const NodeId node : graph.Nodes())
    graph.MoveNode(node, positions.row(table.OfNode(node)).transpose());
  const std::vector<EdgeId> ids = graph.Edges();
  for (size_t e = 0; e < ids.size(); ++e) {
    SkeletonEdge& edge = edges[e].edge;
    for (size_t i = 0; i < edge.points.size(); ++i)
      edge.points[i] = positions.row(table.OfPoint(e, edge, i)).transpose();
    graph.SetCurve(ids[e], std::move(edge.points), std::move(edge.radii),
                   std::move(edge.observations));
  }
  RemoveZeroLengthSegments(graph);
  return graph;
}

}  // namespace

SmoothingOptions PaperSmoothingOptions() {
  SmoothingOptions options;
  options.hold_free_ends = false;
  options.corner_angle = M_PI;
  options.keep_curvature = false;
  return options;
}

SkeletonGraph SmoothGraph(const SkeletonGraph& graph, const SmoothingOptions& options) {
  return GraphSmoother().Smooth(graph, options);
}

SkeletonGraph GraphSmoother::Smooth(const SkeletonGraph& graph, const SmoothingOptions& options) {
  RequireLength(graph, kMaxVertices * options.step, "graph to be smoothed");
  std::vector<SampledEdge> edges;
  for (const EdgeId id : graph.Edges()) edges.push_back(Sampled(graph.edge(id), options));
  const VertexTable table(graph, edges);
  if (table.count() == 0) return graph;
  NormalEquations equations(table.count());
  for (const NodeId node : graph.Nodes()) {
    equations.SetStart(table.OfNode(node), graph.position(node));
    if (graph.Degree(node) == 0) equations.AddDataTerm(table.OfNode(node), 1);
    if (graph.Degree(node) == 1 && options.hold_free_ends) equations.Hold(table.OfNode(node));
  }
  for (size_t e = 0; e < edges.size(); ++e) {
    const SkeletonEdge& edge = edges[e].edge;
    for (size_t i = 1; i + 1 < edge.points.size(); ++i)
      equations.SetStart(table.OfPoint(e, edge, i), edge.points[i]);
  }
  AddEdgeTerms(graph, edges, table, options.lambda, equations);
  AddNodeTerms(graph, edges, table, options, equations);
  return WithPositions(graph, std::move(edges), table,
                       equations.Solve(options.keep_curvature, solver_));
}

}  // namespace curvefusion
