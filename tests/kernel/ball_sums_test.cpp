#include "kernel/ball_sums.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

TEST(BallSums, AgreeWithBruteForce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  std::vector<Vec3> points(501);  // odd, as are many of the ranges
  std::vector<float> weights;
  for (Vec3& p : points) {
    p = {coordinate(random), coordinate(random), coordinate(random)};
    weights.push_back(static_cast<float>(1 + weights.size() % 7));
  }
  for (const double radius : {0.05, 0.25, 0.8, 5.0}) {
    const BallSums balls(points, weights, radius);
    for (const Vec3& p : points) {
      double sum = 0, squares = 0;
      for (size_t i = 0; i < points.size(); ++i) {
        if ((points[i] - p).norm() > radius) continue;
        sum += weights[i];
        squares += weights[i] * weights[i];
      }
      // Sums of whole numbers are exact.
      EXPECT_EQ(balls.Around(p).weights, sum);
      EXPECT_EQ(balls.Around(p).squares, squares);
    }
  }
}

TEST(BallSums, OfNothingAreZero) {
  const BallSums none({}, {}, 0.01);
  EXPECT_EQ(none.Around(Vec3::Zero()).weights, 0);
  const BallSums one({Vec3::Zero()}, {3}, 0.01);
  EXPECT_EQ(one.Around(Vec3(1, 1, 1)).squares, 0);
  EXPECT_EQ(one.Around(Vec3(0.005, 0, 0)).squares, 9);
}

}  // namespace
}  // namespace curvefusion
