#include "experiments/simulation/small_components.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace curvefusion {
namespace {

int Measured(const Image<float>& image) {
  return static_cast<int>(std::count_if(image.data(), image.data() + image.size(),
                                        [](float value) { return value > 0; }));
}

void Fill(Image<float>& image, int u, int v, int width, int height, float value) {
  for (int y = v; y < v + height; ++y) std::fill_n(image.row(y) + u, width, value);
}

// A wall at 40 px of disparity with a speck of 3x3 and a wire of 2x30 before it, 5 px nearer.
Image<float> WallWithSpeckAndWire() {
  Image<float> image(64, 48, 40.0F);
  Fill(image, 10, 10, 3, 3, 45);
  Fill(image, 30, 10, 2, 30, 45);
  return image;
}

TEST(DropSmallComponents, DropsWhatIsSmallerAndKeepsWhatIsLarger) {
  Image<float> image = WallWithSpeckAndWire();
  DropSmallComponents(image, 10, {.step = 1});
  EXPECT_EQ(image(11, 11), 0);
  EXPECT_EQ(image(30, 20), 45);
  EXPECT_EQ(Measured(image), 64 * 48 - 9);
  image = WallWithSpeckAndWire();
  DropSmallComponents(image, 60, {.step = 1});  // the wire has exactly 60
  EXPECT_EQ(image(30, 20), 45);
  DropSmallComponents(image, 61, {.step = 1});
  EXPECT_EQ(image(30, 20), 0);
  EXPECT_EQ(Measured(image), 64 * 48 - 9 - 60);
}

TEST(DropSmallComponents, AStepWithinTheLimitJoins) {
  Image<float> image = WallWithSpeckAndWire();
  DropSmallComponents(image, 100, {.step = 5});
  EXPECT_EQ(Measured(image), 64 * 48);
}

// A ramp is one component although its ends differ by far more than a step.
TEST(DropSmallComponents, ARampIsOneComponent) {
  Image<float> image(60, 4);
  for (int v = 0; v < 4; ++v) {
    for (int u = 0; u < 60; ++u) image(u, v) = 20 + static_cast<float>(u);
  }
  DropSmallComponents(image, 240, {.step = 1});
  EXPECT_EQ(Measured(image), 240);
}

TEST(DropSmallComponents, PixelsThatTouchAtACornerAreApart) {
  Image<float> image(8, 8, 0.0F);
  for (int k = 0; k < 8; ++k) image(k, k) = 30;
  DropSmallComponents(image, 2, {.step = 1});
  EXPECT_EQ(Measured(image), 0);
}

TEST(ComponentSizes, EveryPixelHasItsComponentsSize) {
  const Image<int> sizes = ComponentSizes(WallWithSpeckAndWire(), {.step = 1, .slope = 0.05});
  EXPECT_EQ(sizes(11, 11), 9);  // 5 > 1 + .05 * 40: apart
  EXPECT_EQ(sizes(30, 20), 60);
  EXPECT_EQ(sizes(0, 0), 64 * 48 - 69);
  const Image<int> joined = ComponentSizes(WallWithSpeckAndWire(), {.step = 1, .slope = 0.11});
  EXPECT_EQ(joined(11, 11), 64 * 48);  // 5 < 1 + .11 * 40
}

}  // namespace
}  // namespace curvefusion
