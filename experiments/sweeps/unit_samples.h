#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace curvefusion {

/// How points are spread over the unit cube.
enum class Sampling {
  kRandom,          ///< independent and uniform
  kLatinHypercube,  ///< one point in each of N equal slices of every axis (McKay et al. 1979)
  kSobol            ///< Sobol sequence with the directions of Joe and Kuo 2008, shifted by digits
};

/// "random", "latin-hypercube", "sobol".
std::vector<std::string> SamplingNames();

/// Throws Error(kUsage) naming the nearest one.
Sampling SamplingNamed(const std::string& name);

/// `points` vectors of `dimensions` numbers in [0, 1); the same seed gives the same on any machine.
/// Every seed shifts a Sobol sequence by its own random digits (exclusive or), which leaves it as
/// even as it is. Up to 3666 dimensions.
std::vector<std::vector<double>> UnitSamples(Sampling sampling, int points, int dimensions,
                                             uint64_t seed);

}  // namespace curvefusion
