#include "graph/contraction/density_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace curvefusion {
namespace {

constexpr double kSigma = 0.0035;

ObservedPoints RandomPoints(int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inside(0.95, 1.0);  // away from the origin, as scans are
  ObservedPoints points;
  for (int i = 0; i < count; ++i) {
    points.Add(Vec3(inside(random), inside(random), inside(random)), Vec3::Zero(),
               static_cast<float>(1 + i % 7));
  }
  return points;
}

KernelMoments MomentsByBruteForce(const ObservedPoints& points, const KernelPlace& place) {
  KernelMoments moments;
  Mat3 second = Mat3::Zero();
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 offset = points.positions[i] - place.position;
    const double along = offset.dot(place.direction) / place.stretch;
    const double across = (offset - offset.dot(place.direction) * place.direction).squaredNorm();
    const double t = std::max(0.0, 1 - (across + along * along) / (8 * kSigma * kSigma));
    const double weight = points.counts[i] * std::pow(t, 4);
    moments.weight += weight;
    moments.mean += weight * offset;
    second += weight * offset * offset.transpose();
  }
  moments.mean /= moments.weight;
  moments.covariance = second / moments.weight - moments.mean * moments.mean.transpose();
  return moments;
}

// Sums of floats: seven digits, of offsets up to 20 mm.
constexpr double kTolerance = 1e-5;

void ExpectSame(const KernelMoments& found, const KernelMoments& expected) {
  EXPECT_NEAR(found.weight, expected.weight, kTolerance * expected.weight);
  EXPECT_LT((found.mean - expected.mean).norm(), kTolerance * kSigma);
  EXPECT_LT((found.covariance - expected.covariance).norm(), kTolerance * kSigma * kSigma * 10);
}

TEST(DensityKernel, MomentsAreThoseOfAllPoints) {
  const ObservedPoints points = RandomPoints(4000);
  const DensityField field(points, kSigma);
  DensityField::Neighbours neighbours;
  for (int i = 0; i < 50; ++i) {
    const Vec3& position = points.positions[37 * i];
    const Vec3 direction = Vec3(i % 5 - 2, i % 3, 1).normalized();
    for (const KernelPlace& place :
         {KernelPlace{position, Vec3::Zero(), 1}, KernelPlace{position, direction, 2}}) {
      neighbours.Clear();
      ExpectSame(field.Moments(place, neighbours), MomentsByBruteForce(points, place));
    }
  }
}

TEST(DensityKernel, NeighboursKeptFromPlaceToPlaceAreEnough) {
  const ObservedPoints points = RandomPoints(4000);
  const DensityField field(points, kSigma);
  DensityField::Neighbours neighbours;
  KernelPlace place{Vec3::Constant(0.96), Vec3::UnitX(), 2};
  for (int i = 0; i < 40; ++i) {
    place.position += Vec3(0.0005, 0.0002, 0.0001);
    place.direction = (place.direction + 0.05 * Vec3::UnitY()).normalized();
    // What lies outside of what was gathered is at the kernel's edge, where it weighs 1e-4 at most.
    const KernelMoments expected = MomentsByBruteForce(points, place);
    const KernelMoments found = field.Moments(place, neighbours);
    EXPECT_NEAR(found.weight, expected.weight, 1e-3 * expected.weight);
    EXPECT_LT((found.mean - expected.mean).norm(), 1e-3 * kSigma);
  }
}

TEST(DensityKernel, FarFromAllPointsNothingWeighs) {
  const DensityField field(RandomPoints(10), kSigma);
  DensityField::Neighbours neighbours;
  EXPECT_EQ(field.Moments({Vec3::Zero(), Vec3::Zero(), 1}, neighbours).weight, 0);
  EXPECT_EQ(DensityField({}, kSigma).Moments({Vec3::Zero(), Vec3::Zero(), 1}, neighbours).weight,
            0);
}

}  // namespace
}  // namespace curvefusion
