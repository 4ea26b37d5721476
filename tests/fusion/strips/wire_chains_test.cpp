#include "fusion/strips/wire_chains.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

// A wire along x with rungs to +y at two of its points; the edges of the wire are 0, 1, 2.
SkeletonGraph Comb() {
  SkeletonGraph skeleton;
  std::vector<NodeId> nodes;
  for (int i = 0; i < 4; ++i) nodes.push_back(skeleton.AddNode({0.02 * i, 0.001 * (i % 2), 0}));
  for (int i = 0; i < 3; ++i) {
    skeleton.AddEdge({{nodes[i], nodes[i + 1]},
                      {skeleton.position(nodes[i]), skeleton.position(nodes[i + 1])},
                      {},
                      {}});
  }
  for (const int i : {1, 2}) {
    const Vec3 foot = skeleton.position(nodes[i]);
    const NodeId tip = skeleton.AddNode(foot + Vec3(0, 0.03, 0));
    skeleton.AddEdge({{nodes[i], tip}, {foot, skeleton.position(tip)}, {}, {}});
  }
  return skeleton;
}

TEST(WiresOfEdgesTest, AWireGoesOnThroughItsJunctions) {
  const auto wires = WiresOfEdges(Comb());
  ASSERT_EQ(wires.size(), 5u);
  EXPECT_EQ(wires.at(0), wires.at(1));
  EXPECT_EQ(wires.at(1), wires.at(2));
  EXPECT_NE(wires.at(3), wires.at(0));
  EXPECT_NE(wires.at(4), wires.at(3));
}

TEST(WiresOfEdgesTest, ACornerEndsAWire) {
  SkeletonGraph skeleton = Comb();
  const NodeId end = skeleton.Nodes()[0];
  const NodeId down = skeleton.AddNode({0, 0, -0.05});
  const EdgeId edge =
      skeleton.AddEdge({{end, down}, {skeleton.position(end), skeleton.position(down)}, {}, {}});
  EXPECT_NE(WiresOfEdges(skeleton).at(edge), WiresOfEdges(skeleton).at(0));
}

// Contraction draws a corner of two wires as one bent edge where nothing else ends there.
TEST(WiresOfEdgesTest, AnEdgeRoundACornerGoesOnNowhere) {
  for (const auto& [radius, is_one] : {std::pair{0.006, false}, std::pair{0.025, true}}) {
    const Polyline bend = RightAngle(radius);
    SkeletonGraph skeleton;
    const NodeId front = skeleton.AddNode(bend.front());
    const NodeId before = skeleton.AddNode(bend.front() - Vec3(0.04, 0, 0));
    const EdgeId straight =
        skeleton.AddEdge({{before, front}, {skeleton.position(before), bend.front()}, {}, {}});
    const EdgeId bent = skeleton.AddEdge({{front, skeleton.AddNode(bend.back())}, bend, {}, {}});
    const auto wires = WiresOfEdges(skeleton);
    EXPECT_EQ(wires.at(straight) == wires.at(bent), is_one) << radius;
  }
}

// Where three ends could go on into one another, the straightest two do.
TEST(WiresOfEdgesTest, AnEndGoesOnIntoOneOtherOnly) {
  SkeletonGraph skeleton;
  const NodeId middle = skeleton.AddNode({0, 0, 0});
  std::vector<EdgeId> edges;
  for (const Vec3& tip : {Vec3(-0.05, 0, 0), Vec3(0.05, 0.001, 0), Vec3(0.05, 0.015, 0)}) {
    const NodeId node = skeleton.AddNode(tip);
    edges.push_back(skeleton.AddEdge({{middle, node}, {Vec3(0, 0, 0), tip}, {}, {}}));
  }
  const auto wires = WiresOfEdges(skeleton);
  EXPECT_EQ(wires.at(edges[0]), wires.at(edges[1]));
  EXPECT_NE(wires.at(edges[0]), wires.at(edges[2]));
}

TEST(WiresOfEdgesTest, ARingIsOneWire) {
  SkeletonGraph skeleton;
  Polyline ring;
  for (int i = 0; i < 36; ++i) {
    ring.emplace_back(0.05 * std::cos(i * M_PI / 18), 0.05 * std::sin(i * M_PI / 18), 0);
  }
  ring.push_back(ring.front());
  skeleton.AddPolyline(ring);
  EXPECT_EQ(WiresOfEdges(skeleton).size(), 1u);
  EXPECT_TRUE(WiresOfEdges({}).empty());
}

}  // namespace
}  // namespace curvefusion
