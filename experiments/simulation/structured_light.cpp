#include "experiments/simulation/structured_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/simulation/lighting.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"

namespace curvefusion {
namespace {

constexpr double kNearest = 0.4;  // the camera's range
constexpr double kFarthest = 4.0;
constexpr double kNoiseMean = -0.126;  // Landau et al. 2015
constexpr int kFullScale = 1023;
constexpr int kSpeckleSamples = 4096;
constexpr std::array<double, 3> kSubRays = {-1.0 / 3, 0.0, 1.0 / 3};
constexpr int kProjectorMargin = 128;  // pixels the projector sees beyond the camera's left edge

// A Gaussian of sigma .4 px on three taps: the lens.
constexpr float kLensCenter = 0.9192f;
constexpr float kLensSide = 0.0404f;

// Gamma(4.54, 0.196) by Marsaglia and Tsang: how bright one dot is on one surface (Landau et al.
// 2015).
float DrawSpeckle(Random& random) {
  constexpr double kShape = 4.54;
  constexpr double kScale = 0.196;
  const double d = kShape - 1.0 / 3;
  const double c = 1 / std::sqrt(9 * d);
  for (;;) {
    const double x = random.Normal();
    const double v = std::pow(1 + c * x, 3);
    if (v > 0 && std::log(1 - random.Uniform()) < 0.5 * x * x + d - d * v + d * std::log(v)) {
      return static_cast<float>(d * v * kScale);
    }
  }
}

std::vector<float> SpeckleSamples(uint64_t seed) {
  Random random(seed, RandomStream::kSpeckle);
  std::vector<float> samples(kSpeckleSamples);
  for (float& sample : samples) sample = DrawSpeckle(random);
  return samples;
}

// `Neighbor` says which pixel stands beyond an edge: neighbor(-1, size) and neighbor(size, size).
template <class Neighbor>
Image<float> LensBlurred(const Image<float>& image, const Neighbor& neighbor) {
  Image<float> rows(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    const float* in = image.row(v);
    for (int u = 0; u < image.width(); ++u) {
      const float sides = in[neighbor(u - 1, image.width())] + in[neighbor(u + 1, image.width())];
      rows(u, v) = kLensCenter * in[u] + kLensSide * sides;
    }
  }
  Image<float> blurred(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    const float* above = rows.row(neighbor(v - 1, image.height()));
    const float* below = rows.row(neighbor(v + 1, image.height()));
    for (int u = 0; u < image.width(); ++u) {
      blurred(u, v) = kLensCenter * rows(u, v) + kLensSide * (above[u] + below[u]);
    }
  }
  return blurred;
}

int Clamped(int at, int size) { return std::clamp(at, 0, size - 1); }
int Wrapped(int at, int size) { return ((at % size) + size) % size; }

// One tile of the reference, shifted by eighths of a pixel, as the camera would record it: dots,
// pixel area and lens. Correlation does not care for its scale; doubled, its peak is just below 1.
Image<float> ReferenceTile(const DotPattern& pattern, int eighths) {
  Image<float> tile(DotPattern::kWidth, DotPattern::kHeight);
  for (int v = 0; v < tile.height(); ++v) {
    for (int u = 0; u < tile.width(); ++u) {
      double sum = 0;
      for (const double du : kSubRays) {
        for (const double dv : kSubRays) {
          sum += pattern.Light(u + eighths / 8.0 + du, v + dv, [](uint64_t) { return 1.0; });
        }
      }
      tile(u, v) = static_cast<float>(2 * sum / (kSubRays.size() * kSubRays.size()));
    }
  }
  return LensBlurred(tile, Wrapped);
}

BlockMatcher::Pattern ReferencePattern(const DotPattern& pattern) {
  std::vector<Image<float>> tiles;
  for (int eighths = 0; eighths < 8; ++eighths) tiles.push_back(ReferenceTile(pattern, eighths));
  return [tiles = std::move(tiles)](int column, int eighths, int row) {
    const Image<float>& tile = tiles[eighths];
    return std::min(1.0f, tile(Wrapped(column, tile.width()), Wrapped(row, tile.height())));
  };
}

PinholeCamera ProjectorCamera(PinholeCamera camera) {
  camera.width += kProjectorMargin;
  camera.cx += kProjectorMargin;
  return camera;
}

}  // namespace

StructuredLightSensor::StructuredLightSensor(const StructuredLightOptions& options, uint64_t seed)
    : options_(options),
      seed_(seed),
      pattern_(seed),
      speckle_(SpeckleSamples(seed)),
      matcher_(options.camera.width, options.camera.height, ReferencePattern(pattern_),
               options.matching) {}

DepthRange StructuredLightSensor::Range() const { return {kNearest, kFarthest}; }

// One exposure: the scene as the camera sees it and as the projector does, from poses of the same
// moment.
struct StructuredLightSensor::Moment {
  Moment(const Scene& scene, const StructuredLightOptions& options, const Exposure& exposure)
      : frame(exposure.frame),
        camera(scene, options.camera, exposure.T_world_first, exposure.T_world_last),
        projector(scene, ProjectorCamera(options.camera),
                  exposure.T_world_first * Eigen::Translation3d(options.baseline, 0, 0),
                  exposure.T_world_last * Eigen::Translation3d(options.baseline, 0, 0)) {}

  bool IsShadowed(double u_projector, double v, double depth) const {
    return projector.IsHidden(u_projector + kProjectorMargin, v, depth);
  }

  uint64_t frame;
  SceneView camera;
  SceneView projector;
};

// Of the projector's light on a surface.
double StructuredLightSensor::Pattern(int surface, uint64_t frame, double u_projector,
                                      double v) const {
  return pattern_.Light(u_projector, v, [&](uint64_t dot) {
    const uint64_t bits = HashBits(dot * 64 + static_cast<uint64_t>(surface) + (frame << 40));
    return speckle_[bits % kSpeckleSamples];
  });
}

// What reaches the camera of a pattern's light of 1 where a ray hits.
double StructuredLightSensor::Returned(const Scene& scene, const Moment& moment,
                                       const SceneRay& ray, const RayHit& hit, double v) const {
  const Vec3 p = ray.At(hit.depth);
  const Vec3 normal = moment.camera.Normal(hit.primitive, p);
  const Vec3 to_light = moment.projector.Center(v) - p;
  const double distance = to_light.norm();
  const double cosine = normal.dot(to_light) / distance;
  if (cosine <= 0) return 0;
  const SurfaceMaterial& material = scene.materials[moment.camera.Surface(hit.primitive)];
  double reflected = material.infrared_albedo * (1 - material.shininess) * cosine;
  if (material.shininess > 0) {
    const Vec3 half = (to_light / distance + (ray.center - p).normalized()).normalized();
    reflected += material.infrared_albedo * material.shininess * MirrorLobe(normal.dot(half));
  }
  return options_.light_power * reflected * kMillimetre * kMillimetre / (distance * distance);
}

double StructuredLightSensor::RayIntensity(const Scene& scene, const Moment& moment, double u,
                                           double v) const {
  const SceneRay ray = moment.camera.RayThrough(u, v);
  const RayHit hit = moment.camera.Trace(ray);
  if (hit.primitive < 0) return 0;
  const double u_projector = u - options_.camera.fx * options_.baseline / hit.depth;
  const double light = Pattern(moment.camera.Surface(hit.primitive), moment.frame, u_projector, v);
  if (light == 0 || moment.IsShadowed(u_projector, v, hit.depth)) return 0;
  return light * Returned(scene, moment, ray, hit, v);
}

// Of a pixel that shows one face: disparity is linear over it, and what returns hardly varies.
double StructuredLightSensor::FaceIntensity(const Scene& scene, const Moment& moment, int u,
                                            int v) const {
  const SceneRay ray = moment.camera.RayThrough(u, v);
  const RayHit hit = moment.camera.Trace(ray);
  if (hit.primitive < 0) return 0;
  const double returned = Returned(scene, moment, ray, hit, v);
  if (returned == 0) return 0;
  const int surface = moment.camera.Surface(hit.primitive);
  const double scale = options_.camera.fx * options_.baseline;
  const double disparity = scale / hit.depth;
  const Vec2 slope = scale * moment.camera.InverseDepthSlope(ray, hit);
  double light = 0;
  for (const double dv : kSubRays) {
    for (const double du : kSubRays) {
      const double here = disparity + du * slope.x() + dv * slope.y();
      const double u_projector = u + du - here;
      const double part = Pattern(surface, moment.frame, u_projector, v + dv);
      if (part > 0 && !moment.IsShadowed(u_projector, v + dv, scale / here)) light += part;
    }
  }
  return light * returned / (kSubRays.size() * kSubRays.size());
}

Image<float> StructuredLightSensor::Irradiance(const Scene& scene, const Exposure& exposure) const {
  const Moment moment(scene, options_, exposure);
  Image<float> image(options_.camera.width, options_.camera.height);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      if (moment.camera.IsUniform(u, v)) {
        image(u, v) = static_cast<float>(FaceIntensity(scene, moment, u, v));
        continue;
      }
      double sum = 0;
      for (const double dv : kSubRays) {
        for (const double du : kSubRays) sum += RayIntensity(scene, moment, u + du, v + dv);
      }
      image(u, v) = static_cast<float>(sum / (kSubRays.size() * kSubRays.size()));
    }
  }
  return image;
}

IntensityImage StructuredLightSensor::InfraredImage(const Scene& scene,
                                                    const Exposure& exposure) const {
  const Image<float> light = LensBlurred(Irradiance(scene, exposure), Clamped);
  Random random(seed_, RandomStream::kDepthNoise, exposure.frame);
  IntensityImage image(light.width(), light.height());
  for (size_t i = 0; i < image.size(); ++i) {
    const double value = light.data()[i] + kNoiseMean + options_.noise_sigma * random.Normal();
    image.data()[i] = static_cast<int16_t>(std::clamp<long>(std::lround(value), 0, kFullScale));
  }
  return image;
}

DepthImage StructuredLightSensor::Measure(const Scene& scene, const Exposure& exposure) const {
  DepthImage depth = matcher_.Match(InfraredImage(scene, exposure));
  for (size_t i = 0; i < depth.size(); ++i) {
    float& value = depth.data()[i];
    if (value == 0) continue;
    const double metres = options_.camera.fx * options_.baseline / value;
    value = metres < kNearest || metres > kFarthest ? 0.0f : static_cast<float>(metres);
  }
  return depth;
}

}  // namespace curvefusion
