// Wires found in three silhouettes, of which the truth is known.
#include "experiments/baselines/three_view_wires.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <ostream>
#include <string>

#include "experiments/baselines/image_curves.h"
#include "experiments/metrics/curve_metrics.h"
#include "experiments/simulation/object_truth.h"
#include "experiments/simulation/objects.h"
#include "kernel/error.h"
#include "tests/error_message.h"

namespace curvefusion {
namespace {

constexpr double kWire = 2 * kMillimetre;  // radius
constexpr double kFarAway = 0.5;           // a pixel is then 1 mm
const PinholeCamera kCamera{320, 240, 500, 500, 159.5, 119.5};
// None of the wires below runs along an epipolar line of all three pairs of these views.
const Vec3 kAway = -Vec3::UnitY();

void AddWire(const Polyline& points, SkeletonGraph& graph) {
  const EdgeId edge = graph.AddPolyline(points);
  graph.SetCurve(edge, points, std::vector<double>(points.size(), kWire));
}

SkeletonGraph StraightWire() {
  SkeletonGraph graph;
  AddWire({{-0.06, 0.01, -0.03}, {0.06, -0.01, 0.05}}, graph);
  return graph;
}

SkeletonGraph CrossingWires() {
  SkeletonGraph graph = StraightWire();
  AddWire({{-0.04, 0.02, 0.06}, {0.05, 0.03, -0.05}}, graph);  // behind the other, 30 mm
  return graph;
}

SkeletonGraph Ring() {
  Polyline points;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100;
    points.push_back(0.05 * Vec3(std::cos(angle), 0.3 * std::sin(angle), std::sin(angle)));
  }
  points.push_back(points.front());
  SkeletonGraph graph;
  AddWire(points, graph);
  return graph;
}

// Wires at equal distances: those of one image lie on epipolar lines of those of another.
SkeletonGraph Grille() {
  SkeletonGraph graph;
  for (int i = -4; i <= 4; ++i) {
    AddWire({{0.012 * i - 0.01, 0, -0.07}, {0.012 * i + 0.01, 0, 0.07}}, graph);
  }
  return graph;
}

std::vector<SilhouetteMap> ViewsOf(const SkeletonGraph& truth) {
  return TrueSilhouettes(truth, kCamera, ThreePosesAround(Vec3::Zero(), kAway, kFarAway));
}

ThreeViewWires WiresOf(const SkeletonGraph& truth, SupportRule rule = SupportRule::kOfProgram) {
  return WiresOfThreeViews(ViewsOf(truth), rule, NoProgress);
}

PrecisionRecall Within(int threshold, const SkeletonGraph& result, const SkeletonGraph& truth) {
  return CompareCurves(SampleSkeleton(result), SampleSkeleton(truth)).within[threshold];
}

// A pixel of 1 mm beside its place is 1 / sin(36 degrees) = 1.7 mm in depth.
PrecisionRecall WithinAPixel(const SkeletonGraph& result, const SkeletonGraph& truth) {
  static_assert(kDistanceThresholds[1] == 2 * kMillimetre);
  return Within(1, result, truth);
}

TEST(ThinnedSilhouette, IsOnePixelWideAndAsConnected) {
  MaskImage ring(60, 60, 0);
  for (int v = 0; v < 60; ++v) {
    for (int u = 0; u < 60; ++u) ring(u, v) = std::abs(std::hypot(u - 30, v - 30) - 20) < 4;
  }
  const MaskImage thin = Thinned(ring);
  const int pixels = std::accumulate(thin.data(), thin.data() + thin.size(), 0);
  // Around a circle of radius 20 there are 8 r / sqrt(2) = 113 pixels from corner to corner.
  EXPECT_NEAR(pixels, 113, 8);
  const auto curves = SplitAtJunctions(thin, 10);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].points.front(), curves[0].points.back());
  for (const Vec2& p : curves[0].points) EXPECT_NEAR((p - Vec2(30, 30)).norm(), 20, 1);
  EXPECT_FALSE(AnySet(Thinned(MaskImage(60, 60, 0))));
}

TEST(ImageCurves, EndWhereTheyMeetAndHaveNoTwigs) {
  MaskImage lines(60, 60, 0);
  for (int i = 5; i < 55; ++i) lines(i, 30) = lines(30, i) = 1;
  for (int i = 1; i < 6; ++i) lines(15, 30 + i) = 1;  // a twig of 5 pixels
  const auto curves = SplitAtJunctions(lines, 10);
  ASSERT_EQ(curves.size(), 4u);
  for (const ImageCurve& curve : curves) EXPECT_NEAR(curve.points.size(), 25, 1);
  EXPECT_EQ(SplitAtJunctions(lines, 0).size(), 6u);
}

TEST(ThreePoses, LookAtTheCentreFromEqualDistancesAndAngles) {
  const auto poses = ThreePosesAround({1, 2, 3}, kAway, kFarAway, 0.5);
  ASSERT_EQ(poses.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE((poses[i].inverse() * Vec3(1, 2, 3)).isApprox(Vec3(0, 0, kFarAway)));
    const double cosine = poses[i].linear().col(2).dot(poses[(i + 1) % 3].linear().col(2));
    EXPECT_NEAR(std::acos(cosine), 0.5, 1e-9);
  }
}

struct NamedObject {
  const char* name;
  SkeletonGraph (*make)();
};

void PrintTo(const NamedObject& object, std::ostream* out) { *out << object.name; }

class SimpleWires : public testing::TestWithParam<NamedObject> {};
INSTANTIATE_TEST_SUITE_P(Liu2017, SimpleWires,
                         testing::Values(NamedObject{"StraightWire", StraightWire},
                                         NamedObject{"CrossingWires", CrossingWires},
                                         NamedObject{"Ring", Ring}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(SimpleWires, AreFoundWithinAPixelAndNothingElseIs) {
  const SkeletonGraph truth = GetParam().make();
  const PrecisionRecall selected = WithinAPixel(WiresOf(truth).selected, truth);
  EXPECT_GE(selected.recall.value_or(0), 0.9);
  EXPECT_GE(selected.precision.value_or(0), 0.9);
}

TEST(ThreeViewWires, OfAGrilleAreSpuriousBeforeTheSelection) {
  const SkeletonGraph truth = Grille();
  const ThreeViewWires wires = WiresOf(truth);
  EXPECT_GE(WithinAPixel(wires.candidates, truth).recall.value_or(0), 0.9);
  EXPECT_LE(Within(2, wires.candidates, truth).precision.value_or(1), 0.5);
  EXPECT_LT(wires.selected.TotalLength(), 0.5 * wires.candidates.TotalLength());
}

// The mean distance to the curves of the third view, all along a candidate, tells more of them.
TEST(ThreeViewWires, AreTrueMoreOftenWithStricterSupport) {
  const SkeletonGraph truth = Grille();
  const ThreeViewWires lax = WiresOf(truth);
  const ThreeViewWires strict = WiresOf(truth, SupportRule::kMeanDistance);
  EXPECT_LT(strict.candidates.TotalLength(), lax.candidates.TotalLength());
  EXPECT_GT(Within(2, strict.candidates, truth).precision.value_or(0),
            Within(2, lax.candidates, truth).precision.value_or(1));
}

// The publication shows objects of one or a few bent wires; the spring is three metres of one.
TEST(ThreeViewWires, OfASpringAreTheSpring) {
  const SkeletonGraph truth = TruthSkeleton(MakeObject("spring"));
  const auto poses = ThreePosesAround(BoundsOf(truth).center(), kAway, 0.8);
  const PinholeCamera camera{1280, 960, 1150, 1150, 639.5, 479.5};
  const ThreeViewWires wires =
      WiresOfThreeViews(TrueSilhouettes(truth, camera, poses), SupportRule::kOfProgram, NoProgress);
  const PrecisionRecall selected = Within(2, wires.selected, truth);
  EXPECT_GE(selected.recall.value_or(0), 0.85);  // measured .9
  EXPECT_GE(selected.precision.value_or(0), 0.85);
}

TEST(ThreeViewWires, OfNothingAreNone) {
  const ThreeViewWires wires = WiresOf({});
  EXPECT_TRUE(wires.candidates.empty());
  EXPECT_TRUE(wires.selected.empty());
}

TEST(ThreeViewWires, NeedThreeViews) {
  std::vector<SilhouetteMap> views = ViewsOf(StraightWire());
  views.pop_back();
  const auto act = [&] { WiresOfThreeViews(views, SupportRule::kOfProgram, NoProgress); };
  EXPECT_THAT(MessageOf(ErrorKind::kBadInput, act), testing::HasSubstr("2 are given"));
}

TEST(ThreeViewWires, CanBeInterrupted) {
  const Progress interrupt = [](std::string_view, int64_t, int64_t) {
    throw Error(ErrorKind::kInterrupted, "stop");
  };
  EXPECT_THROW(WiresOfThreeViews(ViewsOf(Ring()), SupportRule::kOfProgram, interrupt), Error);
}

}  // namespace
}  // namespace curvefusion
