#include "graph/canonical_form.h"

#include <gtest/gtest.h>

#include "graph/io/graph_io.h"
#include "tests/graph/graph_fixtures.h"
#include "tests/graph/random_networks.h"

namespace curvefusion {
namespace {

TEST(CanonicalForm, DoesNotDependOnOrderAndDirection) {
  const SkeletonGraph graph = Perturbed(Lattice(3, 4, 0.05), RigidTransform::Identity(), 0.001, 1);
  const std::string canonical = SkeletonToJson(CanonicalForm(graph));
  for (uint64_t seed = 0; seed < 10; ++seed)
    EXPECT_EQ(SkeletonToJson(CanonicalForm(Shuffled(graph, seed))), canonical);
}

TEST(CanonicalForm, IsItsOwnCanonicalForm) {
  const SkeletonGraph canonical = CanonicalForm(Lattice(3, 4, 0.05));
  EXPECT_EQ(SkeletonToJson(CanonicalForm(canonical)), SkeletonToJson(canonical));
}

TEST(CanonicalForm, NodesAtOnePositionBecomeOneIsolatedOnesGo) {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0}, {1, 0, 0}});
  graph.AddPolyline({{2, 0, 0}, {1, -0.0, 0}});
  graph.AddNode({5, 5, 5});
  const SkeletonGraph canonical = CanonicalForm(graph);
  EXPECT_EQ(canonical.node_count(), 3);
  EXPECT_EQ(canonical.Degree(1), 2);
  EXPECT_TRUE(CanonicalForm(SkeletonGraph()).empty());
}

}  // namespace
}  // namespace curvefusion
