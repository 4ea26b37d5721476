#pragma once

#include <Eigen/Core>
#include <array>

namespace curvefusion {

/// Sums of a weighted least-squares problem of N unknowns: H x = -g has its solution.
template <int N>
class NormalEquations {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;
  using Matrix = Eigen::Matrix<double, N, N>;

  /// Adds a residual with its derivatives and its weight.
  void Add(const float* derivatives, float residual, float weight) {
    int k = 0;
    for (int i = 0; i < N; ++i) {
      const double weighted = weight * derivatives[i];
      for (int j = i; j < N; ++j) upper_[k++] += weighted * derivatives[j];
      gradient_[i] += weighted * residual;
    }
  }

  void Add(const NormalEquations& other) {
    for (size_t i = 0; i < upper_.size(); ++i) upper_[i] += other.upper_[i];
    for (int i = 0; i < N; ++i) gradient_[i] += other.gradient_[i];
  }

  Matrix H() const {
    Matrix h;
    int k = 0;
    for (int i = 0; i < N; ++i) {
      for (int j = i; j < N; ++j) h(i, j) = h(j, i) = upper_[k++];
    }
    return h;
  }

  Vector g() const { return Eigen::Map<const Vector>(gradient_.data()); }

 private:
  std::array<double, static_cast<size_t>(N) * (N + 1) / 2> upper_ = {};
  std::array<double, N> gradient_ = {};
};

/// Added along the diagonal of H, of the greatest there: what no residual holds stays where it is.
/// Chosen: far less than what residuals tell.
inline constexpr double kDamping = 1e-9;

/// Tukey's biweight of a residual over its limit, beyond which it is an outlier.
inline float TukeyWeight(float ratio) {
  const float rest = 1 - ratio * ratio;
  return rest > 0 ? rest * rest : 0;
}

/// Limit over standard deviation that keeps 95 % efficiency on Gaussian errors (Huber 1981).
inline constexpr double kTukeyLimit = 4.685;

}  // namespace curvefusion
