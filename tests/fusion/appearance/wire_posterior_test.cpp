#include "fusion/appearance/wire_posterior.h"

#include <gtest/gtest.h>

#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr Rgb kGreen = {60, 160, 70};
constexpr Rgb kGrey = {120, 115, 130};

uint16_t BinOf(const Rgb& colour) { return BinColours(ColorImage(1, 1, colour))(0, 0); }

TEST(BinColoursTest, CornersOfTheColourCube) {
  EXPECT_EQ(BinOf({0, 0, 0}), 0);
  EXPECT_EQ(BinOf({255, 255, 255}), 24 * 24 * 24 - 1);
  EXPECT_EQ(BinOf({255, 0, 0}), 23 * 24 * 24);
}

TEST(WireColourModelTest, TellsWireFromBackground) {
  WireColourModel model;
  for (int i = 0; i < 100; ++i) model.AddWire(BinOf(kGreen));
  for (int i = 0; i < 900; ++i) model.AddBackground(BinOf(kGrey));
  const std::vector<uint8_t> posterior = model.Posterior();
  EXPECT_GT(posterior[BinOf(kGreen)], 250);
  EXPECT_LT(posterior[BinOf(kGrey)], 5);
  EXPECT_LT(posterior[BinOf({250, 20, 20})], 128);  // never seen
}

// Background outnumbers wire in every image; that must not make wire unlikely.
TEST(WireColourModelTest, AColourOfBothIsUndecided) {
  WireColourModel model;
  for (int i = 0; i < 100; ++i) model.AddWire(BinOf(kGreen));
  for (int i = 0; i < 900; ++i) model.AddBackground(BinOf(kGreen));
  EXPECT_NEAR(model.Posterior()[BinOf(kGreen)], 128, 3);  // 3: what unseen colours are given
}

TEST(WireColourModelTest, EmptyKnowsNoWire) {
  for (const uint8_t value : WireColourModel().Posterior()) EXPECT_LT(value, 128);
}

TEST(ApplyPosteriorTest, TheStripStandsOut) {
  const ColorImage image = DrawStrip(40, 20, 15, 21, kGreen, kGrey, 0.5);
  WireColourModel model;
  model.AddWire(BinOf(kGreen));
  model.AddBackground(BinOf(kGrey));
  const PosteriorImage posterior = ApplyPosterior(BinColours(image), model.Posterior());
  EXPECT_GT(posterior(18, 10), 250);
  EXPECT_LT(posterior(5, 10), 10);
}

}  // namespace
}  // namespace curvefusion
