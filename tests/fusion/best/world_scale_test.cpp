#include "fusion/best/world_scale.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

constexpr double kDistance = 0.2;  // metres

// A straight wire seen by one camera whose pixels span .1 mm there.
Reconstruction Wire(double diameter) {
  Reconstruction result;
  const EdgeId edge = result.skeleton.AddPolyline({{-0.05, 0, kDistance}, {0.05, 0, kDistance}});
  const double radius = diameter / 2;
  result.skeleton.SetCurve(edge, result.skeleton.edge(edge).points, {radius, radius}, {});
  result.radii.global_radius = radius;
  result.radii.edges = {{edge, radius, 0.1 * radius, 10, {{0.02, radius}}}};
  result.points.positions = {{0, 0, kDistance}};
  result.points.viewing_rays = {Vec3::UnitZ()};
  result.points.counts = {1};
  result.trust.length = result.trust.wire_length = 0.1;
  result.trust.depth_share = result.trust.measured_share = 1;
  result.sequence.depth_camera = {640, 480, 2000, 2000, 320, 240};
  result.sequence.depth_scale = 5000;
  result.sequence.frames.resize(2);
  result.sequence.frames[0].T_world_camera = RigidTransform::Identity();
  result.sequence.frames[1].T_world_camera =
      Eigen::Translation3d(0.03, 0, 0) * RigidTransform::Identity();
  result.sequence.T_color_depth = Eigen::Translation3d(0.01, 0, 0) * RigidTransform::Identity();
  return result;
}

TEST(WorldScale, MagnifiesFineWiresToUsualOnes) {
  const std::optional<double> magnification = MagnificationFor(Wire(0.001));
  ASSERT_TRUE(magnification);
  EXPECT_NEAR(*magnification, 5, 1e-9);
  EXPECT_FALSE(MagnificationFor(Wire(0.003)));
}

TEST(WorldScale, LeavesWiresThatDepthDoesNotShowFinely) {
  Reconstruction coarse = Wire(0.001);
  coarse.sequence.depth_camera.fx = 200;  // a pixel spans 1 mm
  EXPECT_FALSE(MagnificationFor(coarse));
  Reconstruction hardly_seen = Wire(0.001);
  hardly_seen.trust.depth_share = 0.3;
  EXPECT_FALSE(MagnificationFor(hardly_seen));
  Reconstruction of_colour = Wire(0.001);
  of_colour.trust.from_colour = true;
  EXPECT_FALSE(MagnificationFor(of_colour));
}

TEST(WorldScale, MagnifiesFinePixelsWhereNothingWasFound) {
  Reconstruction nothing = Wire(0.001);
  nothing.skeleton = {};
  ASSERT_TRUE(MagnificationFor(nothing));
  EXPECT_NEAR(*MagnificationFor(nothing), 11, 0.2);
  nothing.sequence.depth_camera.fx = 200;
  EXPECT_FALSE(MagnificationFor(nothing));
}

TEST(WorldScale, AResultReducedIsThatOfTheGivenWorld) {
  const Reconstruction given = Wire(0.001);
  Reconstruction magnified = given;
  ScaleAbout(Vec3::Zero(), 4, magnified);
  magnified.sequence = Magnified(given.sequence, 4);
  EXPECT_NEAR(magnified.skeleton.TotalLength(), 0.4, 1e-12);
  EXPECT_NEAR(magnified.sequence.frames[1].T_world_camera.translation().x(), 0.12, 1e-12);
  EXPECT_NEAR(magnified.sequence.T_color_depth.translation().x(), 0.04, 1e-12);
  EXPECT_NEAR(magnified.sequence.depth_scale, 1250, 1e-9);
  const Reconstruction reduced = Reduced(magnified, 4, given.sequence);
  EXPECT_NEAR(reduced.skeleton.TotalLength(), 0.1, 1e-12);
  EXPECT_NEAR(reduced.skeleton.edge(0).radii[0], 0.0005, 1e-12);
  EXPECT_NEAR(reduced.radii.edges[0].along[0].arc_length, 0.02, 1e-12);
  EXPECT_NEAR((reduced.points.positions[0] - given.points.positions[0]).norm(), 0, 1e-12);
  EXPECT_NEAR(reduced.points.viewing_rays[0].norm(), 1, 1e-12);
  EXPECT_NEAR(reduced.trust.length, 0.1, 1e-12);
  EXPECT_NEAR(reduced.sequence.frames[1].T_world_camera.translation().x(), 0.03, 1e-12);
  EXPECT_EQ(reduced.sequence.depth_scale, 5000);
}

}  // namespace
}  // namespace curvefusion
