#include "experiments/simulation/color_image.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"
#include "experiments/simulation/gaussian_blur.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"
#include "experiments/simulation/surface_texture.h"

namespace curvefusion {
namespace {

constexpr int kSamples = 4;  // a pixel's side
constexpr size_t kMostMoments = 8;

using LinearImage = Image<Vec3f>;

// The diffuse reflectance of a material at places on it.
class SurfaceColor {
 public:
  explicit SurfaceColor(const SurfaceMaterial& material)
      : color_(material.color),
        contrast_(material.texture_contrast),
        speckle_(14, 5, material.texture_seed),
        tint_(9, 2, material.texture_seed + (uint64_t{1} << 40)) {}

  Vec3 At(const Vec3& p) {
    if (contrast_ == 0) return color_;
    const double gain = 1 + 1.6 * contrast_ * speckle_.At(p);
    const double tint = tint_.At(p);
    const Vec3 hue(1 + 0.35 * tint, 1 - 0.2 * tint, 1 + 0.1 * tint);
    return std::max(gain, 0.05) * color_.cwiseProduct(hue);
  }

 private:
  Vec3 color_;
  double contrast_;
  FractalNoise speckle_;
  FractalNoise tint_;
};

// Deals a pixel's samples out to 1, 2, 4 or 8 moments: as many to each, spread over the pixel.
size_t MomentOf(int column, int row) {
  return static_cast<size_t>((column + row) % kSamples + kSamples * row);
}

class ColorRenderer {
 public:
  ColorRenderer(const Scene& scene, const std::vector<SceneView>& moments)
      : scene_(scene), moments_(moments), colors_(scene.materials.begin(), scene.materials.end()) {}

  Vec3 Pixel(int u, int v) {
    const auto shows_one_plane = [&](const SceneView& view) { return view.IsUniform(u, v); };
    if (std::all_of(moments_.begin(), moments_.end(), shows_one_plane)) return PlanePixel(u, v);
    // Backgrounds are smooth within a pixel: each surface's texture is looked up once a moment.
    std::array<int, kMostMoments> known;
    known.fill(-1);
    std::array<Vec3, kMostMoments> known_color;
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < kSamples * kSamples; ++k) {
      const double su = u + (k % kSamples + 0.5) / kSamples - 0.5;
      const double sv = v + (k / kSamples + 0.5) / kSamples - 0.5;
      const size_t moment = MomentOf(k % kSamples, k / kSamples) % moments_.size();
      const SceneView& view = moments_[moment];
      const SceneRay ray = view.RayThrough(su, sv);
      const RayHit hit = view.Trace(ray);
      const bool wire = hit.primitive >= 0 && view.Surface(hit.primitive) == 0;
      if (wire || hit.primitive != known[moment]) known_color[moment] = Color(view, ray, hit);
      known[moment] = wire ? -1 : hit.primitive;
      sum += known_color[moment];
    }
    return sum / (kSamples * kSamples);
  }

 private:
  Vec3 PlanePixel(int u, int v) {
    Vec3 sum = Vec3::Zero();
    for (const SceneView& view : moments_) {
      const SceneRay ray = view.RayThrough(u, v);
      sum += Color(view, ray, view.Trace(ray));
    }
    return sum / static_cast<double>(moments_.size());
  }

  Vec3 Color(const SceneView& view, const SceneRay& ray, const RayHit& hit) {
    if (hit.primitive < 0) return Vec3::Zero();
    const int surface = view.Surface(hit.primitive);
    const double shininess = scene_.materials[surface].shininess;
    const Vec3 p = ray.At(hit.depth);
    const Vec3 normal = view.Normal(hit.primitive, p);
    Vec3 color = (1 - shininess) * scene_.lighting.Matt(normal) * colors_[surface].At(p);
    if (shininess > 0) {
      const Vec3 to_eye = (ray.center - p).normalized();
      color += Vec3::Constant(shininess * scene_.lighting.Mirrored(normal, to_eye));
    }
    return color;
  }

  const Scene& scene_;
  const std::vector<SceneView>& moments_;
  std::vector<SurfaceColor> colors_;  // of the scene's materials
};

// Through a red-green / green-blue filter mosaic with noise, and back to three channels.
ColorImage Developed(const LinearImage& light, double noise_sigma, Random random) {
  cv::Mat mosaic(light.height(), light.width(), CV_8UC1);
  for (int v = 0; v < light.height(); ++v) {
    for (int u = 0; u < light.width(); ++u) {
      const int channel = (u & 1) + (v & 1);
      const double value = 255 * light(u, v)[channel] + noise_sigma * random.Normal();
      mosaic.at<uint8_t>(v, u) = static_cast<uint8_t>(std::clamp<long>(std::lround(value), 0, 255));
    }
  }
  ColorImage image(light.width(), light.height());
  // OpenCV names a mosaic by its second row's second and third pixel.
  cv::cvtColor(mosaic, MatOf(image), cv::COLOR_BayerBG2RGB);
  return image;
}

// Light as the sensor gets it: less of it in the corners, amplified.
void Expose(const Vec3& gain, double vignetting, LinearImage& light) {
  const Vec2 center((light.width() - 1) / 2.0, (light.height() - 1) / 2.0);
  for (int v = 0; v < light.height(); ++v) {
    for (int u = 0; u < light.width(); ++u) {
      const double shade =
          1 - vignetting * (Vec2(u, v) - center).squaredNorm() / center.squaredNorm();
      light(u, v) = light(u, v).cwiseProduct((shade * gain).cast<float>());
    }
  }
}

}  // namespace

ColorImage RenderColor(const Scene& scene, const ColorShot& shot, const ColorCameraOptions& options,
                       uint64_t seed) {
  assert(std::has_single_bit(shot.moments.size()) && shot.moments.size() <= kMostMoments);
  PinholeCamera camera = options.camera;
  camera.cx += shot.shift_px.x();
  camera.cy += shot.shift_px.y();
  std::vector<SceneView> moments;
  for (const Exposure& moment : shot.moments) {
    moments.emplace_back(scene, camera, moment.T_world_first, moment.T_world_last);
  }
  ColorRenderer renderer(scene, moments);
  LinearImage light(camera.width, camera.height);
  for (int v = 0; v < light.height(); ++v) {
    for (int u = 0; u < light.width(); ++u) light(u, v) = renderer.Pixel(u, v).cast<float>();
  }
  BlurByGaussian(light, options.blur_sigma_px);
  Expose(shot.gain, options.vignetting, light);
  return Developed(light, options.noise_sigma,
                   Random(seed, RandomStream::kColorNoise, shot.moments.front().frame));
}

}  // namespace curvefusion
