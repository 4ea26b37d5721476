#include "experiments/studies/sensor_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/studies/studies.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

std::set<std::string> Subjects() {
  std::set<std::string> subjects;
  for (const SensorCheck& check : SensorChecks()) subjects.insert(check.measurement.subject);
  return subjects;
}

class SensorChecksOf : public testing::TestWithParam<std::string> {};

// The bands and what they rest on stand in sensor_checks.cpp.
TEST_P(SensorChecksOf, LieInTheirBands) {
  for (const SensorMeasurement& measurement : SensorMeasurements()) {
    std::map<std::string, double> figures;
    for (const SensorCheck& check : SensorChecks()) {
      if (check.measurement.subject != GetParam() || check.measurement != measurement) continue;
      if (figures.empty()) figures = MeasureSensor(measurement, 1);
      const std::string what = check.figure + " at " + std::to_string(measurement.distance) +
                               " m, " + std::to_string(measurement.diameter_mm) +
                               " mm: " + check.source;
      EXPECT_GE(figures.at(check.figure), check.least) << what;
      EXPECT_LE(figures.at(check.figure), check.greatest) << what;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Subjects, SensorChecksOf, testing::ValuesIn(Subjects()),
                         [](const auto& test) { return test.param; });

TEST(SensorChecks, ThePublishedNoiseIsThePublishedOne) {
  EXPECT_NEAR(KhoshelhamSigma(2), 0.0057, 1e-12);
  EXPECT_NEAR(NguyenSigma(1.4), 0.0031, 1e-12);
}

TEST(SensorChecks, BandsAreNotEmpty) {
  for (const SensorCheck& check : SensorChecks()) EXPECT_LT(check.least, check.greatest);
}

TEST(SensorChecks, EachMeasurementStandsOnce) {
  std::vector<SensorMeasurement> all = SensorMeasurements();
  for (size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(std::count(all.begin(), all.end(), all[i]), 1) << i;
  }
}

// Fitted accuracies hold for one length; longer scans drift farther.
TEST(SensorChecks, PoseErrorsGrowWithLength) {
  SensorMeasurement poses{.kind = SensorMeasurement::Kind::kPoses, .subject = "kinfu"};
  poses.frames = 150;
  const double shorter = MeasureSensor(poses, 1).at("ate_mm");
  poses.frames = 900;
  EXPECT_GT(MeasureSensor(poses, 1).at("ate_mm"), 1.5 * shorter);
}

TEST(SensorChecks, UnknownSubjectsAreRefused) {
  EXPECT_THROW(MeasureSensor({.subject = "kinect_v3", .distance = 1}, 1), Error);
}

}  // namespace
}  // namespace curvefusion
