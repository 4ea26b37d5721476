#include "experiments/metrics/truth_alignment.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "experiments/metrics/curve_metrics.h"
#include "experiments/metrics/explained_share.h"
#include "experiments/simulation/object_truth.h"
#include "kernel/angle.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

SkeletonGraph Object(const std::string& name) { return TruthSkeleton(MakeObject(name)); }

AlignmentPoints PointsOf(const SkeletonGraph& graph) {
  const SkeletonSamples samples = SampleSkeleton(graph);
  return {samples.positions, samples.tangents};
}

RigidTransform Align(const SkeletonGraph& result, const SkeletonGraph& truth) {
  return AlignToTruth(PointsOf(result), PointsOf(truth));
}

RigidTransform Motion(const Vec3& translation, double angle) {
  RigidTransform motion = RigidTransform::Identity();
  motion.rotate(Eigen::AngleAxisd(angle, Vec3(1, -2, 3).normalized()));
  motion.pretranslate(translation);
  return motion;
}

// How far at most the object is from its place after drift and alignment.
double WorstOffset(const SkeletonGraph& truth, const RigidTransform& T) {
  double worst = 0;
  for (const Vec3& p : SampleSkeleton(truth).positions) {
    worst = std::max(worst, (T * p - p).norm());
  }
  return worst;
}

double Explained(const SkeletonGraph& result, const SkeletonGraph& truth) {
  const std::vector<Vec3> positions = SampleSkeleton(result).positions;
  if (positions.empty()) return 0;
  return ExplainingPoints(positions).ShareOf(SampleSkeleton(truth).positions,
                                             RigidTransform::Identity(), kCurveReach);
}

Eigen::AlignedBox3d BoundsOfSamples(const SkeletonGraph& graph) {
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : SampleSkeleton(graph).positions) bounds.extend(p);
  return bounds;
}

Vec3 RandomPoint(const Eigen::AlignedBox3d& box, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const Vec3 shares(uniform(random), uniform(random), uniform(random));
  return box.min() + shares.cwiseProduct(box.max() - box.min());
}

// Straight pieces between random points about the object, `length` metres of them.
void AddRandomCurves(SkeletonGraph& graph, const Eigen::AlignedBox3d& box, double length,
                     uint64_t seed) {
  std::mt19937_64 random(seed);
  for (double added = 0; added < length;) {
    const Polyline curve = {RandomPoint(box, random), RandomPoint(box, random),
                            RandomPoint(box, random)};
    added += Length(curve);
    graph.AddPolyline(curve);
  }
}

// Parallel lines 10 mm apart in the plane of the box's bottom, `length` metres of them.
void AddPlaneOfCurves(SkeletonGraph& graph, const Eigen::AlignedBox3d& box, double length) {
  const double width = box.sizes().x();
  for (int i = 0; i * width < length; ++i) {
    const Vec3 start = box.min() + Vec3(0, 0.01 * i, 0);
    graph.AddPolyline(StraightLine(start, start + Vec3(width, 0, 0)));
  }
}

// Every second edge.
SkeletonGraph HalfOf(SkeletonGraph graph) {
  for (const EdgeId edge : graph.Edges()) {
    if (edge % 2 == 0) graph.RemoveEdge(edge);
  }
  graph.RemoveIsolatedNodes();
  return graph;
}

// Straight wires of 0.3 m along the edges of a cube.
SkeletonGraph Cube() {
  SkeletonGraph cube;
  for (int corner = 0; corner < 8; ++corner) {
    cube.AddNode(0.3 * Vec3(corner & 1, (corner >> 1) & 1, corner >> 2));
  }
  for (int corner = 0; corner < 8; ++corner) {
    for (const int axis : {1, 2, 4}) {
      if ((corner & axis) != 0) continue;
      Connect(cube, corner, corner | axis,
              StraightLine(cube.position(corner), cube.position(corner | axis)));
    }
  }
  return cube;
}

// Curves through points every 10 mm that are off by a normal error in each axis.
SkeletonGraph WithNoise(SkeletonGraph graph, double sigma, uint64_t seed) {
  constexpr double kSpacing = 0.01;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, sigma);
  for (const EdgeId id : graph.Edges()) {
    Polyline points = Resample(graph.edge(id).points, kSpacing);
    for (size_t i = 1; i + 1 < points.size(); ++i) {
      points[i] += Vec3(normal(random), normal(random), normal(random));
    }
    graph.SetCurve(id, points);
  }
  return graph;
}

TEST(AlignToTruth, AnExactResultStaysToTheBit) {
  for (const char* name : {"cat", "cubeframe", "rack"}) {
    const SkeletonGraph truth = Object(name);
    EXPECT_TRUE(Align(truth, truth).isApprox(RigidTransform::Identity(), 0)) << name;
  }
}

TEST(AlignToTruth, UndoesDriftToAFractionOfAMillimetre) {
  for (const char* name : {"cat", "deco", "wine"}) {
    const SkeletonGraph truth = Object(name);
    const RigidTransform drift = Motion({0.004, -0.003, 0.005}, 1 * kDegree);
    const RigidTransform T = Align(Transformed(truth, drift), truth);
    // Samples 1 mm apart, compared across the curves.
    EXPECT_LT(WorstOffset(truth, T * drift), 0.0001) << name;
  }
}

TEST(AlignToTruth, FalseCurvesOfNineTenthsDoNotMoveIt) {
  const SkeletonGraph truth = Object("cat");
  const double false_length = 9 * truth.TotalLength();
  const Eigen::AlignedBox3d bounds = BoundsOfSamples(truth);
  for (const uint64_t seed : {1, 2, 3}) {
    const RigidTransform drift = Motion({0.005, 0.006, -0.004}, 1 * kDegree);
    SkeletonGraph result = truth;
    AddRandomCurves(result, bounds, false_length, seed);
    const RigidTransform T = Align(Transformed(result, drift), truth);
    // False curves within 2.5 mm of true ones pull at them.
    EXPECT_LT(WorstOffset(truth, T * drift), 0.0005) << seed;
  }
}

TEST(AlignToTruth, AParallelPlaneOfFalseCurvesDoesNotMoveIt) {
  const SkeletonGraph truth = Object("cat");
  const Eigen::AlignedBox3d bounds = BoundsOfSamples(truth);
  for (const double below : {0.005, 0.015, 0.05}) {
    const Vec3 margin(0.05, 0.05, below);
    SkeletonGraph result = truth;
    AddPlaneOfCurves(result, {bounds.min() - margin, bounds.max() + margin},
                     9 * truth.TotalLength());
    EXPECT_LT(WorstOffset(truth, Align(result, truth)), 0.0005) << below;
    const RigidTransform drift = Motion({0.005, 0.006, -0.004}, 1 * kDegree);
    const RigidTransform T = Align(Transformed(result, drift), truth);
    EXPECT_LT(WorstOffset(truth, T * drift), 0.0005) << below;
  }
}

TEST(AlignToTruth, MissingHalvesDoNotMoveIt) {
  for (const char* name : {"cat", "cage", "deco"}) {
    const SkeletonGraph truth = Object(name);
    const SkeletonGraph half = HalfOf(truth);
    EXPECT_LT(WorstOffset(truth, Align(half, truth)), 0.0001) << name;
    const RigidTransform drift = Motion({0.004, -0.003, 0.005}, 1 * kDegree);
    const RigidTransform T = Align(Transformed(half, drift), truth);
    EXPECT_LT(WorstOffset(truth, T * drift), 0.0005) << name;
  }
}

TEST(AlignToTruth, HalfMissingAndTheRestNineTenthsFalse) {
  const SkeletonGraph truth = Object("cat");
  SkeletonGraph result = HalfOf(truth);
  AddRandomCurves(result, BoundsOfSamples(truth), 9 * result.TotalLength(), 5);
  const RigidTransform drift = Motion({0.003, -0.002, 0.003}, 0.5 * kDegree);
  const RigidTransform T = Align(Transformed(result, drift), truth);
  EXPECT_LT(WorstOffset(truth, T * drift), 0.001);
}

TEST(AlignToTruth, FindsDriftBeyondTheFirstGate) {
  for (const char* name : {"cat", "cage", "wine"}) {
    const SkeletonGraph truth = Object(name);
    SkeletonGraph result = truth;
    AddRandomCurves(result, BoundsOfSamples(truth), truth.TotalLength(), 7);
    const RigidTransform drift = Motion({0.018, -0.015, 0.014}, 2 * kDegree);
    const RigidTransform T = Align(Transformed(result, drift), truth);
    EXPECT_LT(WorstOffset(truth, T * drift), 0.0005) << name;
  }
}

// Turned by 90 degrees, the noisy cube may explain a little more than as it stands.
TEST(AlignToTruth, ACubeIsNotTurned) {
  const SkeletonGraph cube = Cube();
  EXPECT_TRUE(Align(cube, cube).isApprox(RigidTransform::Identity(), 0));
  for (const uint64_t seed : {1, 2, 3, 4}) {
    SkeletonGraph result = WithNoise(cube, 0.001, seed);
    result.RemoveEdge(static_cast<EdgeId>(seed));
    // 360 points with an error of 1 mm give a mean to 0.05 mm, the corners to thrice that.
    EXPECT_LT(WorstOffset(cube, Align(result, cube)), 0.0005) << seed;
    const RigidTransform drift = Motion({0.004, -0.003, 0.005}, 1 * kDegree);
    EXPECT_LT(WorstOffset(cube, Align(Transformed(result, drift), cube) * drift), 0.0005) << seed;
  }
}

// Wires of a rack: a shift by one spacing explains all but one of them.
TEST(AlignToTruth, ALatticeIsNotShiftedByACell) {
  const SkeletonGraph lattice = Lattice(8, 8, 0.02);
  SkeletonGraph result = WithNoise(lattice, 0.0005, 3);
  for (const EdgeId edge : result.Edges()) {
    if (edge % 3 == 0) result.RemoveEdge(edge);
  }
  EXPECT_LT(WorstOffset(lattice, Align(result, lattice)), 0.0005);
}

TEST(AlignToTruth, AStraightWireIsNotSlidAlongItself) {
  SkeletonGraph truth;
  truth.AddPolyline(StraightLine({0, 0, 0}, {0.2, 0, 0}));
  SkeletonGraph result;
  result.AddPolyline(StraightLine({0.03, 0.002, 0}, {0.1, 0.002, 0}));
  const RigidTransform T = Align(result, truth);
  EXPECT_LT((T * Vec3(0.06, 0.002, 0) - Vec3(0.06, 0, 0)).norm(), 0.0001);
}

// Whatever the result: parts of the truth, false curves, any motion.
TEST(AlignToTruth, ExplainsNoLessThanRaw) {
  const SkeletonGraph truth = Object("cat");
  const Eigen::AlignedBox3d bounds = BoundsOfSamples(truth);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 8; ++trial) {
    SkeletonGraph result = trial % 3 == 0 ? HalfOf(truth) : WithNoise(truth, 0.004, trial);
    if (trial % 4 == 0) result = {};
    AddRandomCurves(result, bounds, (trial % 5) * truth.TotalLength(), trial);
    const Vec3 shift = 0.04 * Vec3(uniform(random), uniform(random), uniform(random));
    result = Transformed(result, Motion(shift, uniform(random) * 5 * kDegree));
    const SkeletonGraph aligned = Transformed(result, Align(result, truth));
    EXPECT_GE(Explained(aligned, truth), Explained(result, truth) - 1e-9) << trial;  // rounding
  }
}

// A surface has no tangents: points are compared with points.
TEST(AlignToTruth, WithoutTangents) {
  const SkeletonGraph truth = Object("cat");
  const RigidTransform drift = Motion({0.002, -0.001, 0.0015}, 0.5 * kDegree);
  const SkeletonGraph moved = Transformed(truth, drift);
  const RigidTransform T =
      AlignToTruth({SampleSkeleton(moved).positions, {}}, {SampleSkeleton(truth).positions, {}});
  // Points pair with samples 1 mm apart, so along the curves it may rest half a step away.
  EXPECT_LT(WorstOffset(truth, T * drift), 0.0005);
}

TEST(AlignToTruth, LeavesFewPointsAlone) {
  const std::vector<Vec3> points(10, Vec3(0.001, 0, 0));
  EXPECT_TRUE(AlignToTruth({points, {}}, {points, {}}).isApprox(RigidTransform::Identity(), 0));
  EXPECT_TRUE(AlignToTruth({std::vector<Vec3>(20, Vec3::Zero()), {}}, {})
                  .isApprox(RigidTransform::Identity(), 0));
  EXPECT_TRUE(Align({}, Object("cat")).isApprox(RigidTransform::Identity(), 0));
}

TEST(ExplainingPoints, MeanOfRecallOverAllThresholds) {
  const std::vector<Vec3> result = {{0, 0, 0}, {1, 0, 0}};
  const std::vector<Vec3> truth = {{0, 0.004, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, -0.01}};
  const double share = ExplainingPoints(result).ShareOf(truth, RigidTransform::Identity(), 0.010);
  EXPECT_NEAR(share, (0.6 + 1) / 4, 1e-12);  // rounding
}

}  // namespace
}  // namespace curvefusion
