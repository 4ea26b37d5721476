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

double Lerp(double a, double b, double t) { return a + t * (b - a); }

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
    const int32_t x = Floor(at.x()), y = Floor(at.y()), z = Floor(at.z());
    if (x != octave.cell[0] || y != octave.cell[1] || z != octave.cell[2]) {
      octave = {octave.seed, {x, y, z}, CornersOf({x, y, z}, octave.seed)};
    }
    const Vec3 share(Smooth(at.x() - x), Smooth(at.y() - y), Smooth(at.z() - z));
    std::array<double, 4> along_x;
    for (size_t k = 0; k < 4; ++k) {
      along_x[k] = Lerp(octave.corners[2 * k], octave.corners[2 * k + 1], share.x());
    }
    const double value = Lerp(Lerp(along_x[0], along_x[1], share.y()),
                              Lerp(along_x[2], along_x[3], share.y()), share.z());
    sum += amplitude * value;
    total += amplitude;
    amplitude *= kFalloff;
    frequency *= 2;
  }
  return sum / total;
}

}  // namespace curvefusion
