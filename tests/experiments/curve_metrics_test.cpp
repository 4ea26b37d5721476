#include "experiments/metrics/curve_metrics.h"

#include <gtest/gtest.h>

#include "experiments/metrics/diameter_metrics.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

SkeletonGraph Wire(const Vec3& a, const Vec3& b, double radius) {
  SkeletonGraph graph;
  const NodeId from = graph.AddNode(a);
  const NodeId to = graph.AddNode(b);
  graph.AddEdge({{from, to}, {a, b}, {radius, radius}, {}});
  return graph;
}

TEST(PrecisionRecall, FIsHarmonicAndZeroWhereOneIsMissing) {
  EXPECT_NEAR(*(PrecisionRecall{0.5, 1.0}.F()), 2.0 / 3, 1e-15);  // rounding
  EXPECT_EQ((PrecisionRecall{0.0, 0.0}.F()), 0.0);
  EXPECT_EQ((PrecisionRecall{std::nullopt, 0.0}.F()), 0.0);
  EXPECT_EQ(PrecisionRecall{}.F(), std::nullopt);
}

TEST(Percentile, InterpolatesBetweenNeighbours) {
  EXPECT_EQ(Percentile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_EQ(Percentile({4, 1, 3, 2}, 1), 4);
  EXPECT_EQ(Percentile({4, 1, 3, 2}, 0), 1);
  EXPECT_EQ(Percentile({7}, 0.95), 7);
}

TEST(ShareWithin, CountsByWeightWithTheLimit) {
  EXPECT_EQ(ShareWithin({1, 2, 3, 4}, {}, 2), 0.5);
  EXPECT_EQ(ShareWithin({1, 2}, {1, 3}, 1.5), 0.25);
  EXPECT_EQ(ShareWithin({}, {}, 1), std::nullopt);
}

TEST(SampleSkeleton, EveryMillimetreWithInterpolatedRadii) {
  SkeletonGraph graph;
  const NodeId a = graph.AddNode({0, 0, 0});
  const NodeId b = graph.AddNode({0.1, 0, 0});
  graph.AddEdge({{a, b}, {{0, 0, 0}, {0.1, 0, 0}}, {0.001, 0.003}, {}});
  const SkeletonSamples samples = SampleSkeleton(graph);
  ASSERT_EQ(samples.size(), 101u);
  EXPECT_NEAR(samples.arc_lengths[25], 0.025, 1e-12);  // rounding
  EXPECT_NEAR(samples.radii[25], 0.0015, 1e-12);
  EXPECT_EQ(samples.radii[100], 0.003);
}

TEST(CompareCurves, IdentityIsPerfect) {
  const SkeletonSamples samples = SampleSkeleton(Lattice(3, 3, 0.05));
  const DistanceScores scores = CompareCurves(samples, samples);
  for (const PrecisionRecall& score : scores.within) EXPECT_EQ(score.F(), 1.0);
  EXPECT_EQ(scores.mean, 0.0);
  EXPECT_EQ(scores.percentile_95, 0.0);
}

TEST(CompareCurves, AShiftAcrossAWireIsItsDistance) {
  const SkeletonSamples truth = SampleSkeleton(Wire({0, 0, 0}, {0.2, 0, 0}, 0.002));
  const SkeletonSamples result = SampleSkeleton(Wire({0, 0.003, 0}, {0.2, 0.003, 0}, 0.002));
  const DistanceScores scores = CompareCurves(result, truth);
  EXPECT_EQ(scores.within[0].F(), 0.0);
  EXPECT_EQ(scores.within[1].F(), 0.0);
  EXPECT_EQ(scores.within[2].F(), 1.0);
  EXPECT_NEAR(*scores.mean, 0.003, 1e-12);  // rounding
  EXPECT_NEAR(*scores.percentile_95, 0.003, 1e-12);
}

TEST(CompareCurves, MissingLengthLowersRecallAndFalseLengthPrecision) {
  const SkeletonSamples whole = SampleSkeleton(Wire({0, 0, 0}, {0.2, 0, 0}, 0.002));
  const SkeletonSamples half = SampleSkeleton(Wire({0, 0, 0}, {0.1, 0, 0}, 0.002));
  const DistanceScores missing = CompareCurves(half, whole);
  EXPECT_EQ(missing.within[2].precision, 1.0);
  // The half and the 5 mm beyond its end: 106 of 201 samples; one may fall to either side.
  EXPECT_NEAR(*missing.within[2].recall, 106.0 / 201, 1.01 / 201);
  const DistanceScores extra = CompareCurves(whole, half);
  EXPECT_EQ(extra.within[2].recall, 1.0);
  EXPECT_EQ(extra.within[2].precision, missing.within[2].recall);
}

TEST(CompareCurves, FalseAndMissingLengthInMetres) {
  // 0.1 m are in both, 0.2 m are missing, 0.3 m false; 10 mm next to what is in both count as near.
  const SkeletonSamples truth = SampleSkeleton(Wire({0, 0, 0}, {0.3, 0, 0}, 0.002));
  SkeletonGraph found = Wire({0, 0, 0}, {0.1, 0, 0}, 0.002);
  found.AddPolyline({{0, 1, 0}, {0, 1.3, 0}});
  const DistanceScores scores = CompareCurves(SampleSkeleton(found), truth);
  EXPECT_NEAR(scores.false_length, 0.3, 1e-9);       // rounding
  EXPECT_NEAR(scores.missing_length, 0.19, 0.0011);  // one sample more or less
}

TEST(CompareCurves, LengthsOfTheEmpty) {
  const SkeletonSamples wire = SampleSkeleton(Wire({0, 0, 0}, {0.2, 0, 0}, 0.002));
  EXPECT_NEAR(CompareCurves(wire, {}).false_length, 0.2, 1e-9);  // rounding
  EXPECT_EQ(CompareCurves(wire, {}).missing_length, 0);
  EXPECT_NEAR(CompareCurves({}, wire).missing_length, 0.2, 1e-9);
  EXPECT_EQ(CompareCurves({}, wire).false_length, 0);
}

TEST(CompareCurves, NothingFoundAndNothingToFind) {
  const SkeletonSamples wire = SampleSkeleton(Wire({0, 0, 0}, {0.2, 0, 0}, 0.002));
  const DistanceScores nothing_found = CompareCurves({}, wire);
  EXPECT_EQ(nothing_found.within[2].precision, std::nullopt);
  EXPECT_EQ(nothing_found.within[2].recall, 0.0);
  EXPECT_EQ(nothing_found.within[2].F(), 0.0);
  const DistanceScores all_false = CompareCurves(wire, {});
  EXPECT_EQ(all_false.within[2].precision, 0.0);
  EXPECT_EQ(all_false.within[2].F(), 0.0);
  EXPECT_EQ(CompareCurves({}, {}).within[2].F(), std::nullopt);
  EXPECT_EQ(CompareCurves({}, {}).mean, std::nullopt);
}

TEST(CompareDiameters, MeanRelativeAndPerEdge) {
  SkeletonGraph truth = Wire({0, 0, 0}, {0.1, 0, 0}, 0.002);
  SkeletonGraph result = Wire({0, 0.001, 0}, {0.1, 0.001, 0}, 0.0025);
  // A false curve: no true diameter within 10 mm.
  const NodeId a = result.AddNode({0, 0.5, 0});
  const NodeId b = result.AddNode({0.1, 0.5, 0});
  result.AddEdge({{a, b}, {{0, 0.5, 0}, {0.1, 0.5, 0}}, {0.01, 0.01}, {}});
  const DiameterScores scores = CompareDiameters(SampleSkeleton(result), SampleSkeleton(truth));
  EXPECT_NEAR(*scores.mean_error, 0.001, 1e-12);  // rounding
  EXPECT_NEAR(*scores.relative_error, 0.25, 1e-12);
  EXPECT_EQ(scores.compared_share, 0.5);
  ASSERT_EQ(scores.edges.size(), 1u);
  EXPECT_NEAR(scores.edges[0].length, 0.1, 1e-12);
  EXPECT_NEAR(scores.edges[0].diameter, 0.005, 1e-12);
  EXPECT_NEAR(scores.edges[0].true_diameter, 0.004, 1e-12);
}

TEST(CompareDiameters, NoneKnown) {
  const SkeletonSamples truth = SampleSkeleton(Wire({0, 0, 0}, {0.1, 0, 0}, 0.002));
  SkeletonGraph bare;
  bare.AddPolyline(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  EXPECT_EQ(CompareDiameters(SampleSkeleton(bare), truth).mean_error, std::nullopt);
  EXPECT_EQ(CompareDiameters({}, truth).mean_error, std::nullopt);
}

}  // namespace
}  // namespace curvefusion
