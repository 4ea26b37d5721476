#include "fusion/paper/curve_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fusion/paper/new_parts.h"
#include "fusion/paper/overlap_averaging.h"
#include "tests/graph/graph_fixtures.h"

namespace curvefusion {
namespace {

constexpr double kStep = 1 * kMillimetre;
constexpr double kDistance = 10 * kMillimetre;

int MatchedCount(const std::vector<Match>& matches) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(),
                                        [](const Match& match) { return match.edge >= 0; }));
}

TEST(MatchGraphs, ParallelCurvesMatchAlongTheirCommonPart) {
  const SkeletonGraph target = OfCurve(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  const SkeletonGraph source = OfCurve(StraightLine({0.06, 0.004, 0}, {0.16, 0.004, 0}));
  const std::vector<Match> matches = MatchGraphs(source, target, kStep, kDistance)[0];
  // Up to the end of the target at x = 0.1 and at most a step beyond.
  EXPECT_NEAR(MatchedCount(matches), 41, 1.1);
  EXPECT_NEAR(matches[10].parameter, 70, 1e-6);
  EXPECT_NEAR(matches[10].distance, 0.004, 1e-9);
  EXPECT_FALSE(matches[60].is_near);
}

TEST(MatchGraphs, CrossingCurvesAreNearButDoNotMatch) {
  const SkeletonGraph target = OfCurve(StraightLine({-0.05, 0, 0}, {0.05, 0, 0}));
  const SkeletonGraph source = OfCurve(StraightLine({0, -0.05, 0}, {0, 0.05, 0}));
  const std::vector<Match> matches = MatchGraphs(source, target, kStep, kDistance)[0];
  EXPECT_EQ(MatchedCount(matches), 0);
  EXPECT_TRUE(matches[50].is_near);
  EXPECT_FALSE(matches[35].is_near);
}

TEST(MatchGraphs, FartherOrEmptyGraphsMatchNothing) {
  const SkeletonGraph source = OfCurve(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  EXPECT_EQ(MatchedCount(MatchGraphs(source, {}, kStep, kDistance)[0]), 0);
  EXPECT_TRUE(MatchGraphs({}, source, kStep, kDistance).empty());
  const SkeletonGraph far = OfCurve(StraightLine({0, 0.0101, 0}, {0.1, 0.0101, 0}));
  EXPECT_EQ(MatchedCount(MatchGraphs(source, far, kStep, kDistance)[0]), 0);
}

TEST(AverageOverlaps, MovesTheOverlapAndNothingElse) {
  SkeletonGraph partial = OfCurve(StraightLine({0, 0, 0}, {0.2, 0, 0}));
  const SkeletonGraph bundle = OfCurve(StraightLine({0.05, 0.004, 0}, {0.1, 0.004, 0}));
  const auto matches = MatchGraphs(bundle, partial, kStep, kDistance);
  AverageOverlaps(partial, bundle, matches, {0.25, 0.01});
  const SkeletonEdge& edge = partial.edge(0);
  ASSERT_EQ(edge.points.size(), 201u);
  EXPECT_NEAR(edge.points[75].y(), 0.001, 1e-12);  // a quarter of 4 mm
  // "While keeping the original curve segments for the non-overlapping areas."
  EXPECT_EQ(edge.points[48].y(), 0);
  EXPECT_EQ(edge.points[102].y(), 0);
}

TEST(AddNewParts, OnlyWhatIsNewIsAdded) {
  SkeletonGraph partial = OfCurve(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  const SkeletonGraph bundle = OfCurve(StraightLine({0.06, 0.001, 0}, {0.16, 0.001, 0}));
  const auto matches = MatchGraphs(bundle, partial, kStep, kDistance);
  AddNewParts(partial, bundle, matches, {0.01, 0.01, 0.003});
  partial.DissolveDegree2Nodes();
  ASSERT_EQ(partial.edge_count(), 1);
  EXPECT_NEAR(partial.TotalLength(), 0.16, 0.0005);
}

TEST(AddNewParts, StubsWithinTheOverlapDistanceAreNoise) {
  SkeletonGraph partial = OfCurve(StraightLine({0, 0, 0}, {0.1, 0, 0}));
  for (const double length : {0.008, 0.02}) {
    const SkeletonGraph bundle = OfCurve(StraightLine({0.05, 0.001, 0}, {0.05, length, 0}));
    const auto matches = MatchGraphs(bundle, partial, kStep, kDistance);
    SkeletonGraph grown = partial;
    AddNewParts(grown, bundle, matches, {0.01, 0.01, 0.003});
    EXPECT_EQ(grown.edge_count(), length > 0.01 ? 2 : 1) << length;
  }
}

}  // namespace
}  // namespace curvefusion
