#include "graph/contraction/fork_placement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

constexpr double kRadius = 0.15;

// A circle through the origin along x, bent towards y.
Vec3 OnCircle(double arc_length) {
  const double angle = arc_length / kRadius;
  return kRadius * Vec3(std::sin(angle), 1 - std::cos(angle), 0);
}

Vec3 OnFork(double arc_length, double angle) {
  return arc_length * Vec3(std::cos(angle), 0, std::sin(angle));
}

// The fork's branches as seen from a junction that blur has moved `slide` along the circle: the two
// wires are one ridge, half-way between them, until they are 8.5 mm apart.
std::vector<ClearBranch> BlurredFork(double angle, double slide) {
  constexpr double kStep = 0.0015;
  const double clear = 0.0085 / (2 * std::sin(angle / 2)) + 0.002;
  std::vector<ClearBranch> branches(3);
  for (double s = slide; s < 0.055; s += kStep) {
    branches[0].points.push_back(OnCircle(s));
    branches[1].points.push_back(OnCircle(2 * slide - s));
    branches[2].points.push_back(OnFork(s, angle));
    if (s < clear) ++branches[0].first;
    if (s < clear) ++branches[2].first;
  }
  branches[1].first = 6;
  for (ClearBranch& branch : branches) branch.last = branch.points.size();
  return branches;
}

TEST(ForkPosition, CarriesCurvesBackToTheirFork) {
  const auto position = ForkPosition(BlurredFork(0.4, 0.015), 0.025, 0.0035);
  ASSERT_TRUE(position);
  // A parabola leaves a circle of 150 mm by .3 mm over 50 mm, which moves the fork by 1/tan(.4).
  EXPECT_LT(position->norm(), 0.0015);
}

TEST(ForkPosition, LeavesOtherJunctionsAlone) {
  EXPECT_FALSE(ForkPosition(BlurredFork(1.3, 0.002), 0.025, 0.0035));
  std::vector<ClearBranch> apart = BlurredFork(0.4, 0.015);
  for (Vec3& p : apart[2].points) p.y() -= 0.02;
  EXPECT_FALSE(ForkPosition(apart, 0.025, 0.0035));
  apart.pop_back();
  EXPECT_FALSE(ForkPosition(apart, 0.025, 0.0035));
  EXPECT_FALSE(ForkPosition({}, 0.025, 0.0035));
}

TEST(ForkPosition, DoesNotTrustShortStretches) {
  std::vector<ClearBranch> branches = BlurredFork(0.4, 0.015);
  branches[2].last = branches[2].first + 6;
  EXPECT_FALSE(ForkPosition(branches, 0.025, 0.0035));
}

}  // namespace
}  // namespace curvefusion
