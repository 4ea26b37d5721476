#include "kernel/quantile.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace curvefusion {

double Quantile(std::vector<double> values, double share) {
  assert(!values.empty() && share >= 0 && share <= 1);
  const auto rank = static_cast<size_t>(share * static_cast<double>(values.size()));
  const auto ranked =
      values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
  std::nth_element(values.begin(), ranked, values.end());
  return *ranked;
}

double Median(std::vector<double> values) { return Quantile(std::move(values), 0.5); }

double WeightedMedian(std::vector<std::pair<double, double>> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  double half = 0;
  for (const auto& [value, weight] : values) half += weight / 2;
  for (const auto& [value, weight] : values) {
    half -= weight;
    if (half <= 0) return value;
  }
  return values.back().first;
}

double RobustDeviation(std::vector<double> values) {
  if (values.empty()) return 0;
  for (double& value : values) value = std::abs(value);
  return kGaussianMad * Median(std::move(values));
}

}  // namespace curvefusion
