#include "experiments/simulation/color_image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "experiments/simulation/color_plan.h"
#include "experiments/simulation/sensor_measurements.h"
#include "kernel/error.h"

namespace curvefusion {
namespace {

// A camera that looks along z from a place on the x axis.
Exposure At(double x) {
  RigidTransform pose = RigidTransform::Identity();
  pose.translation().x() = x;
  return {pose, pose, 0};
}

Scene BrightWires(double angle) {
  WireTarget target;
  target.diameter = 0.006;
  target.angle = angle;
  Scene scene = target.ToScene();
  scene.materials[0].color = Vec3::Ones();
  scene.materials[1].color = Vec3::Zero();
  return scene;
}

// A plain red wall: mosaic and demosaicing must agree on where red is.
TEST(ColorImage, KeepsColorsThroughTheMosaic) {
  Scene scene = WallAt(1);
  scene.materials[1].color = {0.8, 0.4, 0.1};
  ColorCameraOptions options;
  options.camera = {64, 48, 58, 58, 31.5, 23.5};
  options.noise_sigma = 0;
  const ColorImage image = RenderColor(scene, {.moments = {At(0)}}, options, 1);
  const Rgb middle = image(32, 24);
  EXPECT_GT(middle[0], middle[1] * 3 / 2);
  EXPECT_GT(middle[1], middle[2] * 3);
  const Rgb corner = image(0, 0);
  EXPECT_EQ(corner, middle);
}

// The middle of a wire appears where the pinhole projects it, moved by the registration error.
TEST(ColorImage, ShiftMovesThePicture) {
  const Scene scene = BrightWires(0);
  ColorCameraOptions options;
  options.noise_sigma = 0;
  for (const double shift : {0.0, 1.5}) {
    const ColorImage image =
        RenderColor(scene, {.moments = {At(0)}, .shift_px = Vec2(0, shift)}, options, 1);
    double sum = 0, weighted = 0;
    for (int v = 220; v < 260; ++v) {
      sum += image(320, v)[1];
      weighted += v * image(320, v)[1];
    }
    // A tenth of a pixel: the wire is shaded from above, which moves its centroid a little.
    EXPECT_NEAR(weighted / sum, 239.5 + shift, 0.5);
  }
}

// Columns of row 240 around the middle wire, which stands upright: its green as weights.
struct Profile {
  double mean = 0;
  double sigma = 0;
};
Profile ProfileOf(const ColorImage& image) {
  double sum = 0, first = 0, second = 0;
  for (int u = 300; u < 340; ++u) {
    const double weight = image(u, 240)[1];
    sum += weight;
    first += weight * u;
    second += weight * u * u;
  }
  const double mean = first / sum;
  return {mean, std::sqrt(second / sum - mean * mean)};
}

// Eight moments spread over 8 px: a wire becomes wider by a uniform distribution, whose variance is
// 64 / 12 px^2, and stays where it is.
TEST(ColorImage, MomentsBlurAlongTheMotion) {
  const Scene scene = BrightWires(std::numbers::pi / 2);
  ColorCameraOptions options;
  options.noise_sigma = 0;
  const Profile sharp = ProfileOf(RenderColor(scene, {.moments = {At(0)}}, options, 1));
  ColorShot shot;
  const double metres_per_pixel = 0.7 / 580;
  for (int k = 0; k < 8; ++k) shot.moments.push_back(At((k - 3.5) * metres_per_pixel));
  const Profile blurred = ProfileOf(RenderColor(scene, shot, options, 1));
  EXPECT_NEAR(blurred.mean, sharp.mean, 0.1);
  // 5 %: eight moments are not quite uniform, and the picture is rounded to 8 bits.
  const double expected = std::sqrt(sharp.sigma * sharp.sigma + 64.0 / 12);
  EXPECT_NEAR(blurred.sigma, expected, 0.05 * expected);
}

TEST(ColorImage, GainAndVignettingMultiplyTheLight) {
  Scene scene = WallAt(1);
  scene.materials[1].color = Vec3::Constant(0.4);
  ColorCameraOptions options;
  options.noise_sigma = 0;
  const ColorImage plain = RenderColor(scene, {.moments = {At(0)}}, options, 1);
  options.vignetting = 0.5;
  const ColorShot shot = {.moments = {At(0)}, .gain = Vec3(1.2, 1, 0.5)};
  const ColorImage dimmed = RenderColor(scene, shot, options, 1);
  const double level = plain(320, 240)[1];
  // 1.5: rounding, and half a pixel's place in the mosaic.
  EXPECT_NEAR(dimmed(320, 240)[0], 1.2 * level, 1.5);
  EXPECT_NEAR(dimmed(320, 240)[1], level, 1.5);
  EXPECT_NEAR(dimmed(320, 240)[2], 0.5 * level, 1.5);
  EXPECT_NEAR(dimmed(1, 1)[1], 0.5 * level, 1.5);
}

ColorPlan PlanOf(Registration registration) {
  ColorOptions options;
  options.registration = registration;
  return PlanColor(options, PinholeCamera{640, 480, 580, 580, 319.5, 239.5}, false, 10, 30, 1);
}

// Where a point of the depth camera's frame is seen, and where one is told that it is.
Vec2 SeenOff(const ColorPlan& plan, const Vec3& p_depth) {
  const Vec2 seen = plan.camera.camera.Project(plan.T_depth_color.inverse() * p_depth);
  return seen - plan.told_camera.Project(plan.T_told_color_depth * p_depth);
}

TEST(ColorPlan, ToldCamerasAreRightAndRawOnesAreOff) {
  for (const Registration right :
       {Registration::kRegistered, Registration::kExact, Registration::kCalibrated}) {
    EXPECT_LT(SeenOff(PlanOf(right), Vec3(0.1, 0.05, 0.5)).norm(), 1e-9);
  }
  const Vec2 raw = SeenOff(PlanOf(Registration::kRaw), Vec3(0, 0, 0.5));
  EXPECT_NEAR(raw.x(), -525 * 0.025 / 0.5 + 2, 1e-9);  // 26 px, less the centre's 2
  EXPECT_NEAR(raw.y(), -5, 1e-9);
  EXPECT_TRUE(PlanOf(Registration::kCalibrated).shifts);
  EXPECT_FALSE(PlanOf(Registration::kExact).shifts);
}

TEST(ColorPlan, GainsDriftAsMuchAsTheyAreToldTo) {
  const PinholeCamera camera{640, 480, 580, 580, 319.5, 239.5};
  for (const Vec3& gain : PlanColor({}, camera, false, 20, 30, 1).gains) {
    EXPECT_EQ(gain, Vec3(Vec3::Ones()));
  }
  ColorOptions options;
  options.exposure_drift = 0.5;
  constexpr int kFrames = 30000;
  double squares = 0;
  double steps = 0;
  const std::vector<Vec3> gains = PlanColor(options, camera, false, kFrames, 30, 1).gains;
  for (int i = 0; i < kFrames; ++i) {
    squares += std::pow(std::log2(gains[i].y()), 2) / kFrames;
    if (i > 0) steps = std::max(steps, std::abs(std::log2(gains[i].y() / gains[i - 1].y())));
  }
  EXPECT_NEAR(std::sqrt(squares), 0.5, 0.05);  // 1000 s have some 300 independent values: 4 %
  EXPECT_LT(steps, 0.6);                       // no flicker: sigma of a step is .1
}

TEST(Lighting, ASideIsLitOrAllAlike) {
  const Lighting side = MakeLighting(LightKind::kSide, 1);
  const double left = side.Matt(-Vec3::UnitX());
  const double right = side.Matt(Vec3::UnitX());
  EXPECT_GT(std::max(left, right), 2 * std::min(left, right));
  const Lighting diffuse = MakeLighting(LightKind::kDiffuse, 1);
  EXPECT_EQ(diffuse.Matt(Vec3::UnitX()), diffuse.Matt(Vec3::UnitZ()));
  EXPECT_GE(MakeLighting(LightKind::kSeveral, 1).lamps.size(), 2u);
}

TEST(Lighting, AMirrorShowsTheLampWhereItIsReflected) {
  const Lighting lamp;
  const Vec3 to_eye = -Vec3::UnitY();
  const Vec3 half = (to_eye + lamp.lamps.front().direction).normalized();
  EXPECT_GT(lamp.Mirrored(half, to_eye), 1);
  EXPECT_LT(lamp.Mirrored(Vec3::UnitX(), to_eye), 0.01);
}

TEST(Lighting, NamesReadBackAndOthersAreRefused) {
  for (const std::string& name : LightNames()) EXPECT_EQ(LightName(LightOf(name)), name);
  for (const std::string& name : RegistrationNames()) {
    EXPECT_EQ(RegistrationName(RegistrationOf(name)), name);
  }
  EXPECT_THROW(LightOf("candle"), Error);
  EXPECT_THROW(RegistrationOf("rough"), Error);
}

}  // namespace
}  // namespace curvefusion
