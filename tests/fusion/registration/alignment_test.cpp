#include "fusion/registration/alignment.h"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <utility>

#include "graph/sampled_curves.h"
#include "kernel/parallel.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

RigidTransform Motion(double angle, const Vec3& axis, const Vec3& translation) {
  RigidTransform T = RigidTransform::Identity();
  T.translate(translation);
  T.rotate(Eigen::AngleAxisd(angle, axis.normalized()));
  return T;
}

constexpr double kStep = 2 * kMillimetre;

CurveSamples SampleCurves(const SkeletonGraph& graph, double step) {
  SampledCurves sampled = SampleCurvesOf(graph, step);
  return {std::move(sampled.positions), std::move(sampled.tangents)};
}

AlignmentResult AlignToCurves(const std::vector<Vec3>& points, const SkeletonGraph& target,
                              const AlignmentOptions& options) {
  return AlignPoints(points, AlignmentTarget(SampleCurves(target, kStep)), options);
}

std::vector<Vec3> NoisySamples(const SkeletonGraph& graph, double step, double sigma) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, sigma);
  std::vector<Vec3> points = SampleCurves(graph, step).points;
  for (Vec3& p : points) p += Vec3(noise(random), noise(random), noise(random));
  return points;
}

TEST(AlignPoints, FindTheMotionOfALattice) {
  const SkeletonGraph target = Lattice(4, 5, 0.05);
  const RigidTransform truth = Motion(0.04, {1, 2, 3}, {0.006, -0.004, 0.008});
  const SkeletonGraph source = Transformed(target, truth.inverse());
  for (const bool point_to_line : {false, true}) {
    AlignmentOptions options;
    options.point_to_line = point_to_line;
    options.max_iterations = 200;  // pairs of points slide slowly along lines
    const AlignmentResult result =
        AlignToCurves(SampleCurves(source, kStep).points, target, options);
    EXPECT_TRUE(result.converged);
    EXPECT_GT(result.inlier_fraction, 0.95);
    // Noise-free; pairs of points stop where both samplings fit, up to the step of the samples, and
    // pairs across the corners of the lattice pull a little.
    EXPECT_LT(Difference(result.T_target_source, truth, source), point_to_line ? 2e-4 : 1e-3);
  }
}

TEST(AlignPoints, OfAPartFindTheirPlaceOnTheWhole) {
  const SkeletonGraph target = Lattice(4, 8, 0.05);
  const RigidTransform truth = Motion(0.02, {0, 1, 1}, {0.005, 0.003, -0.006});
  const SkeletonGraph source = Perturbed(Transformed(Lattice(4, 3, 0.05), truth.inverse()),
                                         RigidTransform::Identity(), 0.0005, 3);
  const AlignmentResult result = AlignToCurves(SampleCurves(source, kStep).points, target, {});
  EXPECT_TRUE(result.converged);
  EXPECT_LT(Difference(result.T_target_source, truth, source), 3e-4);
}

TEST(AlignPoints, NoisyOnesWithOutliersFindTheCurves) {
  const SkeletonGraph target = Lattice(3, 3, 0.08);
  const RigidTransform truth = Motion(0.03, {3, 1, 0}, {0.004, 0.007, 0.002});
  std::vector<Vec3> points = NoisySamples(Transformed(target, truth.inverse()), 0.001, 0.0015);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-0.05, 0.25);
  for (int i = 0; i < 300; ++i)
    points.emplace_back(anywhere(random), anywhere(random), anywhere(random));
  const AlignmentResult result = AlignToCurves(points, target, {});
  EXPECT_TRUE(result.converged);
  // About 2000 points of 1.5 mm noise: 0.04 mm per parameter; five sigma and some leverage.
  EXPECT_LT(Difference(result.T_target_source, truth, target), 5e-4);
  EXPECT_NEAR(result.rms, 0.0015 * std::sqrt(2.0), 0.0007);  // two directions across the line
}

TEST(AlignPoints, WhatIsNotDeterminedStays) {
  SkeletonGraph line;
  line.AddPolyline({{0, 0, 0}, {0.3, 0, 0}});
  const SkeletonGraph shifted = Transformed(line, Motion(0, Vec3::UnitX(), Vec3(0.02, 0.005, 0)));
  const AlignmentResult result = AlignToCurves(SampleCurves(shifted, kStep).points, line, {});
  EXPECT_TRUE(result.converged);
  const Vec3 moved = result.T_target_source * Vec3(0.1, 0.005, 0);
  EXPECT_NEAR(moved.y(), 0, 1e-6);
  EXPECT_NEAR(moved.x(), 0.1, 1e-6);  // along the line nothing is known
}

TEST(AlignPoints, NothingToAlignIsNoConvergence) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(AlignPoints({}, AlignmentTarget({points, {}}), {}).converged);
  EXPECT_FALSE(AlignPoints(points, AlignmentTarget({{}, {}}), {}).converged);
  EXPECT_FALSE(
      AlignPoints(points, AlignmentTarget({points, {}}), {}).converged);  // two pairs: too few
  const AlignmentResult far = AlignToCurves(points, Lattice(3, 3, 0.05, 1), {});
  EXPECT_TRUE(far.T_target_source.isApprox(RigidTransform::Identity()));
}

TEST(AlignPoints, TheNumberOfThreadsDoesNotMatter) {
  const SkeletonGraph target = Lattice(3, 3, 0.08);
  const std::vector<Vec3> points = NoisySamples(target, 0.001, 0.002);
  const auto align = [&](int threads) {
    const ThreadLimit limit(threads);
    return AlignToCurves(points, target, {}).T_target_source.matrix().eval();
  };
  EXPECT_EQ(align(1), align(2));
}

TEST(AlignPoints, IsFastEnoughForEveryFrame) {
  const SkeletonGraph target = Lattice(10, 10, 0.05);
  const CurveSamples samples = SampleCurves(target, 0.00018);
  const RigidTransform truth = Motion(0.01, {3, 1, 0}, {0.004, 0.003, 0.002});
  const std::vector<Vec3> points =
      NoisySamples(Transformed(target, truth.inverse()), 0.00045, 0.001);
  ASSERT_GT(points.size(), 19000u);
  ASSERT_GT(samples.points.size(), 49000u);
  const auto start = std::chrono::steady_clock::now();
  const AlignmentResult result = AlignPoints(points, AlignmentTarget(samples), {});
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_TRUE(result.converged);
  RecordProperty("milliseconds", std::to_string(1e3 * seconds));
  EXPECT_LT(seconds, 0.5);  // 50 ms on an idle core; machines are slower and busy
}

}  // namespace
}  // namespace curvefusion
