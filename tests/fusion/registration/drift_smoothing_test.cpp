#include "fusion/registration/drift_smoothing.h"

#include <gtest/gtest.h>

#include <random>

namespace curvefusion {
namespace {

const Vec3 kObject(0.1, -0.2, 0.3);
const Vec3 kCamera = kObject - Vec3(0, 0, 0.7);

RigidTransform Motion(const Vec3& rotation, const Vec3& displacement) {
  RigidTransform T = RigidTransform::Identity();
  if (rotation.norm() > 0) {
    T.linear() = Eigen::AngleAxisd(rotation.norm(), rotation.normalized()).toRotationMatrix();
  }
  T.translation() = kObject + displacement - T.linear() * kObject;
  return T;
}

MeasuredCorrection Measured(const RigidTransform& T, double sigma_rotation,
                            double sigma_translation) {
  MeasuredCorrection correction;
  correction.T_registered_world = T;
  Eigen::Matrix<double, 6, 1> sigma;
  sigma << Vec3::Constant(sigma_rotation), Vec3::Constant(sigma_translation);
  correction.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  correction.center = kObject;
  correction.camera = kCamera;
  return correction;
}

double RotationError(const RigidTransform& a, const RigidTransform& b) {
  return Eigen::AngleAxisd(Mat3((a.inverse() * b).linear())).angle();
}

double PlaceError(const RigidTransform& a, const RigidTransform& b) {
  return (a * kObject - b * kObject).norm();
}

TEST(DriftSmoothing, EqualMeasurementsStayAsTheyAre) {
  const RigidTransform T = Motion({0.01, -0.02, 0.005}, {0.003, 0.001, -0.002});
  const std::vector<MeasuredCorrection> measured(20, Measured(T, 0.005, 0.001));
  for (const RigidTransform& smoothed : SmoothCorrections(measured, {})) {
    // 1e-6 of the drift's information pulls nowhere else than the measurement.
    EXPECT_LT(RotationError(smoothed, T), 1e-9);
    EXPECT_LT(PlaceError(smoothed, T), 1e-9);
  }
}

TEST(DriftSmoothing, NoiseOfSingleFramesIsAveragedAway) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto vector = [&](double sigma) {
    return Vec3(sigma * normal(random), sigma * normal(random), sigma * normal(random));
  };
  DriftOptions options;
  options.points_per_measurement = 1;
  std::vector<MeasuredCorrection> measured;
  for (int f = 0; f < 200; ++f) {
    measured.push_back(Measured(Motion(vector(0.005), vector(0.001)), 0.005, 0.001));
  }
  double rotation = 0, place = 0;
  for (const RigidTransform& T : SmoothCorrections(measured, options)) {
    rotation += RotationError(T, RigidTransform::Identity()) / 200;
    place += PlaceError(T, RigidTransform::Identity()) / 200;
  }
  // Drift of a tenth of the noise a step averages about 20 frames: well under half the noise of a
  // vector, 0.008 and 0.0016; translations drift half as much as they are noisy.
  EXPECT_LT(rotation, 0.5 * 0.008);
  EXPECT_LT(place, 0.8 * 0.0016);
}

TEST(DriftSmoothing, FramesWithoutMeasurementLieBetweenTheirNeighbours) {
  const RigidTransform last = Motion({0, 0, 0.004}, {0.002, 0, 0});
  std::vector<MeasuredCorrection> measured(5);
  for (MeasuredCorrection& correction : measured) correction.camera = kCamera;
  measured.front() = Measured(RigidTransform::Identity(), 1e-6, 1e-6);
  measured.back() = Measured(last, 1e-6, 1e-6);
  const std::vector<RigidTransform> smoothed = SmoothCorrections(measured, {});
  // Equal steps; the measurements are exact to a micrometre, eight in common triple that.
  EXPECT_LT(PlaceError(smoothed[2], Motion({0, 0, 0.002}, {0.001, 0, 0})), 2e-5);
  EXPECT_LT(RotationError(smoothed[2], Motion({0, 0, 0.002}, {0.001, 0, 0})), 2e-5);
  EXPECT_LT(PlaceError(smoothed[4], last), 1e-5);
}

TEST(DriftSmoothing, WhatAMeasurementLeavesOpenFollowsTheOthers) {
  const RigidTransform T = Motion(Vec3::Zero(), {0.002, 0.002, 0.002});
  std::vector<MeasuredCorrection> measured(9, Measured(T, 1e-4, 1e-4));
  MeasuredCorrection& blind = measured[4];
  blind = Measured(Motion(Vec3::Zero(), {0.05, 0.002, 0.002}), 1e-4, 1e-4);
  blind.information.row(3).setZero();  // nothing is known along x
  blind.information.col(3).setZero();
  EXPECT_LT(PlaceError(SmoothCorrections(measured, {})[4], T), 1e-4);
}

TEST(DriftSmoothing, NothingMeasuredAndNoFrames) {
  EXPECT_TRUE(SmoothCorrections({}, {}).empty());
  for (const RigidTransform& T : SmoothCorrections(std::vector<MeasuredCorrection>(3), {})) {
    EXPECT_LT(PlaceError(T, RigidTransform::Identity()), 1e-12);
  }
}

}  // namespace
}  // namespace curvefusion
