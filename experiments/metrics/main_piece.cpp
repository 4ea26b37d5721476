#include "experiments/metrics/main_piece.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "experiments/metrics/curve_metrics.h"
#include "graph/connected_parts.h"
#include "kernel/point_grid.h"

namespace curvefusion {
namespace {

using Pieces = std::vector<std::vector<EdgeId>>;

double LengthOf(const SkeletonGraph& graph, const std::vector<EdgeId>& edges) {
  double length = 0;
  for (const EdgeId edge : edges) length += Length(graph.edge(edge).points);
  return length;
}

// For each sample the index of its piece.
std::vector<int> PieceOfSamples(const SkeletonSamples& samples, const Pieces& pieces) {
  std::vector<int> of_edge;
  for (size_t piece = 0; piece < pieces.size(); ++piece) {
    for (const EdgeId edge : pieces[piece]) {
      of_edge.resize(std::max<size_t>(of_edge.size(), edge + 1), -1);
      of_edge[edge] = static_cast<int>(piece);
    }
  }
  std::vector<int> of_samples;
  for (const EdgeId edge : samples.edges) of_samples.push_back(of_edge[edge]);
  return of_samples;
}

// Metres of truth within reach of each piece; where several are, it counts for all of them.
std::vector<double> ExplainedLengths(const SkeletonGraph& result, const Pieces& pieces,
                                     const SkeletonSamples& truth) {
  const SkeletonSamples samples = SampleSkeleton(result);
  const std::vector<int> piece_of = PieceOfSamples(samples, pieces);
  const PointGrid grid(samples.positions, kCurveReach);
  std::vector<double> explained(pieces.size(), 0.0);
  std::vector<int> last_seen(pieces.size(), -1);  // by which sample of the truth
  for (size_t i = 0; i < truth.size(); ++i) {
    grid.ForEachWithin(truth.positions[i], kCurveReach, [&](int found, const Vec3&) {
      const int piece = piece_of[found];
      if (std::exchange(last_seen[piece], static_cast<int>(i)) == static_cast<int>(i)) return;
      explained[piece] += truth.lengths[i];
    });
  }
  return explained;
}

}  // namespace

SkeletonGraph MainPiece(const SkeletonGraph& result, const SkeletonGraph& truth) {
  const Pieces pieces = ConnectedEdges(result);
  if (pieces.size() < 2) return result;
  const std::vector<double> explained = ExplainedLengths(result, pieces, SampleSkeleton(truth));
  const auto merit = [&](size_t piece) {
    return std::pair(explained[piece], LengthOf(result, pieces[piece]));
  };
  size_t main = 0;
  for (size_t piece = 1; piece < pieces.size(); ++piece) {
    if (merit(piece) > merit(main)) main = piece;
  }
  SkeletonGraph left = result;
  for (size_t piece = 0; piece < pieces.size(); ++piece) {
    if (piece == main) continue;
    for (const EdgeId edge : pieces[piece]) left.RemoveEdge(edge);
  }
  left.RemoveIsolatedNodes();
  return left;
}

}  // namespace curvefusion
