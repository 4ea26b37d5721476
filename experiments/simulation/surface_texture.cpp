#include "experiments/simulation/surface_texture.h"

#include <cmath>

namespace curvefusion {
namespace {

// A lattice value in [-1, 1] (the mixing of MurmurHash3's finaliser on 32 bits).
double LatticeValue(uint32_t x, uint32_t y, uint32_t z, uint32_t seed) {
  uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ z * 0xcb1ab31fu ^ seed;
  h = (h ^ (h >> 16)) * 0x85ebca6bu;
  h = (h ^ (h >> 13)) * 0xc2b2ae35u;
  h ^= h >> 16;
  return static_cast<double>(h) * (2.0 / 4294967295.0) - 1;
}

double Smooth(double t) { return t * t * (3 - 2 * t); }

double ValueNoise(const Vec3& p, uint32_t seed) {
  const Vec3 floor(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
  const double s[3] = {Smooth(p.x() - floor.x()), Smooth(p.y() - floor.y()),
                       Smooth(p.z() - floor.z())};
  uint32_t cell[3];
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = static_cast<uint32_t>(static_cast<int32_t>(floor[axis]));
  }
  double value = 0;
  for (uint32_t corner = 0; corner < 8; ++corner) {
    const uint32_t x = corner & 1, y = corner >> 1 & 1, z = corner >> 2;
    const double weight = (x ? s[0] : 1 - s[0]) * (y ? s[1] : 1 - s[1]) * (z ? s[2] : 1 - s[2]);
    value += weight * LatticeValue(cell[0] + x, cell[1] + y, cell[2] + z, seed);
  }
  return value;
}

}  // namespace

double FractalNoise(const Vec3& p, double frequency, int octaves, uint64_t seed) {
  constexpr double kFalloff = 0.65;
  double value = 0;
  double total = 0;
  double amplitude = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    value += amplitude *
             ValueNoise(frequency * p, static_cast<uint32_t>(seed >> 16) + 0x9e3779b9u * octave);
    total += amplitude;
    amplitude *= kFalloff;
    frequency *= 2;
  }
  return value / total;
}

}  // namespace curvefusion
