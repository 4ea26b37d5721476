#include "graph/segment_pairs.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/graph/contact_oracle.h"

namespace curvefusion {
namespace {

constexpr double kThreshold = 3 * kMillimetre;

Polyline RandomWalk(std::mt19937& random) {
  std::uniform_real_distribution<double> place(-0.05, 0.05);
  std::normal_distribution<double> step(0, 0.005);
  Polyline points = {{place(random), place(random), place(random)}};
  for (int i = 0; i < 4; ++i)
    points.push_back(points.back() + Vec3(step(random), step(random), step(random)));
  return points;
}

// Moves, removes, splits or adds an edge.
void ChangeOne(SkeletonGraph& graph, std::mt19937& random) {
  const std::vector<EdgeId> edges = graph.Edges();
  const EdgeId id = edges[random() % edges.size()];
  switch (random() % 4) {
    case 0:
      graph.MoveNode(graph.edge(id).nodes[0], RandomWalk(random)[0]);
      break;
    case 1:
      graph.RemoveEdge(id);
      break;
    case 2:
      if (graph.edge(id).points.size() > 2) graph.SplitEdge(id, 1);
      break;
    default:
      graph.AddPolyline(RandomWalk(random));
  }
}

// Few changes from call to call extend what was searched, many start it anew.
TEST(SegmentPairSearch, FindsAfterEveryChangeWhatAWholeSearchFinds) {
  std::mt19937 random(5);
  SkeletonGraph graph;
  for (int i = 0; i < 200; ++i) graph.AddPolyline(RandomWalk(random));
  SegmentPairSearch search(kThreshold);
  size_t found = 0;
  for (int round = 0; round < 60; ++round) {
    search.Update(graph);
    const SegmentTable table(graph);
    const std::vector<SegmentPair> pairs = SegmentPairsInContact(table, kThreshold);
    ASSERT_EQ(Named(search.table(), search.pairs()), Named(table, pairs)) << round;
    EXPECT_EQ(search.largest_coordinate(), LargestCoordinate(graph));
    EXPECT_EQ(graph.point_count(), table.points.size());
    found += pairs.size();
    const int changes = round % 20 == 19 ? 100 : static_cast<int>(random() % 5);
    for (int i = 0; i < changes; ++i) ChangeOne(graph, random);
  }
  EXPECT_GT(found, 1000u);  // about 100 a round
}

TEST(SegmentPairSearch, OfNothingFindsNothing) {
  SkeletonGraph graph;
  SegmentPairSearch search(kThreshold);
  search.Update(graph);
  EXPECT_TRUE(search.pairs().empty());
  const EdgeId id = graph.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  graph.AddPolyline({{0, 0.001, 0}, {1, 0.001, 0}});
  search.Update(graph);
  EXPECT_EQ(search.pairs().size(), 1u);
  graph.RemoveEdge(id);
  search.Update(graph);
  EXPECT_TRUE(search.pairs().empty());
}

}  // namespace
}  // namespace curvefusion
