#include "experiments/metrics/topology_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "experiments/metrics/assignment.h"
#include "experiments/metrics/junction_metrics.h"
#include "experiments/metrics/main_piece.h"
#include "experiments/metrics/point_matching.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

double CostOf(const Eigen::MatrixXd& cost, const std::vector<int>& columns) {
  double sum = 0;
  for (size_t row = 0; row < columns.size(); ++row) {
    if (columns[row] >= 0) sum += cost(static_cast<Eigen::Index>(row), columns[row]);
  }
  return sum;
}

// The least cost over all assignments of rows to different columns; rows <= columns.
double LeastCost(const Eigen::MatrixXd& cost) {
  std::vector<int> columns(cost.cols());
  std::iota(columns.begin(), columns.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    const std::vector<int> chosen(columns.begin(), columns.begin() + cost.rows());
    least = std::min(least, CostOf(cost, chosen));
  } while (std::next_permutation(columns.begin(), columns.end()));
  return least;
}

TEST(MinimumCostAssignment, MatchesTryingAll) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::MatrixXd cost =
        Eigen::MatrixXd::NullaryExpr(1 + trial % 5, 5 + trial % 2, [&] { return uniform(random); });
    const std::vector<int> columns = MinimumCostAssignment(cost);
    EXPECT_NEAR(CostOf(cost, columns), LeastCost(cost), 1e-12);  // rounding
    const Eigen::MatrixXd transposed = cost.transpose();
    const std::vector<int> of_transposed = MinimumCostAssignment(transposed);
    EXPECT_NEAR(CostOf(transposed, of_transposed), LeastCost(cost), 1e-12);
    EXPECT_EQ(std::count(of_transposed.begin(), of_transposed.end(), -1),
              transposed.rows() - transposed.cols());
  }
}

TEST(MinimumCostAssignment, NoRowsOrNoColumns) {
  EXPECT_TRUE(MinimumCostAssignment(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(MinimumCostAssignment(Eigen::MatrixXd(2, 0)), (std::vector<int>{-1, -1}));
}

// Groups of near points are paired apart; together they are as good as one assignment of all.
TEST(MatchPoints, AsGoodAsOneAssignment) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(0, 0.06);
  const auto points = [&](int count) {
    std::vector<Vec3> drawn;
    for (int i = 0; i < count; ++i) drawn.emplace_back(uniform(random), uniform(random), 0);
    return drawn;
  };
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<Vec3> expected = points(30);
    const std::vector<Vec3> found = points(20 + trial);
    Eigen::MatrixXd cost(expected.size(), found.size());
    for (size_t i = 0; i < expected.size(); ++i) {
      for (size_t j = 0; j < found.size(); ++j) {
        const double distance = (expected[i] - found[j]).norm();
        cost(i, j) = distance < 0.005 ? distance : 1e3;
      }
    }
    const std::vector<int> partner = MatchPoints(expected, found, 0.005);
    const auto unpaired = std::count(partner.begin(), partner.end(), -1);
    // An assignment of all pairs as many points as there are in the smaller set, some of them far.
    const auto idle =
        static_cast<double>(expected.size() - std::min(expected.size(), found.size()));
    EXPECT_NEAR(CostOf(cost, partner) + 1e3 * (static_cast<double>(unpaired) - idle),
                CostOf(cost, MinimumCostAssignment(cost)), 1e-9);  // rounding
  }
  EXPECT_EQ(MatchPoints(points(2), {}, 0.005), (std::vector<int>{-1, -1}));
  EXPECT_TRUE(MatchPoints({}, points(2), 0.005).empty());
}

TEST(MatchJunctions, IdentityIsPerfect) {
  const SkeletonGraph lattice = Lattice(4, 4, 0.05);
  const JunctionScores scores = MatchJunctions(lattice, lattice, 0.005);
  EXPECT_EQ(scores.truth, 12);  // all nodes but the four corners
  EXPECT_EQ(scores.matched, 12);
  EXPECT_EQ(scores.valence_right, 12);
  EXPECT_EQ(scores.Score().F(), 1.0);
}

TEST(MatchJunctions, TheLimitDecides) {
  const SkeletonGraph truth = YShape(0.05);
  const SkeletonGraph shifted = YShape(0.05, Vec3(0.007, 0, 0));
  EXPECT_EQ(MatchJunctions(shifted, truth, 0.010).matched, 1);
  EXPECT_EQ(MatchJunctions(shifted, truth, 0.005).matched, 0);
}

TEST(MatchJunctions, ADoubledJunctionCountsOnce) {
  SkeletonGraph result = YShape(0.05);
  const SkeletonGraph truth = result;
  // A second junction 4 mm along an arm.
  const NodeId second = result.SplitEdge(result.Edges()[0], 4);
  const Vec3 at = result.position(second);
  Connect(result, second, result.AddNode(at + Vec3(0, 0, 0.03)),
          StraightLine(at, at + Vec3(0, 0, 0.03)));
  const JunctionScores scores = MatchJunctions(result, truth, 0.010);
  EXPECT_EQ(scores.found, 2);
  EXPECT_EQ(scores.matched, 1);
  EXPECT_EQ(scores.valence_right, 1);
  EXPECT_EQ(scores.Score().precision, 0.5);
  EXPECT_EQ(scores.Score().recall, 1.0);
}

TEST(MatchJunctions, PairsAsManyAsPossible) {
  // Found junctions at 0 and 6 mm, true ones at 5 and 14 mm: the nearest pair (6, 5) would leave
  // the others 14 mm apart; one to one, both pairs lie within 10 mm.
  const auto two = [](double a, double b) {
    SkeletonGraph graph = YShape(0.002, Vec3(a, 0, 0), 0.001);
    const SkeletonGraph other = YShape(0.002, Vec3(b, 0, 0), 0.001);
    std::vector<NodeId> copies;
    for (const NodeId node : other.Nodes()) copies.push_back(graph.AddNode(other.position(node)));
    for (const EdgeId id : other.Edges()) {
      const SkeletonEdge& edge = other.edge(id);
      Connect(graph, copies[edge.nodes[0]], copies[edge.nodes[1]], edge.points);
    }
    return graph;
  };
  EXPECT_EQ(MatchJunctions(two(0, 0.006), two(0.005, 0.014), 0.010).matched, 2);
}

TEST(MatchJunctions, NoJunctions) {
  SkeletonGraph wire;
  wire.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  const JunctionScores none = MatchJunctions(wire, wire, 0.01);
  EXPECT_EQ(none.Score().F(), std::nullopt);
  EXPECT_EQ(none.ValenceShare(), std::nullopt);
  EXPECT_EQ(MatchJunctions(wire, YShape(0.05), 0.01).Score().recall, 0.0);
}

TEST(MatchTips, PairsFreeEndsWithinTheLimit) {
  const SkeletonGraph truth = YShape(0.05);
  SkeletonGraph result = truth;
  // One tip 4 mm short, one 6 mm; a false wire adds two.
  const auto shorten = [&](EdgeId edge, size_t points) {
    const NodeId node = result.SplitEdge(edge, result.edge(edge).points.size() - 1 - points);
    for (const EdgeId part : std::vector<EdgeId>(result.IncidentEdges(node).begin(),
                                                 result.IncidentEdges(node).end())) {
      const NodeId end = result.OtherEnd(part, node);
      if (result.Degree(end) == 1) result.RemoveEdge(part);
    }
    result.RemoveIsolatedNodes();
  };
  const std::vector<EdgeId> arms = truth.Edges();
  shorten(arms[0], 4);
  shorten(arms[1], 6);
  result.AddPolyline(StraightLine({1, 0, 0}, {1, 0.1, 0}));
  const TipScores tips = MatchTips(result, truth, 0.005);
  EXPECT_EQ(tips.truth, 3);
  EXPECT_EQ(tips.found, 5);
  EXPECT_EQ(tips.matched, 2);
  EXPECT_EQ(tips.Score().recall, 2.0 / 3);
  EXPECT_EQ(tips.Score().precision, 2.0 / 5);
}

TEST(MatchTips, ClosedCurvesHaveNone) {
  SkeletonGraph ring;
  ring.AddPolyline(Ring(0.1, 40));
  const TipScores tips = MatchTips(ring, Lattice(3, 3, 0.05), 0.005);
  EXPECT_EQ(tips.Score().recall, std::nullopt);
  EXPECT_EQ(tips.Score().precision, std::nullopt);
  EXPECT_EQ(MatchTips({}, YShape(0.05), 0.005).Score().recall, 0.0);
}

TEST(MainPiece, ExplainsMostEvenIfAFalseOneIsLonger) {
  const SkeletonGraph truth = Lattice(3, 3, 0.05);
  SkeletonGraph result = truth;
  const EdgeId false_piece = result.AddPolyline(StraightLine({0, 0, 0.1}, {3, 0, 0.1}));
  const EdgeId fragment = result.AddPolyline(StraightLine({0, 0, 0.005}, {0.1, 0, 0.005}));
  const SkeletonGraph main = MainPiece(result, truth);
  EXPECT_EQ(main.Edges(), truth.Edges());
  EXPECT_FALSE(main.HasEdge(false_piece));
  EXPECT_FALSE(main.HasEdge(fragment));
  EXPECT_EQ(main.node_count(), truth.node_count());
}

TEST(MainPiece, TheLongestWhereNothingIsExplained) {
  SkeletonGraph result;
  result.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  const EdgeId longest = result.AddPolyline(StraightLine({0, 1, 0}, {0.2, 1, 0}));
  EXPECT_EQ(MainPiece(result, {}).Edges(), std::vector<EdgeId>{longest});
  EXPECT_TRUE(MainPiece({}, result).empty());
}

TEST(CompareTopology, CountsPiecesAndCycles) {
  SkeletonGraph result = Lattice(2, 3, 0.05);
  result.AddPolyline(Ring(0.02, 40, Vec3(1, 0, 0)));
  const TopologyScores scores = CompareTopology(result, Lattice(3, 3, 0.05));
  EXPECT_EQ(scores.components, 2);
  EXPECT_EQ(scores.cycles, 3);
  EXPECT_EQ(scores.true_components, 1);
  EXPECT_EQ(scores.true_cycles, 4);
}

TEST(PathSimilarity, IdentityIsOneAlsoForLoops) {
  const SkeletonGraph lattice = Lattice(3, 3, 0.07);
  EXPECT_NEAR(*PathSimilarity(lattice, lattice), 1, 1e-9);  // rounding of lengths
  SkeletonGraph ring;
  ring.AddPolyline(Ring(0.1, 90));
  EXPECT_NEAR(*PathSimilarity(ring, ring), 1, 1e-9);
}

TEST(PathSimilarity, AMissingHalfCostsItsPairs) {
  SkeletonGraph whole;
  whole.AddPolyline({{0, 0, 0}, {0.2, 0, 0}});
  SkeletonGraph half;
  half.AddPolyline({{0, 0, 0}, {0.1, 0, 0}});
  // Control points at 0, 50, 100, 150, 200 mm: of the 10 pairs the 3 within the half exist.
  EXPECT_NEAR(*PathSimilarity(whole, half), 0.3, 1e-9);
  EXPECT_NEAR(*PathSimilarity(half, whole), 1, 1e-9);
  const AplsScores scores = ComparePaths(half, whole);
  EXPECT_NEAR(*scores.Apls(), 2 * 0.3 / 1.3, 1e-9);
}

TEST(PathSimilarity, AGapMakesPathsMissing) {
  SkeletonGraph whole;
  whole.AddPolyline({{0, 0, 0}, {0.2, 0, 0}});
  SkeletonGraph broken;
  broken.AddPolyline({{0, 0, 0}, {0.12, 0, 0}});
  broken.AddPolyline({{0.125, 0, 0}, {0.2, 0, 0}});
  // 0, 50, 100 mm lie on one piece, 150 and 200 mm on the other: 3 + 1 of 10 pairs.
  EXPECT_NEAR(*PathSimilarity(whole, broken), 0.4, 1e-9);
}

TEST(PathSimilarity, ADetourCostsItsRelativeLength) {
  const Polyline side = {{0, 0, 0}, {0.04, 0, 0}};
  const Polyline detour = {{0, 0, 0}, {0, 0.008, 0}, {0.04, 0.008, 0}, {0.04, 0, 0}};
  SkeletonGraph direct;
  direct.AddPolyline(side);
  SkeletonGraph longer;
  longer.AddPolyline(detour);
  // One pair, 40 mm apart, and 56 mm by the detour.
  EXPECT_NEAR(*PathSimilarity(direct, longer), 1 - 16.0 / 40, 1e-9);
}

// With control points every 50 mm this would take 20,000 searches through as many vertices.
TEST(PathSimilarity, LongCurvesHaveFewerControlPoints) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1000, 0, 0}});
  EXPECT_EQ(PathSimilarity(graph, graph), 1);
}

TEST(PathSimilarity, NothingThere) {
  const SkeletonGraph y = YShape(0.05);
  EXPECT_EQ(PathSimilarity({}, y), std::nullopt);
  EXPECT_EQ(PathSimilarity(y, {}), 0.0);
  EXPECT_EQ(ComparePaths({}, {}).Apls(), std::nullopt);
  EXPECT_EQ(ComparePaths({}, y).Apls(), 0.0);
}

}  // namespace
}  // namespace curvefusion
