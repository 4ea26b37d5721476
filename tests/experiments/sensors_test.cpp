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

TEST(Sensors, EveryNameMakesASensorAndOthersAreRefused) {
  for (const std::string& name : SensorNames()) {
    EXPECT_GT(MakeDepthSensor(name, 1)->camera().width, 0) << name;
  }
  EXPECT_THROW(MakeDepthSensor("kinect_v3", 1), Error);
}

}  // namespace
}  // namespace curvefusion
