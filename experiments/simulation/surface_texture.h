#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Fractal value noise in space, -1 to 1: `octaves` octaves from `frequency` cells a metre on, each
/// with twice the frequency and .65 of the amplitude of the one before. Remembers the cells around
/// the last place, so that places side by side cost half: one thread at a time.
class FractalNoise {
 public:
  FractalNoise(double frequency, int octaves, uint64_t seed);

  double At(const Vec3& p);

 private:
  struct Octave {
    uint32_t seed;
    std::array<int32_t, 3> cell;
    std::array<double, 8> corners;  // of that cell
  };

  double frequency_;
  std::vector<Octave> octaves_;
};

}  // namespace curvefusion
