#include "graph/contraction/l1_neighbourhood.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/graph/contraction/weighted_places.h"

namespace curvefusion {
namespace {

constexpr double kRadius = 0.009;
constexpr double kSoftening = 0.0003;
constexpr double kSinglePrecision = 1e-5;  // relative: kernels are good to 1e-6

// As Huang et al. 2013 write them.
struct SumsByBruteForce {
  double density = 0;
  double median_weight = 0, repulsion_weight = 0;
  Vec3 median = Vec3::Zero(), repulsion = Vec3::Zero();
  Mat3 covariance = Mat3::Zero();

  SumsByBruteForce(const std::vector<Vec3>& points, const std::vector<float>& weights,
                   const Vec3& place) {
    for (size_t i = 0; i < points.size(); ++i) {
      const Vec3 offset = place - points[i];
      const double d = offset.norm();
      if (d > kRadius) continue;
      const double theta = weights[i] * std::exp(-4 * d * d / (kRadius * kRadius));
      const double softened = std::sqrt(d * d + kSoftening * kSoftening);
      density += theta;
      median_weight += theta / softened;
      median += theta / softened * points[i];
      if (d == 0) continue;
      repulsion_weight += theta / (softened * softened);
      repulsion += theta / (softened * softened) * offset;
      covariance += theta * offset * offset.transpose();
    }
    median /= median_weight;
    repulsion /= repulsion_weight;
  }
};

TEST(L1Neighbourhood, HasTheSumsOfAllPoints) {
  const std::vector<Vec3> points = RandomPlaces(3000, 1);
  const std::vector<float> weights = CountsAsWeights(points.size());
  const L1Neighbourhood around(points, weights, kRadius, kSoftening);
  PackedPoints::Neighbours neighbours;
  for (size_t i = 0; i < 200; ++i) {
    const SumsByBruteForce expected(points, weights, points[i]);
    EXPECT_NEAR(around.DensityAt(points[i], neighbours), expected.density,
                kSinglePrecision * expected.density);
    EXPECT_LT((around.StepToMedian(points[i], neighbours) - expected.median).norm(),
              kSinglePrecision * kRadius);
    const L1Neighbourhood::Repulsion found = around.RepulsionAt(points[i], neighbours);
    EXPECT_LT((found.offset - expected.repulsion).norm(), kSinglePrecision * kRadius);
    EXPECT_LT((found.covariance - expected.covariance).norm(),
              kSinglePrecision * expected.covariance.norm());
  }
}

TEST(L1Neighbourhood, StaysWhereNothingIsAround) {
  const L1Neighbourhood around({Vec3(1, 1, 1)}, {1}, kRadius, kSoftening);
  PackedPoints::Neighbours neighbours;
  const Vec3 far(1 + 1.01 * kRadius, 1, 1);
  EXPECT_EQ(around.DensityAt(far, neighbours), 0);
  EXPECT_EQ(around.StepToMedian(far, neighbours), far);
  // A point alone is not pushed by itself.
  const L1Neighbourhood::Repulsion alone = around.RepulsionAt(Vec3(1, 1, 1), neighbours);
  EXPECT_EQ(alone.offset, Vec3(Vec3::Zero()));
  EXPECT_EQ(alone.covariance, Mat3(Mat3::Zero()));
}

}  // namespace
}  // namespace curvefusion
