#include "fusion/curve_graph/colour_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fusion/curve_graph/candidate_curves.h"
#include "graph/validate.h"
#include "kernel/quantile.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

// A wire that depth has shown, and one that branches off and is not known yet.
const Polyline kStem = TestLine({0, 0.08, 0}, {0, -0.02, 0});
const Polyline kTwig = TestLine({0, -0.02, 0}, {0.05, -0.08, 0.02});
constexpr double kBehind = 1.2;  // metres to what stands behind

SkeletonGraph Known() {
  SkeletonGraph graph;
  AddTestEdge(graph, kStem);
  return graph;
}

double DistanceTo(const Polyline& curve, const Vec3& p) { return Project(curve, p).distance; }

ObservedPoints FindCandidates(const StripViews& views,
                              CandidatePlaces wanted = CandidatePlaces::kFree) {
  return FindColourCandidates(views, {.places = wanted}, [](int64_t, int64_t) {});
}

TEST(ColourCandidates, LieOnTheWireThatNoCurveExplains) {
  const SilhouetteScan scan({kStem, kTwig}, {}, kBehind);
  const ObservedPoints candidates = FindCandidates(scan.Strips(Known()));
  EXPECT_GT(candidates.size(), 50u);
  std::vector<double> distances;
  for (const Vec3& p : candidates.positions) distances.push_back(DistanceTo(kTwig, p));
  EXPECT_LT(Median(distances), kTestRadius);
  EXPECT_LT(Quantile(distances, 1), 0.006);  // along the line of sight, by a pixel in 40 degrees
}

// Of many strips only some lines of sight are searched; places beside those found tell the rest.
TEST(ColourCandidates, FollowedAlongTheirStripsAreMore) {
  std::vector<Polyline> wires = {kStem};
  for (int i = 1; i < 10; ++i) {
    const double x = 0.02 * (i % 2 == 0 ? i / 2 : -(i + 1) / 2);
    wires.push_back(TestLine({x, 0.1, 0.1 * x}, {x, -0.1, 0.3 * x}));
  }
  const SilhouetteScan scan(wires, {}, kBehind);
  const StripViews views = scan.Strips(Known());
  const ObservedPoints few = FindCandidates(views);
  const ObservedPoints followed = FindColourCandidates(
      views, {.places = CandidatePlaces::kFree, .follow = true}, [](int64_t, int64_t) {});
  EXPECT_GT(followed.size(), few.size());
  const auto share_on_wires = [&wires](const ObservedPoints& places) {
    const auto is_on_wire = [&wires](const Vec3& p) {
      return std::any_of(wires.begin(), wires.end(),
                         [&p](const Polyline& wire) { return DistanceTo(wire, p) < 0.006; });
    };
    return static_cast<double>(
               std::count_if(places.positions.begin(), places.positions.end(), is_on_wire)) /
           static_cast<double>(places.size());
  };
  EXPECT_GT(share_on_wires(followed), 0.98 * share_on_wires(few));
}

// Of a wire that all images see places stay, where most propose some; where all must, fewer do.
TEST(ColourCandidates, ArePlacesThatEnoughImagesPropose) {
  const SilhouetteScan scan({kStem, kTwig}, {}, kBehind);
  const StripViews views = scan.Strips(Known());
  const auto find = [&views](double min_support) {
    return FindColourCandidates(views,
                                {.places = CandidatePlaces::kFree, .min_support = min_support},
                                [](int64_t, int64_t) {});
  };
  const size_t all = find(0).size();
  EXPECT_GT(find(0.5).size(), 0.95 * static_cast<double>(all));
  EXPECT_GT(find(1).size(), 0u);
  EXPECT_LT(find(1).size(), all);
  EXPECT_TRUE(find(1.01).empty());
}

TEST(ColourCandidates, NoneWhereCurvesExplainAllStrips) {
  const SilhouetteScan scan({kStem, kTwig}, {}, kBehind);
  SkeletonGraph graph = Known();
  AddTestEdge(graph, kTwig);
  EXPECT_TRUE(FindCandidates(scan.Strips(graph)).empty());
}

// What is painted on a wall at the twig's own distance is no wire.
TEST(ColourCandidates, NoneWhereNothingIsFarBehind) {
  const SilhouetteScan scan({kStem, kTwig}, {}, 0.605);
  EXPECT_TRUE(FindCandidates(scan.Strips(Known())).empty());
}

// Before something even, colours tell no more than depth does.
TEST(CandidateCurves, WhatIsPaintedOnAWallIsLeftOut) {
  const SilhouetteScan scan({kStem, kTwig}, {}, 0.605);
  SkeletonGraph graph = Known();
  StripViews views = scan.Strips(graph);
  const ObservedPoints places = FindCandidates(views, CandidatePlaces::kAll);
  EXPECT_FALSE(places.empty());
  EXPECT_EQ(AddCandidateCurves(scan.sequence(), places, {}, kTestRadius, views, graph).length, 0);
}

TEST(ColourCandidates, TellHowFarTheSearchIs) {
  const SilhouetteScan scan({kStem, kTwig}, {}, kBehind);
  std::vector<int64_t> steps;
  int64_t of = 0;
  FindColourCandidates(scan.Strips(Known()), {.places = CandidatePlaces::kFree},
                       [&](int64_t done, int64_t total) {
                         steps.push_back(done);
                         of = total;
                       });
  ASSERT_GT(of, 10);
  std::vector<int64_t> all(of);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(steps, all);
}

TEST(ColourCandidates, NoneWithoutCurves) {
  const SilhouetteScan scan({kTwig}, {}, kBehind);
  EXPECT_TRUE(FindCandidates(scan.Strips({})).empty());
}

TEST(CandidateCurves, JoinWhatIsThere) {
  const SilhouetteScan scan({kStem, kTwig}, {}, kBehind);
  SkeletonGraph graph = Known();
  StripViews views = scan.Strips(graph);
  const AddedCurves added =
      AddCandidateCurves(scan.sequence(), FindCandidates(views), {}, kTestRadius, views, graph);
  EXPECT_NEAR(added.length, Length(kTwig), 0.01);
  EXPECT_EQ(graph.ComponentCount(), 1);
  EXPECT_TRUE(Faults(graph).empty());
}

// The twig, before something far: strips' middles lie on it.
TEST(CandidateCurves, TellWhatTheyWereDecidedBy) {
  const SilhouetteScan scan({kStem, kTwig}, {}, kBehind);
  SkeletonGraph graph = Known();
  StripViews views = scan.Strips(graph);
  const AddedCurves added =
      AddCandidateCurves(scan.sequence(), FindCandidates(views), {}, kTestRadius, views, graph);
  ASSERT_FALSE(added.stretches.empty());
  double length = 0;
  for (const CandidateStretch& stretch : added.stretches) {
    EXPECT_TRUE(stretch.is_free);
    EXPECT_GT(stretch.middle_evidence, 0.2);
    EXPECT_GT(stretch.found_places, 0.2);
    for (const Vec3& p : stretch.places) EXPECT_LT(DistanceTo(kTwig, p), 0.002);
    length += stretch.length;
  }
  EXPECT_NEAR(length, Length(kTwig), 0.02);
  const std::string csv = StretchesCsv(added.stretches);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'),
            static_cast<std::ptrdiff_t>(added.stretches.size() + 1));
}

// Of a wire beside the stem, so long: what is added.
double AddedBesideStem(double length, double behind) {
  const Polyline beside = TestLine({0.055, -length / 2, 0}, {0.055, length / 2, 0});
  const SilhouetteScan scan({kStem, beside}, {}, behind);
  SkeletonGraph graph = Known();
  StripViews views = scan.Strips(graph);
  const ObservedPoints candidates = FindCandidates(views, CandidatePlaces::kAll);
  EXPECT_FALSE(candidates.empty());
  return AddCandidateCurves(scan.sequence(), candidates, {}, kTestRadius, views, graph).length;
}

TEST(CandidateCurves, ThatHangTogetherWithNothingStayWhereTheyAreLong) {
  EXPECT_NEAR(AddedBesideStem(0.2, kBehind), 0.2, 0.02);
  EXPECT_EQ(AddedBesideStem(0.03, kBehind), 0);
}

TEST(CandidateCurves, ThatHangTogetherWithNothingAreLeftOutBeforeASurface) {
  EXPECT_EQ(AddedBesideStem(0.2, 0.605), 0);
}

TEST(CandidateCurves, NothingWithoutCandidates) {
  SkeletonGraph graph = Known();
  StripViews views({}, {}, {}, Eigen::AlignedBox3d());
  EXPECT_EQ(AddCandidateCurves({}, {}, {}, kTestRadius, views, graph).length, 0);
}

}  // namespace
}  // namespace curvefusion
