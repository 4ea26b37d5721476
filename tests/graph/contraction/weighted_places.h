#pragma once

#include <random>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// In a cube of 5 cm away from the origin, as scans are.
inline std::vector<Vec3> RandomPlaces(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> inside(0.95, 1.0);
  std::vector<Vec3> places;
  for (int i = 0; i < count; ++i) {
    places.emplace_back(inside(random), inside(random), inside(random));
  }
  return places;
}

/// Counts, so that sums of floats are exact.
inline std::vector<float> CountsAsWeights(size_t count) {
  std::vector<float> weights;
  for (size_t i = 0; i < count; ++i) weights.push_back(static_cast<float>(1 + i % 7));
  return weights;
}

}  // namespace curvefusion
