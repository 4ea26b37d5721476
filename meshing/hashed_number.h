#pragma once

#include <cstdint>

namespace curvefusion {

/// A number in [0, 1) that looks random, the same on every machine (SplitMix64).
inline double HashedNumber(uint64_t seed) {
  seed += 0x9e3779b97f4a7c15ULL;
  seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9ULL;
  seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>((seed ^ (seed >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace curvefusion
