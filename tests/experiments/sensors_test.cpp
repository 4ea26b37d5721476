#include <gtest/gtest.h>

#include "experiments/simulation/depth_sensor.h"
#include "experiments/simulation/sensor_measurements.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

TEST(Sensors, IdealDepthIsExact) {
  const auto sensor = MakeDepthSensor("ideal", 1);
  EXPECT_LT(MeasureWall(*sensor, 1.0).sigma, 1e-6);  // float rounding
  EXPECT_EQ(MeasureRecall(*sensor, {.diameter = 0.004}).recall, 1);
}

TEST(Sensors, TheSpidersGridIsFine) {
  EXPECT_NEAR(0.25 / MakeDepthSensor("artec_spider", 1)->camera().fx, 0.00015, 1e-6);
}

// Wires are far thinner than the distance between its beams, .5 m away.
TEST(Sensors, APhonesDepthShowsNoWires) {
  const auto phone = MakeDepthSensor("phone", 1);
  EXPECT_EQ(MeasureRecall(*phone, {.depth = 0.5, .diameter = 0.006}).recall, 0);
  EXPECT_GT(MeasureWall(*phone, 0.5).valid, 0.85);
  EXPECT_EQ(phone->camera().width * phone->ColorScale(), 1920);
}

TEST(Sensors, AWiderBaselineMakesLessNoise) {
  EXPECT_NEAR(MeasureWall(*MakeDepthSensor("d455", 1), 1.0).sigma /
                  MeasureWall(*MakeDepthSensor("d400", 1), 1.0).sigma,
              425 * 0.050 / (430 * 0.095), 0.02);
}

TEST(Sensors, EveryNameMakesASensorAndOthersAreRefused) {
  for (const std::string& name : SensorNames()) {
    EXPECT_GT(MakeDepthSensor(name, 1)->camera().width, 0) << name;
  }
  EXPECT_THROW(MakeDepthSensor("kinect_v3", 1), Error);
}

}  // namespace
}  // namespace curvefusion
