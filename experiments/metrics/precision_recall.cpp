#include "experiments/metrics/precision_recall.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace curvefusion {

std::optional<double> PrecisionRecall::F() const {
  if (!precision && !recall) return std::nullopt;
  if (!precision || !recall || *precision + *recall <= 0) return 0;
  return 2 * *precision * *recall / (*precision + *recall);
}

std::optional<double> ShareWithin(const std::vector<double>& distances,
                                  const std::vector<double>& weights, double threshold) {
  double within = 0;
  double total = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    const double weight = weights.empty() ? 1 : weights[i];
    total += weight;
    if (distances[i] <= threshold) within += weight;
  }
  if (total <= 0) return std::nullopt;
  return within / total;
}

std::optional<double> ShareOfCount(int part, int whole) {
  if (whole == 0) return std::nullopt;
  return static_cast<double>(part) / whole;
}

double Percentile(std::vector<double> values, double share) {
  assert(!values.empty());
  const double rank = share * static_cast<double>(values.size() - 1);
  const auto below = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), below, values.end());
  if (below + 1 == values.end()) return *below;
  const double above = *std::min_element(below + 1, values.end());
  return *below + (rank - std::floor(rank)) * (above - *below);
}

std::optional<double> Mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace curvefusion
