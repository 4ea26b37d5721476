#pragma once

#include <cstdint>

#include "kernel/geometry.h"

namespace curvefusion {

/// Fractal value noise in space, -1 to 1: `octaves` octaves from `frequency` cells a metre on, each
/// with twice the frequency and .65 of the amplitude of the one before.
double FractalNoise(const Vec3& p, double frequency, int octaves, uint64_t seed);

}  // namespace curvefusion
