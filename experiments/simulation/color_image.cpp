#include "experiments/simulation/color_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"
#include "experiments/simulation/surface_texture.h"

namespace curvefusion {
namespace {

constexpr int kSamples = 4;  // a pixel's side

using LinearImage = Image<Vec3f>;

// A lamp above, to the left and behind the camera, and as much light again from everywhere.
double Shade(const Vec3& normal) {
  static const Vec3 to_lamp = Vec3(-0.45, -0.65, 0.75).normalized();
  return 0.5 + 0.55 * std::max(0.0, normal.dot(to_lamp));
}

Vec3 Textured(const SurfaceMaterial& material, const Vec3& p) {
  if (material.texture_contrast == 0) return material.color;
  const double speckle = FractalNoise(p, 14, 5, material.texture_seed);
  const double tint = FractalNoise(p, 9, 2, material.texture_seed + (uint64_t{1} << 40));
  const double gain = 1 + 1.6 * material.texture_contrast * speckle;
  const Vec3 hue(1 + 0.35 * tint, 1 - 0.2 * tint, 1 + 0.1 * tint);
  return std::max(gain, 0.05) * material.color.cwiseProduct(hue);
}

class ColorRenderer {
 public:
  ColorRenderer(const Scene& scene, const SceneView& view) : scene_(scene), view_(view) {}

  Vec3 Pixel(int u, int v) const {
    if (view_.IsUniform(u, v)) return Color(view_.Trace(u, v), u, v);
    // Backgrounds are smooth within a pixel: each surface's texture is looked up once.
    int known = -1;
    Vec3 known_color;
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < kSamples * kSamples; ++k) {
      const double su = u + (k % kSamples + 0.5) / kSamples - 0.5;
      const double sv = v + (k / kSamples + 0.5) / kSamples - 0.5;
      const RayHit hit = view_.Trace(su, sv);
      const bool wire = hit.primitive >= 0 && view_.Surface(hit.primitive) == 0;
      if (wire || hit.primitive != known) known_color = Color(hit, su, sv);
      known = wire ? -1 : hit.primitive;
      sum += known_color;
    }
    return sum / (kSamples * kSamples);
  }

 private:
  Vec3 Color(const RayHit& hit, double u, double v) const {
    if (hit.primitive < 0) return Vec3::Zero();
    const SurfaceMaterial& material = scene_.materials[view_.Surface(hit.primitive)];
    const Vec3 p = view_.PointAt(u, v, hit.depth);
    const Vec3 normal = view_.Normal(hit.primitive, p);
    Vec3 color = (1 - material.shininess) * Shade(normal) * Textured(material, p);
    if (material.shininess > 0) {
      const Vec3 to_eye = (view_.Center(v) - p).normalized();
      const Vec3 half = (to_eye + Vec3(-0.45, -0.65, 0.75).normalized()).normalized();
      color += Vec3::Constant(0.5 * material.shininess * MirrorLobe(normal.dot(half)));
    }
    return color;
  }

  const Scene& scene_;
  const SceneView& view_;
};

std::vector<float> GaussianTaps(double sigma) {
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> taps;
  double total = 0;
  for (int k = -radius; k <= radius; ++k) total += std::exp(-k * k / (2 * sigma * sigma));
  for (int k = -radius; k <= radius; ++k) {
    taps.push_back(static_cast<float>(std::exp(-k * k / (2 * sigma * sigma)) / total));
  }
  return taps;
}

// One pass of the separable blur: along rows, or along columns.
LinearImage BlurredAlong(const LinearImage& image, const std::vector<float>& taps, int du, int dv) {
  const int radius = static_cast<int>(taps.size()) / 2;
  LinearImage blurred(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      Vec3f sum = Vec3f::Zero();
      for (int k = -radius; k <= radius; ++k) {
        sum += taps[k + radius] * image(std::clamp(u + k * du, 0, image.width() - 1),
                                        std::clamp(v + k * dv, 0, image.height() - 1));
      }
      blurred(u, v) = sum;
    }
  }
  return blurred;
}

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
  cv::Mat pixels(light.height(), light.width(), CV_8UC3, image.data());
  // OpenCV names a mosaic by its second row's second and third pixel.
  cv::cvtColor(mosaic, pixels, cv::COLOR_BayerBG2RGB);
  return image;
}

}  // namespace

ColorImage RenderColor(const Scene& scene, const Exposure& exposure, const Vec2& shift_px,
                       const ColorCameraOptions& options, uint64_t seed) {
  PinholeCamera camera = options.camera;
  camera.cx += shift_px.x();
  camera.cy += shift_px.y();
  const SceneView view(scene, camera, exposure.T_world_first, exposure.T_world_last);
  const ColorRenderer renderer(scene, view);
  LinearImage light(camera.width, camera.height);
  for (int v = 0; v < light.height(); ++v) {
    for (int u = 0; u < light.width(); ++u) light(u, v) = renderer.Pixel(u, v).cast<float>();
  }
  const std::vector<float> taps = GaussianTaps(options.blur_sigma_px);
  light = BlurredAlong(BlurredAlong(light, taps, 1, 0), taps, 0, 1);
  return Developed(light, options.noise_sigma,
                   Random(seed, RandomStream::kColorNoise, exposure.frame));
}

}  // namespace curvefusion
