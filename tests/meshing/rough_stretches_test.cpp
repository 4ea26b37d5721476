#include "meshing/rough_stretches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "meshing/ball_rings.h"
#include "meshing/self_intersections.h"
#include "meshing/stubs.h"
#include "meshing/watertight.h"

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.003;
constexpr int kSides = 32;

TubeAxis AxisOf(const Polyline& points) {
  return {points, std::vector<double>(points.size(), kRadius)};
}

// A straight wire whose points lie to and fro, .08 radii to either side.
TubeAxis Zigzag() {
  Polyline points;
  for (int i = 0; i <= 40; ++i) {
    points.emplace_back(0.5 * kRadius * i, 0.08 * kRadius * (i % 2 == 0 ? 1 : -1), 0);
  }
  return AxisOf(points);
}

// The tube along the middle of the zigzag, in segments of one radius.
TubePath MiddleOfZigzag() {
  Polyline points;
  for (int i = 0; i <= 20; ++i) points.emplace_back(kRadius * i, 0, 0);
  return {AxisOf(points), false, {}, {0}};
}

// A tube across the tenth segment of that, so that axes pass at a distance.
TubePath Across(double distance) {
  const double x = 9.5 * kRadius;
  return {AxisOf({{x, -0.03, distance}, {x, 0, distance}, {x, 0.03, distance}}), false, {}, {1}};
}

std::vector<TubeAxis> CurvesWith(const TubePath& other) { return {Zigzag(), other.axis}; }

// The distance of a point from the surface of balls, in radii, negative inside.
double Distance(const TubeAxis& balls, const Vec3& p) {
  double nearest = 1e9;
  for (size_t i = 0; i < balls.points.size(); ++i) {
    nearest = std::min(nearest, (p - balls.points[i]).norm() - balls.radii[i]);
  }
  return nearest / kRadius;
}

Ring CircleAt(const Vec3& centre) {
  Ring ring{centre, kRadius, {}};
  for (int k = 0; k < kSides; ++k) {
    const double angle = 2 * kPi * k / kSides;
    ring.offsets.emplace_back(0, kRadius * std::cos(angle), kRadius * std::sin(angle));
  }
  return ring;
}

TEST(FindRoughStretches, NoiseWhereAnotherTubeGrazes) {
  const TubePath other = Across(2 * kRadius);
  const auto balls = FindRoughStretches({MiddleOfZigzag(), other}, CurvesWith(other));
  EXPECT_FALSE(balls[0][9].points.empty());
  EXPECT_TRUE(balls[0][2].points.empty());
  EXPECT_TRUE(balls[0][17].points.empty());
  // The other tube is straight.
  EXPECT_TRUE(balls[1][0].points.empty());
  EXPECT_TRUE(balls[1][1].points.empty());
}

TEST(FindRoughStretches, NoneWhereTubesAreClear) {
  const TubePath other = Across(2.5 * kRadius);
  const auto balls = FindRoughStretches({MiddleOfZigzag(), other}, CurvesWith(other));
  for (const TubeAxis& beside : balls[0]) EXPECT_TRUE(beside.points.empty());
}

// A circle of the tube's own radius: no ray from its axis tells where its surface is.
TEST(FindRoughStretches, NoneInTightBends) {
  Polyline circle;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * kPi * i / 24;
    circle.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), 0);
  }
  const TubePath ring{AxisOf(circle), true, {}, {0}};
  circle.push_back(circle.front());
  const TubePath other{AxisOf({{-0.02, 0, 2 * kRadius}, {0.02, 0, 2 * kRadius}}), false, {}, {1}};
  const auto balls = FindRoughStretches({ring, other}, {AxisOf(circle), other.axis});
  for (const TubeAxis& beside : balls[0]) EXPECT_TRUE(beside.points.empty());
}

TEST(OntoBalls, CornersLieOnTheSurfaceOrAsFarAsAllowed) {
  const TubeAxis balls = SubdivideAxis(Zigzag(), 0.1);
  for (const double x : {4.0, 4.1, 4.25, 4.5}) {
    const Ring ring = OntoBalls(CircleAt({x * kRadius, 0, 0}), balls, 2 * kRadius);
    for (const Vec3& offset : ring.offsets) {
      EXPECT_NEAR(Distance(balls, ring.centre + offset), 0, 1e-9);
    }
    for (const Vec3& offset : OntoBalls(ring, balls, kRadius).offsets) {
      EXPECT_LE(offset.norm(), (1 + 1e-12) * kRadius);
    }
  }
}

TEST(OntoBalls, RaysThatMissLeaveTheRingAsItIs) {
  const Ring ring = CircleAt({1, 0, 0});
  EXPECT_EQ(OntoBalls(ring, Zigzag(), kRadius).offsets, ring.offsets);
}

TEST(RingsBetween, StraightTubesNeedNone) {
  TubeAxis balls;
  for (int i = -20; i <= 40; ++i) balls.points.emplace_back(0.1 * kRadius * i, 0, 0);
  balls.radii.assign(balls.points.size(), kRadius);
  const Ring first = CircleAt(Vec3::Zero());
  const Ring last = CircleAt({2 * kRadius, 0, 0});
  EXPECT_TRUE(RingsBetween(first, last, first, last, balls).empty());
}

// The strips of the tube of a zigzag follow its surface: by .003 radii where rings were to choose
// from, every .05 radii, and by as much again between these.
TEST(SweepRings, FollowsBalls) {
  const TubePath path = MiddleOfZigzag();
  const TubePath other = Across(2 * kRadius);
  const auto balls = FindRoughStretches({path, other}, CurvesWith(other));
  const TubeRings rings = SweepRings(path, kSides, 0.1, balls[0]);
  const TriangleMesh mesh = CloseStub(rings, 0, path.segment_count());
  EXPECT_EQ(ExamineMesh(mesh).Defects(), "");
  EXPECT_TRUE(FindSelfIntersections(mesh, 1).empty());
  const TubeAxis truth = SubdivideAxis(Zigzag(), 0.1);
  for (int ring = rings.ring_of_point[9]; ring < rings.ring_of_point[10]; ++ring) {
    for (int k = 0; k < kSides; ++k) {
      const Vec3 corner = rings.vertices[static_cast<size_t>(ring) * kSides + k].cast<double>();
      const Vec3 next = rings.vertices[static_cast<size_t>(ring + 1) * kSides + k].cast<double>();
      // Corners stand out by .0032 radii, so that the polygon has the circle's area.
      EXPECT_NEAR(Distance(truth, corner), 0.0032, 0.001);
      EXPECT_NEAR(Distance(truth, (corner + next) / 2), 0.0032, 0.007);
    }
  }
}

}  // namespace
}  // namespace curvefusion
