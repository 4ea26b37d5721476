#include "experiments/simulation/color_plan.h"

#include <cmath>

#include "experiments/simulation/random.h"

namespace curvefusion {
namespace {

// At twice the resolution a Kinect's has a fifteenth more rows than the depth camera's shape asks
// for.
PinholeCamera Enlarged(const PinholeCamera& small) {
  PinholeCamera camera = small.Scaled(2);
  const int more_rows = camera.height / 15;
  camera.height += more_rows;
  camera.cy += more_rows / 2.0;
  return camera;
}

PinholeCamera OwnCamera(const ColorOptions& options, const PinholeCamera& registered_camera) {
  const double scale = registered_camera.width / 640.0;
  PinholeCamera camera = registered_camera;
  camera.fx = camera.fy = scale * options.focal_length_px;
  camera.cx += scale * options.center_u_px;
  camera.cy += scale * options.center_v_px;
  return camera;
}

// An Ornstein-Uhlenbeck process of variance 1 that has long been running.
class Drift {
 public:
  Drift(double memory, double step, Random& random)
      : keep_(std::exp(-step / memory)), value_(random.Normal()) {}

  double Next(Random& random) {
    const double value = value_;
    value_ = keep_ * value_ + std::sqrt(1 - keep_ * keep_) * random.Normal();
    return value;
  }

 private:
  double keep_;
  double value_;
};

// Exposure follows within a second and a half, white balance within four (chosen).
std::vector<Vec3> Gains(const ColorOptions& options, int frames, double frame_rate, uint64_t seed) {
  Random random(seed, RandomStream::kExposureDrift);
  Drift exposure(1.5, 1 / frame_rate, random);
  Drift red(4, 1 / frame_rate, random);
  Drift blue(4, 1 / frame_rate, random);
  std::vector<Vec3> gains;
  for (int frame = 0; frame < frames; ++frame) {
    const double gain = std::exp2(options.exposure_drift * exposure.Next(random));
    const double red_share = std::exp(options.white_balance_drift * red.Next(random));
    const double blue_share = std::exp(options.white_balance_drift * blue.Next(random));
    gains.emplace_back(gain * red_share, gain, gain * blue_share);
  }
  return gains;
}

}  // namespace

ColorPlan PlanColor(const ColorOptions& options, const PinholeCamera& registered_camera, bool large,
                    int frames, double frame_rate, uint64_t seed) {
  const auto sized = [&](const PinholeCamera& camera) { return large ? Enlarged(camera) : camera; };
  ColorPlan plan;
  plan.told_camera = sized(registered_camera);
  plan.camera.camera = plan.told_camera;
  plan.camera.vignetting = options.vignetting;
  plan.gains = Gains(options, frames, frame_rate, seed);
  if (options.registration == Registration::kRegistered) return plan;
  plan.camera.camera = sized(OwnCamera(options, registered_camera));
  plan.T_depth_color.translation() = Vec3(options.baseline, 0, 0);
  plan.shifts = options.registration == Registration::kCalibrated;
  if (options.registration == Registration::kRaw) return plan;
  plan.told_camera = plan.camera.camera;
  plan.T_told_color_depth = plan.T_depth_color.inverse();
  return plan;
}

}  // namespace curvefusion
