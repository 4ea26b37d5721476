#include "experiments/simulation/time_of_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "experiments/simulation/gaussian_blur.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"

namespace curvefusion {
namespace {

constexpr double kLightSpeed = 299792458;
constexpr std::array<double, 3> kFrequencies = {16e6, 80e6, 120e6};
constexpr double kCommonFrequency = 8e6;  // all three are multiples
constexpr int kSubRays = 7;

using Phasor = std::complex<float>;
using Phasors = std::array<Phasor, 3>;
using PhasorImage = Image<Phasors>;

// What one ray adds: its light, with the phase of the way there and back at each frequency.
Phasors RayPhasors(const Scene& scene, const SceneView& view, const SceneRay& ray,
                   const RayHit& hit) {
  if (hit.primitive < 0) return {};
  const Vec3 p = ray.At(hit.depth);
  const Vec3 to_camera = ray.center - p;
  const double distance = to_camera.norm();
  const SurfaceMaterial& material = scene.materials[view.Surface(hit.primitive)];
  const double cosine = std::max(0.0, view.Normal(hit.primitive, p).dot(to_camera) / distance);
  double reflected = material.infrared_albedo * (1 - material.shininess) * cosine;
  if (material.shininess > 0)
    reflected += material.infrared_albedo * material.shininess * MirrorLobe(cosine);
  const auto amplitude = static_cast<float>(reflected / (distance * distance));
  const double phase = 4 * std::numbers::pi * kCommonFrequency * distance / kLightSpeed;
  const Phasor one(static_cast<float>(std::cos(phase)), static_cast<float>(std::sin(phase)));
  const Phasor two = one * one;
  const Phasor five = two * two * one;
  return {amplitude * two, amplitude * five * five, amplitude * five * five * five};
}

// Of a pixel that shows several things. Those behind the wires are smooth within it: one ray tells
// of each.
Phasors PixelPhasors(const Scene& scene, const SceneView& view, int u, int v) {
  constexpr auto kShare = 1.0f / (kSubRays * kSubRays);
  Phasors sum{};
  Phasors known{};
  int known_primitive = -1;
  for (int k = 0; k < kSubRays * kSubRays; ++k) {
    const SceneRay ray = view.RayThrough(u + (k % kSubRays + 0.5) / kSubRays - 0.5,
                                         v + (k / kSubRays + 0.5) / kSubRays - 0.5);
    const RayHit hit = view.Trace(ray);
    if (hit.primitive < 0) continue;
    const bool wire = view.Surface(hit.primitive) == 0;
    if (wire || hit.primitive != known_primitive) known = RayPhasors(scene, view, ray, hit);
    known_primitive = wire ? -1 : hit.primitive;
    for (int f = 0; f < 3; ++f) sum[f] += kShare * known[f];
  }
  return sum;
}

PhasorImage SumPhasors(const Scene& scene, const SceneView& view, const PinholeCamera& camera) {
  PhasorImage image(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (!view.IsUniform(u, v)) {
        image(u, v) = PixelPhasors(scene, view, u, v);
        continue;
      }
      const SceneRay ray = view.RayThrough(u, v);
      image(u, v) = RayPhasors(scene, view, ray, view.Trace(ray));
    }
  }
  return image;
}

struct FilteredPhasors {
  PhasorImage phasors;
  MaskImage smooth;  // 1 where the phases around a pixel differ little
};

// exp(-5 x) for x from 0 to 1: to a thousandth.
class Decay {
 public:
  Decay() {
    for (int i = 0; i < kSteps; ++i) values_[i] = std::exp(-5 * (i + 0.5f) / kSteps);
  }
  float At(float x) const {
    return values_[std::clamp(static_cast<int>(x * kSteps), 0, kSteps - 1)];
  }

 private:
  static constexpr int kSteps = 4096;
  std::array<float, kSteps> values_;
};

// Joint bilateral filter over 3x3 pixels: neighbours of another phase count less. A pixel whose
// neighbours' phases differ by more than kMaxEdge in sum is an edge. Without light there is no
// phase.
FilteredPhasors FilterPhasors(const PhasorImage& image) {
  constexpr float kMaxEdge = 2.5f;
  constexpr float kKernel[3] = {0.5f, 1.0f, 0.5f};
  static const Decay decay;
  FilteredPhasors filtered{image, MaskImage(image.width(), image.height(), 1)};
  PhasorImage units = image;  // of length 1, or 0 without light
  for (size_t i = 0; i < units.size(); ++i) {
    for (Phasor& phasor : units.data()[i]) {
      if (phasor != Phasor(0)) phasor /= std::sqrt(std::norm(phasor));
    }
  }
  for (int v = 1; v + 1 < image.height(); ++v) {
    for (int u = 1; u + 1 < image.width(); ++u) {
      float edge[3] = {};
      float total[3] = {};
      Phasors sum{};
      for (int k = 0; k < 9; ++k) {
        const int x = u + k % 3 - 1, y = v + k / 3 - 1;
        const float kernel = kKernel[k % 3] * kKernel[k / 3];
        for (int f = 0; f < 3; ++f) {
          const Phasor self = units(u, v)[f], other = units(x, y)[f];
          if (self == Phasor(0) || other == Phasor(0)) continue;
          const float difference =
              0.5f * (1 - (self.real() * other.real() + self.imag() * other.imag()));
          const float weight = kernel * decay.At(difference);
          sum[f] += weight * image(x, y)[f];
          total[f] += weight;
          edge[f] += difference;
        }
      }
      for (int f = 0; f < 3; ++f) {
        if (total[f] > 0) filtered.phasors(u, v)[f] = sum[f] / total[f];
        if (edge[f] >= kMaxEdge) filtered.smooth(u, v) = 0;
      }
    }
  }
  return filtered;
}

// Distance by the slowest phase, refined by the faster ones, each unwrapped next to the one before.
double DistanceOf(const Phasors& phasors) {
  double distance = 0;
  for (int f = 0; f < 3; ++f) {
    const double range = kLightSpeed / (2 * kFrequencies[f]);
    const double phase = std::atan2(phasors[f].imag(), phasors[f].real());
    const double wrapped = range * phase / (2 * std::numbers::pi);
    const double rounds = f == 0 ? (wrapped < 0 ? 1 : 0) : std::round((distance - wrapped) / range);
    distance = wrapped + rounds * range;
  }
  return distance;
}

// Whether a pixel lies between a nearer and a farther neighbour by too much and its brightness is
// uneven: a flying pixel. Thresholds of the driver, in metres.
bool IsEdge(const DepthImage& depth, const Image<float>& brightness, int u, int v) {
  constexpr float kCloseDelta = 0.050f, kFarDelta = 0.030f, kMaxDelta = 0.100f;
  constexpr float kDeviation = 0.05f;
  float least = depth(u, v), greatest = depth(u, v), sum = 0, squares = 0;
  for (int k = 0; k < 9; ++k) {
    const int x = u + k % 3 - 1;
    const int y = v + k / 3 - 1;
    sum += brightness(x, y);
    squares += brightness(x, y) * brightness(x, y);
    if (depth(x, y) == 0) continue;
    least = std::min(least, depth(x, y));
    greatest = std::max(greatest, depth(x, y));
  }
  const float nearer = depth(u, v) - least;
  const float farther = greatest - depth(u, v);
  const float deviation = std::sqrt(std::max(0.0f, squares * 9 - sum * sum)) / sum;
  return deviation >= kDeviation && nearer > kCloseDelta && farther > kFarDelta &&
         std::max(nearer, farther) > kMaxDelta;
}

DepthImage WithoutEdges(const DepthImage& depth, const Image<float>& brightness,
                        const MaskImage& smooth) {
  DepthImage kept = depth;
  for (int v = 1; v + 1 < depth.height(); ++v) {
    for (int u = 1; u + 1 < depth.width(); ++u) {
      if (depth(u, v) == 0) continue;
      if (!smooth(u, v) || IsEdge(depth, brightness, u, v)) kept(u, v) = 0;
    }
  }
  return kept;
}

}  // namespace

DepthImage TimeOfFlightSensor::Measure(const Scene& scene, const Exposure& exposure) const {
  const PinholeCamera& camera = options_.camera;
  const SceneView view(scene, camera, exposure.T_world_first, exposure.T_world_last);
  PhasorImage sums = SumPhasors(scene, view, camera);
  BlurByGaussian(sums, options_.blur_sigma_px);
  Random random(seed_, RandomStream::kDepthNoise, exposure.frame);
  for (size_t i = 0; i < sums.size(); ++i) {
    for (Phasor& phasor : sums.data()[i]) {
      const double real = options_.noise * random.Normal();
      const double imaginary = options_.noise * random.Normal();
      phasor += Phasor(static_cast<float>(real), static_cast<float>(imaginary));
    }
  }
  const FilteredPhasors filtered = FilterPhasors(sums);
  DepthImage depth(camera.width, camera.height);
  Image<float> brightness(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Phasors& phasors = filtered.phasors(u, v);
      const double z = DistanceOf(phasors) / camera.Unproject(u, v, 1).norm();
      depth(u, v) = z < options_.nearest || z > options_.farthest ? 0.0f : static_cast<float>(z);
      brightness(u, v) = std::abs(phasors[0]) + std::abs(phasors[1]) + std::abs(phasors[2]);
    }
  }
  return WithoutEdges(depth, brightness, filtered.smooth);
}

TimeOfFlightOptions AzureKinect() {
  TimeOfFlightOptions options;
  options.camera = {640, 576, 504, 504, 319.5, 287.5};
  options.farthest = 3.86;
  options.color_scale = 640.0 / 504;  // 1280 pixels over 90 degrees: the smallest images it gives
  return options;
}

}  // namespace curvefusion
