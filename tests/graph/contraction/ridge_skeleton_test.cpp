#include "graph/contraction/ridge_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <set>
#include <string>

#include "graph/validate.h"
#include "kernel/cloud_io.h"
#include "kernel/parallel.h"
#include "tests/graph/graph_fixtures.h"
#include "tests/graph/noisy_wires.h"
#include "tests/test_data.h"

namespace curvefusion {
namespace {

// Ends lose up to a kernel's width, since only half of it is filled there.
constexpr double kEndLoss = 4e-3;
// Points scatter by 2 mm and about 100 lie in a kernel: .2 mm, three times over; straight lines
// that are continued to junctions and over gaps err up to twice as much.
constexpr double kAxisError = 1.5e-3;

std::vector<Polyline> Spokes(const std::vector<Vec3>& directions, double length) {
  std::vector<Polyline> spokes;
  for (const Vec3& direction : directions) spokes.push_back({{0, 0, 0}, length * direction});
  return spokes;
}

// What every extracted graph must hold, and that it lies on the axes and covers them.
void ExpectOnWires(const SkeletonGraph& graph, const std::vector<Polyline>& axes) {
  EXPECT_NO_THROW(Validate(graph, 1e-6, "ridge skeleton"));
  EXPECT_LT(GreatestDistance(graph, axes), kAxisError);
  EXPECT_LT(GreatestGap(graph, axes), kEndLoss);
}

TEST(ExtractRidgeSkeleton, HelixIsOneOpenCurve) {
  const Polyline axis = TestHelix();
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires({axis}), {});
  EXPECT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(CountDegree(graph, 1), 2);
  ExpectOnWires(graph, {axis});
}

TEST(ExtractRidgeSkeleton, RingIsOneSelfLoop) {
  const Polyline axis = Ring(0.06, 300);
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires({axis}), {});
  ASSERT_EQ(graph.edge_count(), 1);
  EXPECT_EQ(graph.node_count(), 1);
  EXPECT_EQ(graph.CycleRank(), 1);
  ExpectOnWires(graph, {axis});
}

TEST(ExtractRidgeSkeleton, ThreeWiresMeetInOneJunction) {
  const std::vector<Polyline> axes = Spokes({{1, 0, 0}, {-0.5, 0.8, 0.3}, {-0.4, -0.8, 0.4}}, 0.08);
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires(axes), {});
  EXPECT_EQ(graph.edge_count(), 3);
  ASSERT_EQ(CountDegree(graph, 3), 1);
  ExpectOnWires(graph, axes);
  for (const NodeId node : graph.Nodes()) {
    EXPECT_TRUE(graph.Degree(node) != 3 || graph.position(node).norm() < kAxisError);
  }
}

TEST(ExtractRidgeSkeleton, StarOfSixStaysOneJunction) {
  const std::vector<Polyline> axes =
      Spokes({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, 0.08);
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires(axes), {});
  EXPECT_EQ(graph.edge_count(), 6);
  EXPECT_EQ(CountDegree(graph, 6), 1);
  ExpectOnWires(graph, axes);
}

TEST(ExtractRidgeSkeleton, LatticeHasItsJunctionsAndCycles) {
  std::vector<Polyline> axes;
  for (int i = 0; i < 4; ++i) {
    axes.push_back({{0, 0.03 * i, 0}, {0.09, 0.03 * i, 0}});
    axes.push_back({{0.03 * i, 0, 0}, {0.03 * i, 0.09, 0}});
  }
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires(axes), {});
  EXPECT_EQ(graph.CycleRank(), 9);
  EXPECT_EQ(CountDegree(graph, 4), 4);
  EXPECT_EQ(CountDegree(graph, 3), 8);
  EXPECT_EQ(CountDegree(graph, 1), 0);
}

TEST(ExtractRidgeSkeleton, ParallelWiresStayApart) {
  std::vector<Polyline> axes;
  for (int i = 0; i < 5; ++i) axes.push_back({{0, 0.015 * i, 0}, {0.15, 0.015 * i, 0}});
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires(axes), {});
  EXPECT_EQ(graph.edge_count(), 5);
  EXPECT_EQ(graph.ComponentCount(), 5);
  ExpectOnWires(graph, axes);
}

TEST(ExtractRidgeSkeleton, GapIsBridged) {
  const std::vector<Polyline> pieces{{{0, 0, 0}, {0.06, 0, 0}}, {{0.068, 0, 0}, {0.13, 0, 0}}};
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires(pieces), {});
  EXPECT_EQ(graph.edge_count(), 1);
  ExpectOnWires(graph, {{{0, 0, 0}, {0.13, 0, 0}}});
}

TEST(ExtractRidgeSkeleton, ClumpsAreDropped) {
  const Polyline wire{{0, 0, 0}, {0.15, 0, 0}};
  const std::vector<Polyline> all{wire, {{0.05, 0.06, 0}, {0.06, 0.06, 0}}};  // 10 mm long
  const SkeletonGraph graph = ExtractRidgeSkeleton(NoisyWires(all), {});
  EXPECT_EQ(graph.edge_count(), 1);
  ExpectOnWires(graph, {wire});
}

TEST(ExtractRidgeSkeleton, DegenerateInputGivesNothing) {
  EXPECT_TRUE(ExtractRidgeSkeleton({}, {}).empty());
  ObservedPoints points;
  points.Add({1, 2, 3}, {0, 0, 1}, 1);
  EXPECT_TRUE(ExtractRidgeSkeleton(points, {}).empty());
  for (int i = 0; i < 50; ++i) points.Add({1, 2, 3}, {0, 0, 1}, 1);
  EXPECT_TRUE(ExtractRidgeSkeleton(points, {}).empty());
  ObservedPoints not_finite;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 50; ++i) not_finite.Add({0, nan, 0}, {0, 0, 1}, 1);
  EXPECT_TRUE(ExtractRidgeSkeleton(not_finite, {}).empty());
}

TEST(ExtractRidgeSkeleton, PointsThatAreNotFiniteDoNotCount) {
  const ObservedPoints points = NoisyWires(Spokes({{1, 0, 0}, {-0.5, 0.8, 0.3}}, 0.08));
  ObservedPoints more = points;
  more.Add({0, std::numeric_limits<double>::quiet_NaN(), 0}, {0, 0, 1}, 1);
  EXPECT_TRUE(SameBits(ExtractRidgeSkeleton(more, {}), ExtractRidgeSkeleton(points, {})));
}

TEST(ExtractRidgeSkeleton, SameBitsForAnyNumberOfThreads) {
  const ObservedPoints points =
      NoisyWires(Spokes({{1, 0, 0}, {-0.5, 0.8, 0.3}, {-0.4, -0.8, 0.4}}, 0.08));
  const auto extract = [&points](int threads) {
    const ThreadLimit limit(threads);
    return ExtractRidgeSkeleton(points, {});
  };
  EXPECT_TRUE(SameBits(extract(1), extract(2)));
}

// The shared clouds of 5 mm wires seen from one side: millimetres, without rays; the camera is on
// average where this unit vector points from the object.
SkeletonGraph SkeletonOfSharedCloud(const std::filesystem::path& path, const Vec3& to_camera) {
  ObservedPoints points = ReadCloud(path);
  for (Vec3& p : points.positions) p *= kMillimetre;
  for (Vec3& ray : points.viewing_rays) ray = -to_camera;
  return ExtractRidgeSkeleton(ShiftAlongRays(points, 0.78 * 2.5e-3), {});
}

// The mean of the surface normals that the files carry points there.
const Vec3 kCageCamera = Vec3(0, -0.954, 0.301).normalized();
const Vec3 kCubeCamera = Vec3(0.017, -0.893, 0.450).normalized();

TEST(ExtractRidgeSkeleton, OneSidedCubeIsRight) {
  const auto path = SharedData("clouds/cubeB.xyz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const SkeletonGraph graph = SkeletonOfSharedCloud(path, kCubeCamera);
  EXPECT_EQ(graph.edge_count(), 12);
  EXPECT_EQ(CountDegree(graph, 3), 8);
  EXPECT_EQ(graph.CycleRank(), 5);
  // A cube of 200 mm from the origin: every vertex lies near two of its six planes.
  for (const EdgeId id : graph.Edges()) {
    for (const Vec3& p : graph.edge(id).points) {
      int planes = 0;
      for (int axis = 0; axis < 3; ++axis) {
        planes += std::min(std::abs(p[axis]), std::abs(p[axis] - 0.2)) < 2e-3;  // F(2 mm) = 1
      }
      EXPECT_GE(planes, 2);
    }
  }
}

TEST(ExtractRidgeSkeleton, OneSidedCageIsRight) {
  const auto path = SharedData("clouds/cageB.xyz");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const SkeletonGraph graph = SkeletonOfSharedCloud(path, kCageCamera);
  EXPECT_EQ(graph.CycleRank(), 37);
  EXPECT_EQ(CountDegree(graph, 3) + CountDegree(graph, 4), 48);
  EXPECT_EQ(CountDegree(graph, 1), 0);
  EXPECT_EQ(graph.ComponentCount(), 1);
}

// Each default lies within its range, and no key appears twice in a section.
TEST(RidgeOptions, DefaultsAreWithinTheirRanges) {
  struct Checker : OptionVisitor {
    void BeginSection(const char* name) override { section = name; }
    void Visit(const OptionInfo& info, double& value) override { Check(info, value); }
    void Visit(const OptionInfo& info, int& value) override { Check(info, value); }
    void Visit(const OptionInfo& info, bool& value) override { Check(info, value); }
    void Check(const OptionInfo& info, double value) {
      EXPECT_GE(value, info.min) << info.name;
      EXPECT_LE(value, info.max) << info.name;
      EXPECT_TRUE(names.insert(section + "." + info.name).second) << info.name;
    }
    std::string section;
    std::set<std::string> names;
  } checker;
  RidgeOptions options;
  VisitOptions(options, checker);
  EXPECT_GT(checker.names.size(), 20U);
}

// Of a wire along x, with depth noise of 6 mm along the rays and its last 8 mm 30 mm too far away:
// the angle at which the curve ends towards or away from the camera.
double AngleAtTheEnd(const RidgeOptions& options) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  ObservedPoints points;
  for (int i = 0; i < 6000; ++i) {
    const double x = 0.00005 * i;
    const double depth = 0.006 * normal(random) + (x > 0.292 ? 0.03 : 0);
    points.Add({x, 0.001 * normal(random), depth}, Vec3::UnitZ(), 1);
  }
  const AffineTransform T_space_world(Eigen::Scaling(1.0, 1.0, 1.0 / 8));
  const SkeletonGraph skeleton = ExtractRidgeSkeleton(points, options, T_space_world);
  EXPECT_EQ(skeleton.edge_count(), 1);
  const Polyline& curve = skeleton.edge(skeleton.Edges().front()).points;
  const std::vector<Vec3> tangents = Tangents(curve);
  const Vec3& end = curve.back().x() > curve.front().x() ? tangents.back() : tangents.front();
  return std::asin(std::abs(end.z()));
}

TEST(ExtractRidgeSkeleton, EndsDoNotTurnAlongTheRays) {
  RidgeOptions options;
  // Straightened .19 rad, what the beginning of the turn leaves; as it is 1.24 rad.
  EXPECT_LT(AngleAtTheEnd(options), 0.3);
  options.free_ends.tip_length = 0;
  EXPECT_GT(AngleAtTheEnd(options), 1.0);
}

}  // namespace
}  // namespace curvefusion
