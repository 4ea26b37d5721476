#include "graph/contraction/packed_points.h"

#include <gtest/gtest.h>

#include "tests/graph/contraction/weighted_places.h"

namespace curvefusion {
namespace {

BallSums SumsByBruteForce(const std::vector<Vec3>& positions, const std::vector<float>& weights,
                          const Vec3& center, double radius) {
  BallSums sums;
  for (size_t i = 0; i < positions.size(); ++i) {
    if ((positions[i] - center).squaredNorm() > radius * radius) continue;
    sums.weight += weights[i];
    sums.squared_weight += weights[i] * weights[i];
  }
  return sums;
}

TEST(PackedPoints, SumsAreThoseOfAllPointsInWhateverOrder) {
  const std::vector<Vec3> positions = RandomPlaces(3000, 1);
  const std::vector<float> weights = CountsAsWeights(positions.size());
  const PackedPoints packed(positions, weights, 0.009);
  PackedPoints::Neighbours neighbours;
  double sum = 0;
  for (const double radius : {0.004, 0.009, 0.02}) {
    for (const Vec3& center : RandomPlaces(100, 2)) {
      const BallSums expected = SumsByBruteForce(positions, weights, center, radius);
      const BallSums found = packed.SumsWithin(center, radius, neighbours);
      EXPECT_EQ(found.weight, expected.weight);
      EXPECT_EQ(found.squared_weight, expected.squared_weight);
      sum += found.weight;
    }
  }
  EXPECT_GT(sum, 10000);  // the comparison is not of empty sets
}

TEST(PackedPoints, FarOutliersAreFound) {
  const std::vector<Vec3> positions{{0, 0, 0}, {0.001, 0, 0}, {1e12, 0, 0}};
  const PackedPoints packed(positions, {1, 2, 4}, 0.01);
  PackedPoints::Neighbours neighbours;
  EXPECT_EQ(packed.SumsWithin(positions[0], 0.01, neighbours).weight, 3);
  EXPECT_EQ(packed.SumsWithin(positions[2], 0.01, neighbours).weight, 4);
}

TEST(PackedPoints, EmptySumsAreZero) {
  PackedPoints::Neighbours neighbours;
  const PackedPoints packed({}, {}, 0.01);
  EXPECT_EQ(packed.SumsWithin(Vec3::Zero(), 0.01, neighbours).weight, 0);
}

}  // namespace
}  // namespace curvefusion
