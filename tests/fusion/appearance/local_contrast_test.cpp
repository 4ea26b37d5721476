#include "fusion/appearance/local_contrast.h"

#include <gtest/gtest.h>

#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr Rgb kGrey = {120, 115, 130};

TEST(LocalContrast, StripsOfAnyColourStandOut) {
  for (const Rgb& colour : {Rgb{240, 240, 240}, Rgb{10, 10, 10}, Rgb{120, 115, 190}}) {
    const ColorImage image = DrawStrip(80, 60, 37.5, 42.5, colour, kGrey, 0.8);
    const PosteriorImage contrast = LocalContrast(image, 5);
    EXPECT_GT(contrast(40, 30), 230);
    EXPECT_LT(contrast(30, 30), 5);
    EXPECT_LT(contrast(50, 30), 5);
  }
}

TEST(LocalContrast, SurfacesAreTheirOwnSurroundings) {
  const ColorImage image = DrawStrip(120, 60, 40, 80, {240, 240, 240}, kGrey, 0.8);
  const PosteriorImage contrast = LocalContrast(image, 5);
  EXPECT_LT(contrast(60, 30), 5);
  EXPECT_LT(contrast(45, 30), 5);
}

// As different as the rest of the image is: as likely texture as a strip.
TEST(LocalContrast, TextureMakesTheSameStripLessLikely) {
  ColorImage image = DrawStrip(80, 60, 37.5, 42.5, {150, 145, 160}, kGrey, 0.8);
  const int plain = LocalContrast(image, 5)(40, 30);
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const int patch = (u / 4 + v / 4) % 2 == 0 ? 25 : -25;
      for (uint8_t& channel : image(u, v)) channel = static_cast<uint8_t>(channel + patch);
    }
  }
  double textured = 0;
  for (int v = 8; v < 52; ++v) textured += LocalContrast(image, 5)(40, v) / 44.0;
  EXPECT_GT(plain, 200);
  EXPECT_LT(textured, 0.6 * plain);
}

}  // namespace
}  // namespace curvefusion
