#include "experiments/simulation/block_matching.h"

#include <gtest/gtest.h>

#include "experiments/simulation/random.h"

namespace curvefusion {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 40;

// Smooth random brightness at any position: noise on a lattice of 2 px, interpolated.
double Brightness(double u, double v) {
  const auto lattice = [](int x, int y) {
    return static_cast<double>(HashBits(static_cast<uint64_t>(x + 1000) * 4096 + y) >> 11) *
           0x1p-53;
  };
  const double x = u / 2 + 500;
  const double y = v / 2;
  const int x0 = static_cast<int>(x);
  const int y0 = static_cast<int>(y);
  const double fx = x - x0;
  const double fy = y - y0;
  return (1 - fy) * ((1 - fx) * lattice(x0, y0) + fx * lattice(x0 + 1, y0)) +
         fy * ((1 - fx) * lattice(x0, y0 + 1) + fx * lattice(x0 + 1, y0 + 1));
}

const BlockMatcher& Matcher() {
  static const BlockMatcher matcher(
      kWidth, kHeight,
      [](int column, int eighths, int row) { return Brightness(column + eighths / 8.0, row); }, {});
  return matcher;
}

IntensityImage ShiftedImage(double disparity) {
  IntensityImage image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      image(u, v) = static_cast<int16_t>(std::lround(900 * Brightness(u - disparity, v)));
    }
  }
  return image;
}

TEST(BlockMatching, FindsEveryEighthOfAPixel) {
  for (const double disparity : {20.0, 33.125, 47.5, 60.875, 100.25}) {
    const Image<float> found = Matcher().Match(ShiftedImage(disparity));
    for (int v = 4; v < kHeight - 4; ++v) {
      for (int u = 4; u < kWidth - 4; ++u) {
        // An eighth: rounding to integers may tip the choice between neighbouring steps.
        ASSERT_NEAR(found(u, v), disparity, 0.126) << u << " " << v;
      }
    }
  }
}

TEST(BlockMatching, BorderAndFlatImageHaveNoDepth) {
  const Image<float> found = Matcher().Match(ShiftedImage(30));
  for (int u = 0; u < kWidth; ++u) {
    EXPECT_EQ(found(u, 3), 0);
    EXPECT_EQ(found(u, kHeight - 4), 0);
  }
  const Image<float> flat = Matcher().Match(IntensityImage(kWidth, kHeight, 100));
  EXPECT_EQ(*std::max_element(flat.data(), flat.data() + flat.size()), 0);
}

TEST(BlockMatching, NoiseAloneDoesNotMatch) {
  Random random(1, RandomStream::kDepthNoise);
  IntensityImage noise(kWidth, kHeight);
  for (size_t i = 0; i < noise.size(); ++i) {
    noise.data()[i] = static_cast<int16_t>(random.Next() % 1024);
  }
  const Image<float> found = Matcher().Match(noise);
  const auto matched = std::count_if(found.data(), found.data() + found.size(),
                                     [](float disparity) { return disparity > 0; });
  // Correlations of 81 samples of noise have sigma .11; the smooth reference makes it about .2, so
  // that the best of 104 passes .5 now and then, and grows. A tenth of all would be a defect.
  EXPECT_LT(matched, kWidth * kHeight / 10);
}

}  // namespace
}  // namespace curvefusion
