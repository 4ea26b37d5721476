#include <gtest/gtest.h>

#include "experiments/simulation/color_image.h"
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

// A plain red wall: mosaic and demosaicing must agree on where red is.
TEST(ColorImage, KeepsColorsThroughTheMosaic) {
  Scene scene = WallAt(1);
  scene.materials[1].color = {0.8, 0.4, 0.1};
  ColorCameraOptions options;
  options.camera = {64, 48, 58, 58, 31.5, 23.5};
  options.noise_sigma = 0;
  const RigidTransform still = RigidTransform::Identity();
  const ColorImage image = RenderColor(scene, {still, still, 0}, Vec2::Zero(), options, 1);
  const Rgb middle = image(32, 24);
  EXPECT_GT(middle[0], middle[1] * 3 / 2);
  EXPECT_GT(middle[1], middle[2] * 3);
  const Rgb corner = image(0, 0);
  EXPECT_EQ(corner, middle);
}

// The middle of a wire appears where the pinhole projects it, moved by the registration error.
TEST(ColorImage, ShiftMovesThePicture) {
  WireTarget target;
  target.diameter = 0.006;
  Scene scene = target.ToScene();
  scene.materials[0].color = Vec3::Ones();
  scene.materials[1].color = Vec3::Zero();
  ColorCameraOptions options;
  options.noise_sigma = 0;
  const RigidTransform still = RigidTransform::Identity();
  for (const double shift : {0.0, 1.5}) {
    const ColorImage image = RenderColor(scene, {still, still, 0}, Vec2(0, shift), options, 1);
    double sum = 0, weighted = 0;
    for (int v = 220; v < 260; ++v) {
      sum += image(320, v)[1];
      weighted += v * image(320, v)[1];
    }
    // A tenth of a pixel: the wire is shaded from above, which moves its centroid a little.
    EXPECT_NEAR(weighted / sum, 239.5 + shift, 0.5);
  }
}

}  // namespace
}  // namespace curvefusion
