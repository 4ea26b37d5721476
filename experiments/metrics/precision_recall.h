#pragma once

#include <optional>
#include <vector>

namespace curvefusion {

/// Which share of the result is true, and which share of the truth was found. Without a value where
/// there is no result, or no truth, to take a share of.
struct PrecisionRecall {
  std::optional<double> precision;
  std::optional<double> recall;

  /// Their harmonic mean; 0 where only one of them has a value, none where neither has.
  std::optional<double> F() const;
};

/// The share of `weights` whose distance is at most `threshold`; an empty `weights` counts all
/// distances alike. No value for no distances.
std::optional<double> ShareWithin(const std::vector<double>& distances,
                                  const std::vector<double>& weights, double threshold);

/// part / whole, none for a whole of 0.
std::optional<double> ShareOfCount(int part, int whole);

/// The value below which `share` of the values lie, between neighbours interpolated linearly. At
/// least one value. O(n).
double Percentile(std::vector<double> values, double share);

/// The mean, none for no values.
std::optional<double> Mean(const std::vector<double>& values);

}  // namespace curvefusion
