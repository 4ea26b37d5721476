#pragma once

#include <utility>
#include <vector>

namespace curvefusion {

/// The value of rank share * size, rounded down, in ascending order; the greatest for a share of 1.
/// 0 <= share <= 1; values must not be empty. Linear.
double Quantile(std::vector<double> values, double share);

/// The middle value, of an even number the greater of the middle two; values must not be empty.
double Median(std::vector<double> values);

/// The least value that, with all smaller ones, has at least half of the weight; pairs of value and
/// weight >= 0, which must not be empty.
double WeightedMedian(std::vector<std::pair<double, double>> values);

/// Standard deviation of a Gaussian over its median absolute deviation.
inline constexpr double kGaussianMad = 1.4826;

/// kGaussianMad times the median of the absolute values: the standard deviation of errors of which
/// fewer than half are outliers; 0 for no values.
double RobustDeviation(std::vector<double> values);

}  // namespace curvefusion
