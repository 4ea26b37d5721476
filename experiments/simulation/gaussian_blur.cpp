#include "experiments/simulation/gaussian_blur.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace curvefusion {
namespace {

// As far as three sigma.
std::vector<float> GaussianTaps(double sigma) {
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  std::vector<float> taps;
  double total = 0;
  for (int k = -radius; k <= radius; ++k) total += std::exp(-k * k / (2 * sigma * sigma));
  for (int k = -radius; k <= radius; ++k) {
    taps.push_back(static_cast<float>(std::exp(-k * k / (2 * sigma * sigma)) / total));
  }
  return taps;
}

void AddScaled(const float* from, float scale, size_t count, float* sum) {
  for (size_t i = 0; i < count; ++i) sum[i] += scale * from[i];
}

}  // namespace

void BlurByGaussian(float* values, int width, int height, int channels, double sigma_px) {
  const std::vector<float> taps = GaussianTaps(sigma_px);
  const int radius = static_cast<int>(taps.size()) / 2;
  const size_t row_size = static_cast<size_t>(width) * channels;
  std::vector<float> rows(row_size * height, 0.0f);  // blurred along rows
  std::vector<float> row(row_size + static_cast<size_t>(2 * radius) * channels);
  for (int v = 0; v < height; ++v) {
    for (int u = -radius; u < width + radius; ++u) {
      std::copy_n(values + v * row_size + std::clamp(u, 0, width - 1) * channels, channels,
                  row.data() + (u + radius) * channels);
    }
    for (int k = 0; k <= 2 * radius; ++k) {
      AddScaled(row.data() + k * channels, taps[k], row_size, rows.data() + v * row_size);
    }
  }
  std::fill_n(values, rows.size(), 0.0f);
  for (int v = 0; v < height; ++v) {
    for (int k = 0; k <= 2 * radius; ++k) {
      const int other = std::clamp(v + k - radius, 0, height - 1);
      AddScaled(rows.data() + other * row_size, taps[k], row_size, values + v * row_size);
    }
  }
}

}  // namespace curvefusion
