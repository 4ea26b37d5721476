#include "graph/boost_graph.h"

#include <gtest/gtest.h>

#include <boost/graph/connected_components.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/graph/graph_concepts.hpp>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

BOOST_CONCEPT_ASSERT((boost::VertexListGraphConcept<BoostView>));
BOOST_CONCEPT_ASSERT((boost::EdgeListGraphConcept<BoostView>));
BOOST_CONCEPT_ASSERT((boost::IncidenceGraphConcept<BoostView>));

int ComponentsByBoost(const SkeletonGraph& graph) {
  const BoostView view(graph);
  std::vector<int> components(num_vertices(view));
  return boost::connected_components(
      view, boost::make_iterator_property_map(components.begin(), get(boost::vertex_index, view)));
}

TEST(BoostView, CountsComponentsAndCycles) {
  SkeletonGraph graph = Lattice(3, 4, 0.05);
  graph.AddPolyline(Ring(0.02, 20, {1, 0, 0}));
  graph.RemoveEdge(0);  // leaves a gap in the handles
  EXPECT_EQ(ComponentsByBoost(graph), 2);
  EXPECT_EQ(ComponentsByBoost(graph), graph.ComponentCount());
  const BoostView view(graph);
  EXPECT_EQ(num_edges(view) - num_vertices(view) + 2, graph.CycleRank());
}

TEST(BoostView, AnEmptyGraphIsAGraph) { EXPECT_EQ(ComponentsByBoost(SkeletonGraph()), 0); }

TEST(BoostView, ShortestPathsAreMeasuredAlongTheCurves) {
  const SkeletonGraph graph = Lattice(3, 4, 0.05);
  const BoostView view(graph);
  std::vector<double> distances(num_vertices(view));
  boost::dijkstra_shortest_paths(view, 0,
                                 boost::weight_map(get(boost::edge_weight, view))
                                     .vertex_index_map(get(boost::vertex_index, view))
                                     .distance_map(boost::make_iterator_property_map(
                                         distances.begin(), get(boost::vertex_index, view))));
  EXPECT_NEAR(distances[11], (3 + 2) * 0.05, 1e-12);  // rounding only
}

TEST(BoostView, ASelfLoopLeavesItsNodeTwice) {
  SkeletonGraph graph;
  graph.AddPolyline(Ring(0.02, 20));
  const BoostView view(graph);
  EXPECT_EQ(out_degree(0, view), 2);
  const auto [first, last] = out_edges(0, view);
  ASSERT_EQ(last - first, 2);
  for (auto edge = first; edge != last; ++edge) EXPECT_EQ(target(*edge, view), 0);
}

}  // namespace
}  // namespace curvefusion
