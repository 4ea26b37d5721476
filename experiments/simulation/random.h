#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace curvefusion {

/// Spreads 64 bits over 64 bits (the finaliser of splitmix64, Steele et al. 2014).
inline uint64_t HashBits(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// What random numbers are drawn for. Each purpose has its own stream, so that drawing more of one
/// does not change another: a scan with other poses keeps its scene, its motion and its noise.
enum class RandomStream : uint64_t {
  kScene,
  kTexture,
  kMotion,
  kDrift,
  kPattern,
  kSpeckle,
  kDepthNoise,
  kColorNoise,
  kRegistration,
  kShape,      ///< of an object of a family
  kDraw,       ///< of what a random scan is like
  kFurniture,  ///< of the things in a room
  kLight,
  kExposureDrift,
};

/// Random numbers that depend on nothing but seed, stream and index (a frame, say), so that frames
/// can be made in any order and by any number of threads.
class Random {
 public:
  Random(uint64_t seed, RandomStream stream, uint64_t index = 0)
      : state_(HashBits(HashBits(HashBits(seed) + static_cast<uint64_t>(stream)) + index)) {}

  uint64_t Next() { return HashBits(state_++); }

  /// In [0, 1).
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1p-53; }

  /// In [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  /// In [low, high), equally likely in equal ratios.
  double LogUniform(double low, double high) {
    return std::exp(Uniform(std::log(low), std::log(high)));
  }

  /// A whole number from low to high, both included.
  int Integer(int low, int high) {
    return low + static_cast<int>(Next() % static_cast<uint64_t>(high - low + 1));
  }

  /// True with that probability.
  bool Chance(double probability) { return Uniform() < probability; }

  /// Standard normal (Box-Muller).
  double Normal() {
    const double radius = std::sqrt(-2 * std::log(1 - Uniform()));
    return radius * std::cos(2 * std::numbers::pi * Uniform());
  }

 private:
  uint64_t state_;
};

}  // namespace curvefusion
