#include "fusion/best/colour_start.h"

#include <gtest/gtest.h>

#include "capture/frame_stream.h"
#include "fusion/appearance/wire_posterior.h"
#include "fusion/pipeline.h"
#include "graph/io/graph_io.h"
#include "kernel/error.h"
#include "kernel/parallel.h"
#include "kernel/quantile.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kBehind = 1.2;  // metres to what stands behind

const std::vector<Polyline> kWires = {TestLine({-0.05, 0.08, 0}, {-0.05, -0.08, 0.02}),
                                      TestLine({-0.05, -0.02, 0.012}, {0.06, 0.05, 0.03}),
                                      TestLine({0.06, 0.05, 0.03}, {0.04, -0.07, -0.02})};

// What a camera shows whose depth is off along its line of sight.
SkeletonGraph WiresOffBy(double depth) {
  SkeletonGraph graph;
  for (Polyline wire : kWires) {
    for (Vec3& p : wire) p.z() += depth;
    AddTestEdge(graph, wire);
  }
  return graph;
}

WireColours ColoursOf(const Sequence& sequence) {
  constexpr uint8_t kDark = 100;
  WireColourModel model;
  ForEachFrame(sequence, {0}, {.depth = false, .color = true}, [&](const DecodedFrame& frame) {
    const ColourBins bins = BinColours(frame.color);
    for (size_t i = 0; i < bins.size(); ++i) {
      if (frame.color.data()[i][0] < kDark) {
        model.AddWire(bins.data()[i]);
      } else {
        model.AddBackground(bins.data()[i]);
      }
    }
  });
  return {.posterior = model.Posterior()};
}

double LengthOfWires() {
  double length = 0;
  for (const Polyline& wire : kWires) length += Length(wire);
  return length;
}

class ColourStart : public testing::Test {
 protected:
  // Starts with curves of depth that are off by so much.
  std::optional<ColourCurves> Start(double depth,
                                    const BestOptions& options = DefaultBestOptions()) {
    result_.skeleton = WiresOffBy(depth);
    AddPointsBehindWires(depth);
    return StartWithCurves(options, DepthCurves::kDoubtful);
  }

  // What a camera sees that mixes wires with what is behind them.
  void AddPointsBehindWires(double depth) {
    for (const SequenceFrame& frame : scan_.sequence().frames) {
      const Vec3 center = frame.T_world_camera.translation();
      for (const Polyline& wire : kWires) {
        for (const Vec3& p : Resample(wire, 0.004)) {
          const Vec3 ray = (p - center).normalized();
          result_.points.Add(p + depth * ray, ray, 1);
        }
      }
    }
  }

  std::optional<ColourCurves> StartWithCurves(const BestOptions& options,
                                              DepthCurves depth_curves) {
    return StartIn(scan_, options, depth_curves);
  }

  std::optional<ColourCurves> StartIn(const SilhouetteScan& scan, const BestOptions& options,
                                      DepthCurves depth_curves) {
    result_.sequence = scan.sequence();
    return StartFromColour(scan.sequence(), PoseErrors::kDrift, ColoursOf(scan.sequence()),
                           depth_curves, options, StageReporter{observer_, log_}, result_);
  }

  std::optional<ColourCurves> FitAlone(SkeletonGraph curves) {
    return FitToColourAlone(std::move(curves), scan_.sequence(), PoseErrors::kJitter,
                            ColoursOf(scan_.sequence()).posterior, DefaultBestOptions(),
                            StageReporter{observer_, log_}, result_);
  }

  // Depth shows something thin at one of the wires only.
  void AddPointsAtOneWire() {
    for (const Vec3& p : Resample(kWires[0], 0.004)) result_.points.Add(p, Vec3::UnitZ(), 1);
    for (const double x : {-0.1, 0.1}) result_.points.Add({x, x, 0}, Vec3::UnitZ(), 1);
  }

  std::optional<ColourCurves> StartWithPointsAtOneWire() {
    result_.skeleton = WiresOffBy(0.04);
    AddPointsAtOneWire();
    return StartWithCurves(DefaultBestOptions(), DepthCurves::kDoubtful);
  }

  // Most of what depth has of something thin lies on no wire.
  void AddStrayPoints() {
    for (double x = -0.3; x < -0.12; x += 0.003)
      for (double y = -0.1; y < 0.1; y += 0.003) result_.points.Add({x, y, 0}, Vec3::UnitZ(), 1);
  }

  double Count(const std::string& name) const {
    double count = 0;
    for (const StageReport& stage : log_.stages())
      for (const auto& [what, value] : stage.counts)
        if (what == name) count = value;
    return count;
  }

  double MedianDistance() const {
    std::vector<double> distances;
    for (const EdgeId id : result_.skeleton.Edges()) {
      for (const Vec3& p : result_.skeleton.edge(id).points) {
        double nearest = 1;
        for (const Polyline& wire : kWires) nearest = std::min(nearest, Project(wire, p).distance);
        distances.push_back(nearest);
      }
    }
    return Median(distances);
  }

  SilhouetteScan scan_{kWires, {}, kBehind};
  PipelineObserver observer_;
  StageLog log_;
  Reconstruction result_;
};

TEST_F(ColourStart, FindsWiresThatDepthShowsInWrongPlaces) {
  ASSERT_TRUE(Start(0.04).has_value());
  EXPECT_LT(MedianDistance(), 0.001);
  const double length = LengthOfWires();
  EXPECT_NEAR(result_.skeleton.TotalLength(), length, 0.15 * length);
  EXPECT_EQ(result_.warnings.size(), 1u);
}

TEST_F(ColourStart, DepthsCurvesAreFittedToImagesAlone) {
  SkeletonGraph curves;
  const std::vector<double> too_far = {0.015, 0, 0.008};  // the thinner a wire the farther
  for (size_t i = 0; i < kWires.size(); ++i) {
    Polyline wire = kWires[i];
    for (Vec3& p : wire) p.z() += too_far[i];
    AddTestEdge(curves, wire);
  }
  ASSERT_TRUE(FitAlone(curves).has_value());
  // All may move together with the cameras; the wires touch one another again.
  const SkeletonGraph& fitted = result_.skeleton;
  const std::vector<EdgeId> edges = fitted.Edges();
  ASSERT_EQ(edges.size(), 3u);
  const Polyline &first = fitted.edge(edges[0]).points, &second = fitted.edge(edges[1]).points;
  EXPECT_LT(Project(first, second.front()).distance, 0.001);
  EXPECT_LT(Project(fitted.edge(edges[2]).points, second.back()).distance, 0.002);
  EXPECT_TRUE(result_.trust.from_colour);
}

// Strips are seen at more than the twentieth that an adjustment needs, at less than a tenth.
TEST_F(ColourStart, DepthsCurvesStayWhereImagesHardlyShowThem) {
  SkeletonGraph curves = WiresOffBy(0.015);
  for (double x = -0.3; x < 0.3; x += 0.04)
    AddTestEdge(curves, TestLine({x, -0.2, 0.1}, {x, 0.2, 0.1}));
  EXPECT_FALSE(FitAlone(curves).has_value());
  EXPECT_TRUE(result_.skeleton.empty());
}

// A few curves of which all is shown are a better start than many of which most is not.
TEST_F(ColourStart, StartsWithTheWireAtWhichDepthShowsSomethingThin) {
  const std::optional<ColourCurves> started = StartWithPointsAtOneWire();
  ASSERT_TRUE(started.has_value());
  EXPECT_EQ(started->start.depth, WireDepth::kNotShown);
  EXPECT_GT(Count("share of depth on curves"), 0.9);
  EXPECT_LT(result_.skeleton.TotalLength(), 1.2 * Length(kWires[0]));
  EXPECT_LT(MedianDistance(), 0.001);
}

// Depth shows something thin all along two wires and at one place of the third: around that alone
// no curve is found, but in whole images.
TEST_F(ColourStart, StartsWithTheCurvesThatHoldMoreOfWhatDepthShowsThin) {
  result_.skeleton = WiresOffBy(0.04);
  for (const Polyline& wire : {kWires[0], kWires[2]})
    for (const Vec3& p : Resample(wire, 0.004)) result_.points.Add(p, Vec3::UnitZ(), 1);
  const Vec3 alone = 0.5 * (kWires[1].front() + kWires[1].back());
  for (int i = 0; i < 8; ++i) result_.points.Add(alone, Vec3::UnitZ(), 1);
  ASSERT_TRUE(StartWithCurves(DefaultBestOptions(), DepthCurves::kDoubtful).has_value());
  const double length = LengthOfWires();
  EXPECT_NEAR(result_.skeleton.TotalLength(), length, 0.15 * length);
  EXPECT_GT(Count("share of depth on curves"), 0.95);
}

// Strips where depth shows nothing thin are painted on something.
TEST_F(ColourStart, LeavesCurvesWhereDepthShowsNothingThinAtTheNewOnes) {
  const SilhouetteScan near_wall(kWires, {}, 0.655);
  result_.skeleton = WiresOffBy(0.04);
  AddPointsAtOneWire();
  AddStrayPoints();
  EXPECT_FALSE(StartIn(near_wall, DefaultBestOptions(), DepthCurves::kDoubtful).has_value());
  EXPECT_GT(Count("share thin in depth"), 0.1);
  EXPECT_LT(Count("share thin in depth"), 0.6);
  EXPECT_LT(Count("share free in depth"), 0.9);
}

// Depth shows what is far behind them: it does not show the wires at all.
TEST_F(ColourStart, TakesCurvesThatDepthLooksPast) {
  AddStrayPoints();
  const std::optional<ColourCurves> started = StartWithPointsAtOneWire();
  ASSERT_TRUE(started.has_value());
  EXPECT_EQ(started->start.depth, WireDepth::kLookedPast);
  EXPECT_LT(Count("share thin in depth"), 0.6);
  EXPECT_GT(Count("share free in depth"), 0.9);
  EXPECT_LT(MedianDistance(), 0.001);
}

// As a phone's: nothing was found that colours or a place could be taken from.
TEST_F(ColourStart, FindsWiresOfWhichDepthShowsNothing) {
  ASSERT_TRUE(StartWithCurves(DefaultBestOptions(), DepthCurves::kNone).has_value());
  EXPECT_GT(Count("share free in depth"), 0.9);
  EXPECT_LT(MedianDistance(), 0.001);
}

TEST_F(ColourStart, LeavesWhatLiesOnSurfacesWhereDepthShowsNoWire) {
  const SilhouetteScan near_wall(kWires, {}, 0.655);
  EXPECT_FALSE(StartIn(near_wall, DefaultBestOptions(), DepthCurves::kNone).has_value());
  EXPECT_LT(Count("share free in depth"), 0.9);
  EXPECT_TRUE(result_.skeleton.empty());
}

TEST_F(ColourStart, LeavesCurvesThatTheImagesShow) {
  EXPECT_FALSE(Start(0).has_value());
  EXPECT_EQ(result_.skeleton.edge_count(), 3);
  EXPECT_TRUE(result_.warnings.empty());
}

TEST_F(ColourStart, ReplacesThemWhereItIsToldTo) {
  BestOptions options = DefaultBestOptions();
  options.depth.use = DepthRole::kBackground;
  EXPECT_TRUE(Start(0, options).has_value());
  EXPECT_LT(MedianDistance(), 0.001);
}

// The scan's own layout has depth images; none of them is opened.
TEST_F(ColourStart, NeedsNoDepth) {
  const Sequence scan = WithoutDepth(scan_.sequence());
  result_.sequence = scan;
  const StageReporter reporter{observer_, log_};
  const auto started = StartWithoutDepth(scan, DefaultBestOptions(), reporter, result_);
  ASSERT_TRUE(started.has_value());
  EXPECT_EQ(started->start.depth, WireDepth::kNotShown);
  EXPECT_LT(MedianDistance(), 0.0015);  // images do not tell size and place
  const double length = LengthOfWires();
  EXPECT_NEAR(result_.skeleton.TotalLength(), length, 0.15 * length);
  EXPECT_EQ(result_.warnings.size(), 1u);
}

TEST_F(ColourStart, TheSwitchTellsWhatDepthIsUsedFor) {
  Sequence scan = scan_.sequence();
  for (SequenceFrame& frame : scan.frames) frame.depth_path = "there is no such file";
  BestOptions options = DefaultBestOptions();
  const auto reconstruct = [&](const Sequence& sequence, int threads) {
    const ThreadLimit limit(threads);
    return Reconstruct(sequence, options, observer_);
  };
  const Reconstruction automatic = reconstruct(WithoutDepth(scan), 2);
  EXPECT_EQ(automatic.depth.use, "none");
  EXPECT_EQ(automatic.depth.why, "the scan has no depth images");
  options.depth.use = DepthRole::kNone;
  const Reconstruction none = reconstruct(scan, 1);  // opens no depth image
  EXPECT_EQ(none.depth.use, "none");
  EXPECT_EQ(none.depth.why, "asked for");
  EXPECT_GT(none.skeleton.edge_count(), 0);
  EXPECT_EQ(SkeletonToJson(none.skeleton), SkeletonToJson(automatic.skeleton));
  options.depth.use = DepthRole::kWires;
  EXPECT_THROW(reconstruct(WithoutDepth(scan), 1), Error);
}

// What depth has of something thin may lie elsewhere, and be none.
TEST_F(ColourStart, LooksWhereCamerasLookWhereDepthShowsNoWire) {
  AddStrayPoints();
  ASSERT_TRUE(StartWithCurves(DefaultBestOptions(), DepthCurves::kNone).has_value());
  EXPECT_LT(MedianDistance(), 0.002);
  EXPECT_GT(result_.skeleton.TotalLength(), 0.85 * LengthOfWires());
}

TEST_F(ColourStart, NeedsNeitherPlaceNorColoursOfDepthThatIsOfNoHelp) {
  AddStrayPoints();
  AddTestEdge(result_.skeleton, TestLine({-0.2, -0.05, 0}, {-0.2, 0.05, 0}));
  result_.sequence = scan_.sequence();
  ASSERT_TRUE(StartFromColour(scan_.sequence(), PoseErrors::kDrift, {}, DepthCurves::kNoHelp,
                              DefaultBestOptions(), StageReporter{observer_, log_}, result_)
                  .has_value());
  EXPECT_LT(MedianDistance(), 0.002);
  EXPECT_GT(result_.skeleton.TotalLength(), 0.85 * LengthOfWires());
}

TEST_F(ColourStart, KeepsCurvesOfDepthThatImagesShowEvenWhereItIsOfNoHelp) {
  result_.skeleton = WiresOffBy(0);
  for (const Polyline& wire : kWires) AddTestEdge(result_.skeleton, wire);
  EXPECT_FALSE(StartWithCurves(DefaultBestOptions(), DepthCurves::kNoHelp).has_value());
}

// Depth's curves are shown twice over, and more of them not at all: no reason to give up what is
// shown, unless depth is known to be wrong.
TEST_F(ColourStart, DoubtfulCurvesGiveWayOnlyWhereMoreIsShown) {
  const auto with_what_nothing_shows = [&](DepthCurves depth_curves) {
    result_ = {};
    result_.skeleton = WiresOffBy(0);
    for (const Polyline& wire : kWires) AddTestEdge(result_.skeleton, wire);
    for (int i = 0; i < 25; ++i) {
      const double x = -0.04 + 0.0015 * i;
      AddTestEdge(result_.skeleton, TestLine({x, 0.04, 0}, {x, 0.08, 0}));
    }
    AddPointsBehindWires(0);
    for (int i = 0; i < 3; ++i) AddStrayPoints();
    return StartWithCurves(DefaultBestOptions(), depth_curves).has_value();
  };
  EXPECT_FALSE(with_what_nothing_shows(DepthCurves::kDoubtful));
  EXPECT_TRUE(with_what_nothing_shows(DepthCurves::kMisplaced));
}

TEST_F(ColourStart, NeedsColoursAndAPlaceToLookAt) {
  result_.sequence = scan_.sequence();
  const StageReporter reporter{observer_, log_};
  EXPECT_FALSE(StartFromColour(scan_.sequence(), PoseErrors::kDrift, ColoursOf(scan_.sequence()),
                               DepthCurves::kDoubtful, {}, reporter, result_)
                   .has_value());
  result_.points.Add(Vec3::Zero(), Vec3::UnitZ(), 1);
  EXPECT_FALSE(StartFromColour(scan_.sequence(), PoseErrors::kDrift, {}, DepthCurves::kDoubtful, {},
                               reporter, result_)
                   .has_value());
}

}  // namespace
}  // namespace curvefusion
