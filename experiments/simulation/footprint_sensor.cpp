#include "experiments/simulation/footprint_sensor.h"

#include <algorithm>
#include <cmath>

#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"

namespace curvefusion {
namespace {

constexpr int kSubRays = 3;      // a pixel's side
constexpr int kSupport = 3;      // half the filter's window
constexpr double kNothing = 50;  // depth of a ray that meets nothing

// Depths on a grid of 3x3 rays a pixel.
Image<float> SubRayDepths(const SceneView& view, const PinholeCamera& camera) {
  Image<float> depths(camera.width * kSubRays, camera.height * kSubRays);
  for (int y = 0; y < depths.height(); ++y) {
    const double v = (y + 0.5) / kSubRays - 0.5;
    for (int x = 0; x < depths.width(); ++x) {
      const double depth = view.Trace((x + 0.5) / kSubRays - 0.5, v).depth;
      depths(x, y) = static_cast<float>(depth > 0 ? depth : kNothing);
    }
  }
  return depths;
}

std::vector<float> FootprintWeights(double sigma_px, int reach) {
  const int side = (2 * reach + 1) * kSubRays;
  std::vector<float> weights;
  for (int k = 0; k < side; ++k) {
    const double offset = (k - side / 2) / (sigma_px * kSubRays);
    weights.push_back(static_cast<float>(std::exp(-offset * offset / 2)));
  }
  return weights;
}

// Weight and mean depth of the rays of a footprint on one side of a depth.
struct Share {
  float weight = 0;
  float weighted_depth = 0;
};

// The mean depth of whichever half of the footprint, near or far, weighs more. Splitting half-way
// between the extremes tells a wire from its background; a smooth surface is averaged as a half,
// which moves its depth by less than the noise.
float DominantDepth(const Image<float>& depths, int u, int v, const std::vector<float>& weights) {
  const int side = static_cast<int>(weights.size());
  const int reach = (side / kSubRays - 1) / 2;
  const int left = (u - reach) * kSubRays;
  const int top = (v - reach) * kSubRays;
  float least = depths(left, top);
  float greatest = least;
  for (int y = 0; y < side; ++y) {
    const auto [low, high] =
        std::minmax_element(depths.row(top + y) + left, depths.row(top + y) + left + side);
    least = std::min(least, *low);
    greatest = std::max(greatest, *high);
  }
  constexpr float kOneSurface = 0.01f;
  if (greatest - least < kOneSurface) {
    return depths(u * kSubRays + kSubRays / 2, v * kSubRays + kSubRays / 2);
  }
  const float split = (least + greatest) / 2;
  Share near_share, far_share;
  for (int y = 0; y < side; ++y) {
    const float* row = depths.row(top + y) + left;
    for (int x = 0; x < side; ++x) {
      const float weight = weights[x] * weights[y];
      Share& share = row[x] < split ? near_share : far_share;
      share.weight += weight;
      share.weighted_depth += weight * row[x];
    }
  }
  const Share& larger = near_share.weight >= far_share.weight ? near_share : far_share;
  return larger.weighted_depth / larger.weight;
}

DepthImage FootprintDepths(const SceneView& view, const FootprintSensorOptions& options) {
  const PinholeCamera& camera = options.camera;
  DepthImage depth(camera.width, camera.height, 0.0f);
  const bool blurred = options.blur_sigma_px > 0;
  const Image<float> sub_rays = blurred ? SubRayDepths(view, camera) : Image<float>();
  const std::vector<float> weights =
      blurred ? FootprintWeights(options.blur_sigma_px, options.footprint_reach_px)
              : std::vector<float>();
  const int border = blurred ? options.footprint_reach_px : 0;
  for (int v = border; v < camera.height - border; ++v) {
    for (int u = border; u < camera.width - border; ++u) {
      depth(u, v) = blurred ? DominantDepth(sub_rays, u, v, weights)
                            : static_cast<float>(view.Trace(u, v).depth);
    }
  }
  return depth;
}

// Drops pixels whose neighbours do not agree with them.
DepthImage Supported(const DepthImage& depth, double share, double tolerance) {
  constexpr int kWindow = (2 * kSupport + 1) * (2 * kSupport + 1);
  DepthImage kept(depth.width(), depth.height(), 0.0f);
  for (int v = kSupport; v < depth.height() - kSupport; ++v) {
    for (int u = kSupport; u < depth.width() - kSupport; ++u) {
      int agree = 0;
      for (int y = v - kSupport; y <= v + kSupport; ++y) {
        for (int x = u - kSupport; x <= u + kSupport; ++x) {
          agree += depth(x, y) > 0 && std::abs(depth(x, y) - depth(u, v)) <= tolerance;
        }
      }
      if (agree >= share * kWindow) kept(u, v) = depth(u, v);
    }
  }
  return kept;
}

// Stereo cameras of the 400 series; focal length in pixels, baseline in metres.
FootprintSensorOptions RealSense400(double focal_length_px, double baseline) {
  constexpr double kDisparitySigma = 0.08;
  FootprintSensorOptions options;
  options.camera = {848, 480, focal_length_px, focal_length_px, 423.5, 239.5};
  options.nearest = 0.2;
  options.farthest = 10;
  options.blur_sigma_px = 1.5;  // its blocks
  options.noise_per_square = kDisparitySigma / (focal_length_px * baseline);
  options.step = 0.001;
  return options;
}

}  // namespace

DepthImage FootprintSensor::Measure(const Scene& scene, const Exposure& exposure) const {
  const SceneView view(scene, options_.camera, exposure.T_world_first, exposure.T_world_last);
  DepthImage depth = FootprintDepths(view, options_);
  Random random(seed_, RandomStream::kDepthNoise, exposure.frame);
  for (size_t i = 0; i < depth.size(); ++i) {
    const double z = depth.data()[i];
    const double noise = random.Normal();
    double measured = z + noise * (options_.noise_sigma + options_.noise_per_square * z * z);
    if (options_.step > 0) measured = std::round(measured / options_.step) * options_.step;
    const bool in_range = z > 0 && measured >= options_.nearest && measured <= options_.farthest;
    depth.data()[i] = in_range ? static_cast<float>(measured) : 0.0f;
  }
  if (options_.support_share == 0) return depth;
  return Supported(depth, options_.support_share, options_.support_tolerance);
}

FootprintSensorOptions IdealSensor() { return {}; }

FootprintSensorOptions RealSenseSr300() {
  FootprintSensorOptions options;
  options.camera = {640, 480, 475, 475, 319.5, 239.5};
  options.nearest = 0.2;
  options.farthest = 1.5;
  options.blur_sigma_px = 0.8;
  options.noise_per_square = 0.004;
  options.step = 0.000125;
  options.support_share = 0.75;
  options.support_tolerance = 0.012;
  return options;
}

FootprintSensorOptions RealSenseD400() { return RealSense400(425, 0.050); }

FootprintSensorOptions RealSenseD455() { return RealSense400(430, 0.095); }

FootprintSensorOptions PhoneLidar() {
  FootprintSensorOptions options;
  options.camera = {256, 192, 212, 212, 127.5, 95.5};
  options.color_scale = 7.5;
  options.nearest = 0.2;
  options.farthest = 5;
  options.working_distance = 0.5;
  options.blur_sigma_px = 4;  // a third of the 11 px between beams
  options.footprint_reach_px = 8;
  options.noise_sigma = 0.004;
  options.step = 0.001;
  return options;
}

FootprintSensorOptions ArtecSpider() {
  FootprintSensorOptions options;
  options.camera = {640, 480, 1667, 1667, 319.5, 239.5};
  options.nearest = 0.2;
  options.farthest = 0.3;
  options.working_distance = 0.25;
  options.blur_sigma_px = 0.5;
  options.noise_sigma = 0.00005;
  return options;
}

}  // namespace curvefusion
