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

// At 1 m a wire of 5 mm vanishes between flying pixels, one of 8 mm survives.
TEST(Sensors, KinectV2LosesThinWiresToFlyingPixels) {
  const auto sensor = MakeDepthSensor("kinect_v2", 1);
  EXPECT_LT(MeasureRecall(*sensor, {.depth = 1, .diameter = 0.005}).recall, 0.1);
  EXPECT_GT(MeasureRecall(*sensor, {.depth = 1, .diameter = 0.008}).recall, 0.5);
  const WallNoise wall = MeasureWall(*sensor, 1.0);
  EXPECT_LT(std::abs(wall.bias), 0.001);
  EXPECT_LT(wall.sigma, 0.003);  // published: 1 to 2 mm at 1 m
  EXPECT_GT(wall.valid, 0.99);
  EXPECT_GT(MeasureRecall(*sensor, {.depth = 1, .diameter = 0.005}).flying, 0.1);
}

// Published: a standard deviation of at most 17 mm and an error below 11 mm up to 3.5 m (Tolgyessy
// et al. 2021).
TEST(Sensors, AzureKinectErrsAsPublished) {
  const auto sensor = MakeDepthSensor("azure_kinect", 1);
  for (const double z : {1.0, 3.5}) {
    const WallNoise wall = MeasureWall(*sensor, z);
    EXPECT_LT(wall.sigma, 0.017) << z;
    EXPECT_LT(std::abs(wall.bias), 0.011) << z;
    EXPECT_GT(wall.valid, 0.99) << z;
  }
}

// The paper reconstructs a rack of 8 mm with it, but not a bread holder of 5 mm.
TEST(Sensors, Sr300SeesTheRackButNotTheBreadholder) {
  const auto sensor = MakeDepthSensor("sr300", 1);
  EXPECT_LT(MeasureRecall(*sensor, {.depth = 0.7, .diameter = 0.005}).recall, 0.1);
  EXPECT_GT(MeasureRecall(*sensor, {.depth = 0.7, .diameter = 0.008}).recall, 0.5);
  // 4 z^2 mm, and a tenth for the rounding and the sample.
  EXPECT_NEAR(MeasureWall(*sensor, 0.7).sigma, 0.004 * 0.49, 0.0002);
}

TEST(Sensors, D400NoiseFollowsItsDisparity) {
  const auto sensor = MakeDepthSensor("d400", 1);
  // sigma z^2 / (f b) with .08 px, 425 px and 50 mm.
  EXPECT_NEAR(MeasureWall(*sensor, 1.0).sigma, 0.08 / (425 * 0.05), 0.0002);
}

TEST(Sensors, SpiderSeesOneAndAHalfMillimetres) {
  const auto sensor = MakeDepthSensor("artec_spider", 1);
  EXPECT_GT(MeasureRecall(*sensor, {.depth = 0.25, .diameter = 0.0015}).recall, 0.95);
  EXPECT_NEAR(MeasureWall(*sensor, 0.25).sigma, 0.00005, 0.00001);
  EXPECT_NEAR(0.25 / sensor->camera().fx, 0.00015, 1e-6);  // its grid
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
