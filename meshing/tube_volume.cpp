#include "meshing/tube_volume.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "meshing/tube_capsules.h"

namespace curvefusion {

namespace {

// In [0, 1), the same with every standard library.
double Uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1.0p-53; }

Vec3 RandomPointIn(const TubeCapsule& c, std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * Uniform(random);
  };
  const double length = (c.b - c.a).norm();
  const Vec3 w = length > 0 ? Vec3((c.b - c.a) / length) : Vec3::UnitX();
  const Vec3 u = w.unitOrthogonal();
  while (true) {
    const Vec3 p = c.a + uniform(-c.radius, length + c.radius) * w +
                   uniform(-c.radius, c.radius) * u + uniform(-c.radius, c.radius) * w.cross(u);
    if (c.Distance(p) <= 0) return p;
  }
}

}  // namespace

SampledVolume VolumeOfTubes(const SkeletonGraph& graph, int samples) {
  const CapsuleGrid capsules(CapsulesOf(graph));
  std::vector<double> cumulative;
  double total = 0;
  for (const TubeCapsule& c : capsules.capsules()) cumulative.push_back(total += c.Volume());
  if (cumulative.empty()) return {};
  std::mt19937_64 random(1);
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < samples; ++i) {
    // Stratified over the sum of the volumes.
    const double at = total * (i + Uniform(random)) / samples;
    const auto chosen = static_cast<int>(
        std::upper_bound(cumulative.begin(), cumulative.end() - 1, at) - cumulative.begin());
    const Vec3 p = RandomPointIn(capsules[chosen], random);
    const std::vector<int>& near = capsules.Near(p);
    const auto covering = std::count_if(near.begin(), near.end(),
                                        [&](int k) { return capsules[k].Distance(p) <= 0; });
    const double share = 1.0 / static_cast<double>(std::max<std::ptrdiff_t>(1, covering));
    sum += share;
    squares += share * share;
  }
  const double mean = sum / samples;
  const double variance = squares / samples - mean * mean;
  return {total * mean, std::sqrt(std::max(0.0, variance) / samples) / mean};
}

}  // namespace curvefusion
