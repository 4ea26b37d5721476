#include "fusion/paper/skeleton_fusion.h"

#include <gtest/gtest.h>

#include <random>

#include "graph/io/graph_io.h"
#include "graph/validate.h"
#include "kernel/parallel.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

SkeletonGraph Fuse(const SkeletonGraph& partial, const SkeletonGraph& bundle, int so_far) {
  const SkeletonFusionOptions options;
  const SkeletonGraph fused = FuseSkeletons(partial, bundle, so_far, options);
  EXPECT_EQ(Violations(fused, options.intersection_distance), std::vector<std::string>());
  for (const EdgeId id : fused.Edges())
    EXPECT_GE(Length(fused.edge(id).points), options.min_edge_length);
  return fused;
}

SkeletonFusionOptions Unaligned() {
  SkeletonFusionOptions options;
  options.alignment.max_iterations = 0;
  return options;
}

RigidTransform Drift(unsigned seed, double metres, double radians) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  RigidTransform T = RigidTransform::Identity();
  T.translate(metres * Vec3(normal(random), normal(random), normal(random)));
  T.rotate(Eigen::AngleAxisd(radians * normal(random),
                             Vec3(normal(random), normal(random), normal(random)).normalized()));
  return T;
}

TEST(FuseSkeletons, EmptyInputsAreFine) {
  EXPECT_TRUE(Fuse({}, {}, 1).empty());
  const SkeletonGraph y = YShape(0.1);
  EXPECT_EQ(Fuse(y, {}, 1).edge_count(), 3);
  EXPECT_EQ(Fuse({}, y, 1).edge_count(), 3);
}

TEST(FuseSkeletons, TwoHalvesOfAHelixBecomeOne) {
  const SkeletonGraph whole = OfCurve(Helix(0.06, 0.05, 2));
  const SkeletonGraph fused =
      Fuse(OfCurve(Helix(0.06, 0.05, 2, 0, 0.6)), OfCurve(Helix(0.06, 0.05, 2, 0.4, 1)), 1);
  ASSERT_EQ(fused.edge_count(), 1);
  EXPECT_EQ(fused.node_count(), 2);
  // Pairs of points pull the halves onto each other: points up to 10 mm beyond the end of the other
  // half pair with its end. The curve slides along itself by three times that at most.
  EXPECT_NEAR(fused.TotalLength(), whole.TotalLength(), 0.03);
  EXPECT_LT(MaxDistance(fused, whole), 0.001);
}

TEST(FuseSkeletons, AShiftedYIsStillOneY) {
  const SkeletonGraph y = YShape(0.1);
  const SkeletonFusionOptions options = Unaligned();
  RigidTransform shift = RigidTransform::Identity();
  shift.translate(Vec3(0.003, 0.002, 0.004));
  const SkeletonGraph fused = FuseSkeletons(y, Transformed(y, shift), 1, options);
  EXPECT_EQ(Violations(fused, options.intersection_distance), std::vector<std::string>());
  EXPECT_EQ(fused.edge_count(), 3);
  ASSERT_EQ(CountDegree(fused, 3), 1);
  for (const NodeId node : fused.Nodes()) {
    if (fused.Degree(node) == 3) {
      // The mean of both junctions, moved by smoothing by less than a vertex's distance.
      EXPECT_LT((fused.position(node) - 0.5 * shift.translation()).norm(), 0.001);
    }
  }
}

TEST(FuseSkeletons, ACrossingOfTwoBundlesIsOneJunctionOfValenceFour) {
  // Alignment would turn one line onto the other.
  for (const double degrees : {90.0, 60.0, 45.0}) {
    const double angle = degrees * M_PI / 180;
    const Vec3 along = 0.1 * Vec3(std::cos(angle), std::sin(angle), 0);
    const SkeletonGraph fused = FuseSkeletons(OfCurve(StraightLine({-0.1, 0, 0}, {0.1, 0, 0})),
                                              OfCurve(StraightLine(-along, along)), 1, Unaligned());
    EXPECT_EQ(fused.edge_count(), 4) << degrees;
    EXPECT_EQ(CountDegree(fused, 4), 1) << degrees;
  }
}

TEST(FuseSkeletons, ANewBranchSplitsTheCurveItStartsFrom) {
  SkeletonGraph t = OfCurve(StraightLine({-0.05, 0.001, 0}, {0.05, 0.001, 0}));
  const NodeId junction = t.SplitEdge(0, 50);
  const NodeId tip = t.AddNode({0, 0.08, 0});
  Connect(t, junction, tip, StraightLine(t.position(junction), {0, 0.08, 0}));
  const SkeletonGraph fused = Fuse(OfCurve(StraightLine({-0.1, 0, 0}, {0.1, 0, 0})), t, 1);
  EXPECT_EQ(fused.edge_count(), 3);
  EXPECT_EQ(CountDegree(fused, 3), 1);
  EXPECT_NEAR(fused.TotalLength(), 0.28, 0.0015);  // the bundle is 1 mm aside
}

TEST(FuseSkeletons, ABridgeClosesAGap) {
  SkeletonGraph gap = OfCurve(StraightLine({0, 0, 0}, {0.05, 0, 0}));
  gap.AddPolyline(StraightLine({0.058, 0, 0}, {0.12, 0, 0}));
  const SkeletonGraph fused =
      Fuse(gap, OfCurve(StraightLine({0.02, 0.001, 0}, {0.1, 0.001, 0})), 1);
  EXPECT_EQ(fused.edge_count(), 1);
  EXPECT_NEAR(fused.TotalLength(), 0.12, 0.001);
}

TEST(FuseSkeletons, IdenticalGraphsDoNotGrow) {
  const SkeletonGraph lattice = Lattice(3, 4, 0.05);
  SkeletonGraph fused = Fuse({}, lattice, 0);
  for (int i = 1; i <= 15; ++i) fused = Fuse(fused, lattice, i);
  EXPECT_EQ(fused.edge_count(), lattice.edge_count() - 4);  // corners of valence 2 dissolve
  EXPECT_EQ(fused.CycleRank(), lattice.CycleRank());
  // Straight lines do not change. Smoothing rounds the four corners off a little more
  // each time: by 4 mm after 16 times.
  EXPECT_NEAR(fused.TotalLength(), lattice.TotalLength(), 0.016);
}

// The lattice seen in six windows of noisy, slightly displaced bundles.
TEST(FuseSkeletons, ALatticeSeenInSixBundlesIsTheLattice) {
  constexpr double kSpacing = 0.05;
  const SkeletonGraph truth = Lattice(4, 8, kSpacing);
  for (unsigned seed = 0; seed < 3; ++seed) {
    SkeletonGraph fused;
    for (int bundle = 0; bundle < 6; ++bundle) {
      RigidTransform T = RigidTransform::Identity();
      if (bundle > 0) T = Drift(100 * seed + bundle, 0.002, 0.004);
      T.translate(Vec3(kSpacing * (bundle % 6), 0, 0));
      const SkeletonGraph window =
          Perturbed(Lattice(4, 3, kSpacing), T, 0.0007, 10 * seed + bundle);
      fused = Fuse(fused, window, bundle);
    }
    EXPECT_EQ(fused.CycleRank(), truth.CycleRank()) << seed;
    EXPECT_EQ(fused.ComponentCount(), 1) << seed;
    EXPECT_EQ(fused.edge_count(), truth.edge_count() - 4) << seed;
    EXPECT_NEAR(fused.TotalLength(), truth.TotalLength(), 0.02 * truth.TotalLength()) << seed;
  }
}

// "With the weight i/(i+1) for K_i and 1/(i+1) for S_(i+1)."
TEST(FuseSkeletons, WeighsByTheNumberOfBundles) {
  const SkeletonGraph line = OfCurve(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  const SkeletonGraph next = OfCurve(StraightLine({0, 0.004, 0}, {0.1, 0.004, 0}));
  for (const int so_far : {1, 3}) {
    const SkeletonGraph fused = FuseSkeletons(line, next, so_far, Unaligned());
    ASSERT_EQ(fused.edge_count(), 1);
    const SkeletonEdge& result = fused.edge(fused.Edges()[0]);
    EXPECT_NEAR(result.points[result.points.size() / 2].y(), 0.004 / (so_far + 1), 1e-9);
  }
}

// "We further bring K_i closer to S_(i+1)": the world drifts along with the bundles.
TEST(FuseSkeletons, MovesThePartialSkeletonToTheBundle) {
  const SkeletonGraph lattice = Lattice(3, 3, 0.05);
  RigidTransform shift = RigidTransform::Identity();
  shift.translate(Vec3(0.002, 0.003, 0.004));
  const SkeletonGraph moved = Transformed(lattice, shift);
  const SkeletonGraph fused = Fuse(lattice, moved, 1);
  // Pairs of samples are 1 mm apart along the lines.
  EXPECT_LT(MaxDistance(moved, fused), 0.001 + 0.004);  // 4 mm: corners are rounded off
  EXPECT_NEAR(fused.position(fused.Nodes().front()).z(), 0.004, 1e-4);
}

TEST(FuseSkeletons, NearestPointsDoNotZigzag) {
  SkeletonFusionOptions options = Unaligned();
  options.lambda = 0;
  const SkeletonGraph line = OfCurve(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  const SkeletonGraph noisy = Perturbed(line, RigidTransform::Identity(), 0.0015, 3);
  const SkeletonGraph fused = FuseSkeletons(line, noisy, 1, options);
  ASSERT_EQ(fused.edge_count(), 1);
  const Polyline& points = fused.edge(fused.Edges()[0]).points;
  for (size_t i = 1; i < points.size(); ++i) EXPECT_GE(points[i].x(), points[i - 1].x());
}

TEST(FuseSkeletons, TheNumberOfThreadsDoesNotMatter) {
  const SkeletonGraph a = Perturbed(Lattice(3, 3, 0.05), Drift(1, 0.002, 0.01), 0.0005, 1);
  const SkeletonGraph b = Perturbed(Lattice(3, 3, 0.05), Drift(2, 0.002, 0.01), 0.0005, 2);
  const auto fuse = [&](int threads) {
    const ThreadLimit limit(threads);
    return SkeletonToJson(FuseSkeletons(a, b, 1, {}));
  };
  EXPECT_EQ(fuse(1), fuse(2));
}

// Hundreds of tiny fragments, random walks and blobs: no exception, valid after every bundle.
TEST(FuseSkeletons, MessyBundlesEndValid) {
  for (unsigned seed = 0; seed < 2; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto vector = [&](double size) -> Vec3 {
      return size * Vec3(unit(random), unit(random), unit(random));
    };
    SkeletonGraph fused;
    for (int bundle = 0; bundle < 3; ++bundle) {
      SkeletonGraph messy = Perturbed(Lattice(3, 3, 0.05), Drift(seed, 0.003, 0.01), 0.002, bundle);
      for (int fragment = 0; fragment < 100; ++fragment) {
        Polyline points = {vector(0.1)};
        for (int i = 0; i < 1 + fragment % 12; ++i) points.push_back(points.back() + vector(0.004));
        messy.AddPolyline(points);
      }
      SCOPED_TRACE(seed);
      fused = Fuse(fused, messy, bundle);
    }
  }
}

}  // namespace
}  // namespace curvefusion
