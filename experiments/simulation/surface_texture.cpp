#include "experiments/simulation/surface_texture.h"

#include "experiments/simulation/floor.h"

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

std::array<double, 8> CornersOf(const std::array<int32_t, 3>& cell, uint32_t seed) {
  std::array<double, 8> corners;
  for (uint32_t corner = 0; corner < 8; ++corner) {
    corners[corner] = LatticeValue(static_cast<uint32_t>(cell[0]) + (corner & 1),
                                   static_cast<uint32_t>(cell[1]) + (corner >> 1 & 1),
                                   static_cast<uint32_t>(cell[2]) + (corner >> 2), seed);
  }
  return corners;
}

double Smooth(double t) { return t * t * (3 - 2 * t); }

}  // namespace

FractalNoise::FractalNoise(double frequency, int octaves, uint64_t seed) : frequency_(frequency) {
  for (int octave = 0; octave < octaves; ++octave) {
    const uint32_t octave_seed = static_cast<uint32_t>(seed >> 16) + 0x9e3779b9u * octave;
    octaves_.push_back({octave_seed, {}, CornersOf({}, octave_seed)});
  }
}

double FractalNoise::At(const Vec3& p) {
  constexpr double kFalloff = 0.65;
  double sum = 0;
  double total = 0;
  double amplitude = 1;
  double frequency = frequency_;
  for (Octave& octave : octaves_) {
    const Vec3 at = frequency * p;
    const std::array<int32_t, 3> cell = {Floor(at.x()), Floor(at.y()), Floor(at.z())};
    if (cell != octave.cell) octave = {octave.seed, cell, CornersOf(cell, octave.seed)};
    double side[3][2];  // weights of the corners below and above along each axis
    for (int axis = 0; axis < 3; ++axis) {
      side[axis][1] = Smooth(at[axis] - cell[axis]);
      side[axis][0] = 1 - side[axis][1];
    }
    double value = 0;
    for (uint32_t corner = 0; corner < 8; ++corner) {
      value += side[0][corner & 1] * side[1][corner >> 1 & 1] * side[2][corner >> 2] *
               octave.corners[corner];
    }
    sum += amplitude * value;
    total += amplitude;
    amplitude *= kFalloff;
    frequency *= 2;
  }
  return sum / total;
}

}  // namespace curvefusion
