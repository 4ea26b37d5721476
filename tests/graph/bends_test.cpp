#include "graph/bends.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/angle.h"

namespace curvefusion {
namespace {

constexpr double kTolerance = 0.5 * kMillimetre;

// Draws a wire as a bender would make it, at 1 mm steps: feed, turn, bend.
class Wire {
 public:
  Wire& Feed(double length) {
    const int steps = static_cast<int>(std::lround(length / 1e-3));
    for (int i = 0; i < steps; ++i) Step(length / steps);
    return *this;
  }
  // About the feeding direction.
  Wire& Turn(double angle) {
    axis_ = Eigen::AngleAxisd(angle, direction_) * axis_;
    return *this;
  }
  Wire& BendBy(double angle, double radius) {
    const int steps = radius > 0 ? static_cast<int>(std::ceil(angle * radius / 1e-3)) : 1;
    for (int i = 0; i < steps; ++i) {
      const Eigen::AngleAxisd half(angle / steps / 2, axis_);
      direction_ = half * direction_;
      if (radius > 0) Step(2 * radius * std::sin(angle / steps / 2));
      direction_ = half * direction_;
    }
    return *this;
  }
  const Polyline& points() const { return points_; }

 private:
  void Step(double length) { points_.push_back(points_.back() + length * direction_); }

  Polyline points_ = {Vec3(0.3, 0.2, 0.1)};
  Vec3 direction_ = Vec3::UnitX();
  Vec3 axis_ = Vec3::UnitZ();
};

double Developed(const BendList& list) {
  double length = list.end;
  for (const Bend& bend : list.bends) length += bend.straight + bend.arc;
  return length;
}

TEST(Bends, AStraightWireHasNone) {
  const BendList list = FindBends(Wire().Feed(0.2).points(), kTolerance);
  EXPECT_TRUE(list.bends.empty());
  EXPECT_NEAR(list.end, 0.2, 1e-12);
}

TEST(Bends, SharpCornersAreExact) {
  const Polyline points = Wire()
                              .Feed(0.1)
                              .BendBy(90 * kDegree, 0)
                              .Feed(0.05)
                              .Turn(-120 * kDegree)
                              .BendBy(30 * kDegree, 0)
                              .Feed(0.07)
                              .points();
  const BendList list = FindBends(points, kTolerance);
  ASSERT_EQ(list.bends.size(), 2u);
  EXPECT_NEAR(list.bends[0].straight, 0.1, 1e-9);
  EXPECT_NEAR(list.bends[0].angle, 90 * kDegree, 1e-9);
  EXPECT_EQ(list.bends[0].radius, 0);
  EXPECT_EQ(list.bends[0].rotation, 0);
  EXPECT_NEAR(list.bends[1].straight, 0.05, 1e-9);
  EXPECT_NEAR(list.bends[1].rotation, -120 * kDegree, 1e-9);
  EXPECT_NEAR(list.bends[1].angle, 30 * kDegree, 1e-9);
  EXPECT_NEAR(list.end, 0.07, 1e-9);
}

// A hook of three bends. The angle of an arc is found to 6 degrees and its radius to a quarter: its
// ends are within .5 mm of the straight wire for 4 mm.
TEST(Bends, ArcsHaveRadiusAndAngle) {
  const Polyline points = Wire()
                              .Feed(0.1)
                              .BendBy(90 * kDegree, 0.02)
                              .Feed(0.08)
                              .Turn(180 * kDegree)
                              .BendBy(45 * kDegree, 0.05)
                              .Feed(0.06)
                              .Turn(90 * kDegree)
                              .BendBy(180 * kDegree, 0.03)
                              .Feed(0.04)
                              .points();
  const BendList list = FindBends(points, kTolerance);
  ASSERT_EQ(list.bends.size(), 3u);
  const double angles[] = {90, 45, 180};
  const double radii[] = {0.02, 0.05, 0.03};
  const double rotations[] = {0, 180, 90};
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(list.bends[i].angle, angles[i] * kDegree, 6 * kDegree) << i;
    EXPECT_NEAR(list.bends[i].radius, radii[i], 0.25 * radii[i]) << i;
    EXPECT_NEAR(std::abs(list.bends[i].rotation), rotations[i] * kDegree, 6 * kDegree) << i;
    EXPECT_NEAR(list.bends[i].arc, list.bends[i].angle * list.bends[i].radius, 1e-12) << i;
  }
  EXPECT_GT(list.bends[2].rotation, 0);
  EXPECT_NEAR(Developed(list), Length(points), 1e-9);
}

TEST(Bends, ARingIsOneBend) {
  const Polyline points = Wire().BendBy(360 * kDegree, 0.04).points();
  const BendList list = FindBends(points, kTolerance);
  ASSERT_EQ(list.bends.size(), 1u);
  EXPECT_NEAR(list.bends[0].radius, 0.04, 0.004);
  EXPECT_NEAR(Developed(list), Length(points), 1e-9);
}

}  // namespace
}  // namespace curvefusion
