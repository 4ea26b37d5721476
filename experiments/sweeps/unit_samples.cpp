#include "experiments/sweeps/unit_samples.h"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <numeric>
#include <random>

#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

namespace {

using Samples = std::vector<std::vector<double>>;

// Distributions of the standard library differ from one to the next; its engines do not.
double UnitNumber(uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1p-53; }

Samples RandomSamples(int points, int dimensions, std::mt19937_64& random) {
  Samples samples(points, std::vector<double>(dimensions));
  for (auto& point : samples) {
    for (double& x : point) x = UnitNumber(random());
  }
  return samples;
}

// Fisher and Yates; std::shuffle is not the same everywhere.
std::vector<int> Permutation(int count, std::mt19937_64& random) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (int i = count - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
  return order;
}

Samples LatinHypercube(int points, int dimensions, std::mt19937_64& random) {
  Samples samples(points, std::vector<double>(dimensions));
  for (int d = 0; d < dimensions; ++d) {
    const std::vector<int> slices = Permutation(points, random);
    for (int i = 0; i < points; ++i) {
      samples[i][d] = (slices[i] + UnitNumber(random())) / points;
    }
  }
  return samples;
}

Samples SobolSequence(int points, int dimensions, std::mt19937_64& random) {
  std::vector<uint64_t> shift(dimensions);
  for (uint64_t& digits : shift) digits = random();
  boost::random::sobol sequence(dimensions);
  Samples samples(points, std::vector<double>(dimensions));
  for (int i = 0; i < points; ++i) {
    for (int d = 0; d < dimensions; ++d) {
      const uint64_t digits = i == 0 ? 0 : sequence();  // Boost leaves out the origin
      samples[i][d] = UnitNumber(digits ^ shift[d]);
    }
  }
  return samples;
}

}  // namespace

std::vector<std::string> SamplingNames() { return {"random", "latin-hypercube", "sobol"}; }

Sampling SamplingNamed(const std::string& name) {
  const std::vector<std::string> names = SamplingNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<Sampling>(found - names.begin());
  throw Error(ErrorKind::kUsage,
              "there is no sampling " + name + "; did you mean " + NearestName(name, names) + "?");
}

Samples UnitSamples(Sampling sampling, int points, int dimensions, uint64_t seed) {
  std::mt19937_64 random(seed);
  switch (sampling) {
    case Sampling::kRandom:
      return RandomSamples(points, dimensions, random);
    case Sampling::kLatinHypercube:
      return LatinHypercube(points, dimensions, random);
    case Sampling::kSobol:
      return SobolSequence(points, dimensions, random);
  }
  return {};
}

}  // namespace curvefusion
