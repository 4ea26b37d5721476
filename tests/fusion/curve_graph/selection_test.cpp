#include "fusion/curve_graph/selection.h"

#include <gtest/gtest.h>

#include "kernel/polyline.h"

namespace curvefusion {
namespace {

constexpr double kStep = 0.04;

// An edge along x of as many stretches as log-odds, and what is known of them.
struct Edge {
  SkeletonGraph skeleton;
  std::vector<StretchEvidence> evidence;
  std::vector<WireProof> proofs;
  UncertainCurves uncertain;

  explicit Edge(const std::vector<double>& log_odds, Doubt doubt = Doubt::kSurface) {
    Polyline points = {Vec3::Zero()};
    for (size_t i = 0; i < log_odds.size(); ++i) {
      points.emplace_back(kStep * static_cast<double>(i + 1), 0, 0);
    }
    const EdgeId id = skeleton.AddPolyline(points);
    for (size_t i = 0; i < log_odds.size(); ++i) {
      StretchEvidence stretch;
      stretch.edge = id;
      stretch.part = {i, i + 1};
      stretch.length = kStep;
      stretch.strips = 3;
      evidence.push_back(stretch);
      proofs.push_back({log_odds[i], doubt, log_odds[i], 0});
    }
  }
  double Keep(const ProofLimits& limits = {.usual = 0.5}) {
    return KeepProven(evidence, proofs, limits, skeleton, uncertain);
  }
};

TEST(KeepProven, CutsOffAnEndThatIsNoWire) {
  Edge edge({3, 3, 3, 3, -3, -3});
  const double wire = edge.Keep();
  EXPECT_NEAR(wire, 4 * kStep * Probability(3), 1e-12);
  EXPECT_NEAR(edge.skeleton.TotalLength(), 4 * kStep, 1e-12);
  EXPECT_NEAR(edge.uncertain.graph.TotalLength(), 2 * kStep, 1e-12);
  EXPECT_NEAR(edge.uncertain.lengths.surface, 2 * kStep, 1e-12);
  EXPECT_EQ(edge.skeleton.edge_count(), 1);
  EXPECT_EQ(edge.skeleton.node_count(), 2);
}

TEST(KeepProven, AShortDoubtInsideAWireStays) {
  Edge edge({3, 3, -1.5, 3, 3});
  edge.Keep();
  EXPECT_NEAR(edge.skeleton.TotalLength(), 5 * kStep, 1e-12);
  EXPECT_TRUE(edge.uncertain.graph.empty());
}

TEST(KeepProven, ALongDoubtInsideAWireIsCutOut) {
  Edge edge({3, 3, -3, -3, -3, 3, 3});
  edge.Keep();
  EXPECT_EQ(edge.skeleton.edge_count(), 2);
  EXPECT_NEAR(edge.skeleton.TotalLength(), 4 * kStep, 1e-12);
  EXPECT_NEAR(edge.uncertain.graph.TotalLength(), 3 * kStep, 1e-12);
}

TEST(KeepProven, AShortPieceOfItsOwnIsNoProof) {
  Edge edge({0.5});
  edge.Keep();
  EXPECT_TRUE(edge.skeleton.empty());
  EXPECT_EQ(edge.skeleton.node_count(), 0);
  EXPECT_NEAR(edge.uncertain.graph.TotalLength(), kStep, 1e-12);
}

// Fingers and rims are seen by depth as wires are, in no image.
TEST(KeepProven, WithoutAnyStripMoreIsNeeded) {
  Edge finger({3, 3, 3, 3, 3}), cage(std::vector<double>(20, 1.5)), wire({3, 3, 3, 3, 3});
  for (Edge* edge : {&finger, &cage})
    for (StretchEvidence& stretch : edge->evidence) stretch.strips = 0;
  finger.Keep();
  cage.Keep();
  wire.Keep();
  EXPECT_TRUE(finger.skeleton.empty());
  EXPECT_NEAR(finger.uncertain.graph.TotalLength(), 5 * kStep, 1e-12);
  EXPECT_NEAR(cage.skeleton.TotalLength(), 20 * kStep, 1e-12);
  EXPECT_NEAR(wire.skeleton.TotalLength(), 5 * kStep, 1e-12);
}

TEST(KeepProven, RemembersWhatLeavesAPartThatStays) {
  Edge edge({3, 3, 3, -3, -3});
  for (size_t i = 0; i < edge.proofs.size(); ++i) {
    edge.proofs[i].own_log_odds = -static_cast<double>(i);
    edge.evidence[i].middle = {kStep * (static_cast<double>(i) + 0.5), 0, 0};
  }
  edge.Keep();
  ASSERT_EQ(edge.uncertain.beside_kept.size(), 2);
  EXPECT_EQ(edge.uncertain.beside_kept[0].own_log_odds, -3);
  EXPECT_EQ(edge.uncertain.beside_kept[1].middle, Vec3(4.5 * kStep, 0, 0));
  EXPECT_EQ(edge.uncertain.beside_kept[1].length, kStep);
  Edge all({-3, -3});
  all.Keep();
  EXPECT_TRUE(all.uncertain.beside_kept.empty());
}

TEST(KeepProven, CountsByWhatSpeaksAgainstIt) {
  Edge thick({-3}, Doubt::kThick), past({-3}, Doubt::kLookedPast), unknown({-3}, Doubt::kUnproven);
  thick.Keep();
  past.Keep();
  unknown.Keep();
  EXPECT_NEAR(thick.uncertain.lengths.thick, kStep, 1e-12);
  EXPECT_NEAR(past.uncertain.lengths.looked_past, kStep, 1e-12);
  EXPECT_NEAR(unknown.uncertain.lengths.unproven, kStep, 1e-12);
  EXPECT_NEAR(unknown.uncertain.lengths.Sum(), kStep, 1e-12);
}

// Probabilities of .3 and .6, then none at all.
Edge Doubtful(int doubtful, int likelier) {
  std::vector<double> log_odds(doubtful, -0.85);
  log_odds.insert(log_odds.end(), likelier, 0.4);
  log_odds.insert(log_odds.end(), 2, -5);
  return Edge(log_odds);
}

TEST(KeepProven, WantsMoreOfAPartThatIsHardlyWire) {
  Edge lenient = Doubtful(60, 60), strict = lenient;
  lenient.Keep({.usual = 0.2});
  EXPECT_NEAR(lenient.skeleton.TotalLength(), 120 * kStep, 1e-9);
  strict.Keep({.usual = 0.2, .doubtful = 0.5});
  EXPECT_NEAR(strict.skeleton.TotalLength(), 60 * kStep, 1e-9);
  EXPECT_NEAR(strict.uncertain.graph.TotalLength(), 62 * kStep, 1e-9);
  for (const NodeId node : strict.skeleton.Nodes()) {
    EXPECT_GE(strict.skeleton.position(node).x(), 60 * kStep - 1e-9);
    EXPECT_LE(strict.skeleton.position(node).x(), 120 * kStep + 1e-9);
  }
}

TEST(KeepProven, WantsMuchOfWhatIsLeftOfSuchAPart) {
  Edge edge = Doubtful(20, 20);  // what is left would be worth 8
  edge.Keep({.usual = 0.2, .doubtful = 0.5});
  EXPECT_TRUE(edge.skeleton.empty());
}

TEST(KeepProven, KeepsTheUsualLimitWhereMuchIsLikely) {
  std::vector<double> log_odds(30, -0.85);
  log_odds.insert(log_odds.end(), 8, 1.5);  // .32 m
  Edge edge(log_odds);
  edge.Keep({.usual = 0.2, .doubtful = 0.5});
  EXPECT_NEAR(edge.skeleton.TotalLength(), 38 * kStep, 1e-12);
}

TEST(KeepProven, ZeroKeepsAll) {
  Edge edge({-3, -3});
  EXPECT_NEAR(edge.Keep({}), 2 * kStep * Probability(-3), 1e-12);
  EXPECT_NEAR(edge.skeleton.TotalLength(), 2 * kStep, 1e-12);
}

TEST(KeepProven, OfNothingIsNothing) {
  SkeletonGraph skeleton;
  UncertainCurves uncertain;
  EXPECT_EQ(KeepProven({}, {}, {.usual = 0.5}, skeleton, uncertain), 0);
}

}  // namespace
}  // namespace curvefusion
