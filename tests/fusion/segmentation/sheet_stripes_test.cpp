#include "fusion/segmentation/sheet_stripes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace curvefusion {
namespace {

constexpr int kWidth = 240, kHeight = 160;
constexpr Rgb kGreen{60, 160, 70}, kGrey{120, 110, 115};

ColourGateOptions Asked() {
  ColourGateOptions options;
  options.frames = 1;
  options.max_width = 0.1;
  return options;
}

// One pixel is a millimetre at one metre.
Sequence OneCamera() {
  Sequence sequence;
  sequence.depth_camera = {kWidth, kHeight, 1000, 1000, 119.5, 79.5};
  sequence.color_camera = sequence.depth_camera;
  sequence.T_color_depth = RigidTransform::Identity();
  return sequence;
}

// A board at one metre, all of it in the mask and in a row, of the colours that `is_green` says. It
// begins and ends with a wire, so that nothing looks shifted.
template <typename IsGreen>
WireCandidates Board(const IsGreen& is_green) {
  WireCandidates frame;
  frame.depth = DepthImage(kWidth, kHeight, 1.0f);
  frame.mask = MaskImage(kWidth, kHeight, 0);
  frame.arrays = MaskImage(kWidth / 2, kHeight / 2, 1);
  frame.color = ColorImage(kWidth, kHeight, kGrey);
  for (int v = 30; v < 130; ++v) {
    for (int u = 80; u < 157; ++u) {
      frame.mask(u, v) = 1;
      if (is_green(u, v)) frame.color(u, v) = kGreen;
    }
  }
  return frame;
}

// Wires 5 pixels wide and 8 apart.
bool IsWire(int u, int /*v*/) { return u % 8 < 5; }

bool IsSpot(int u, int v) {
  const uint32_t cell =
      static_cast<uint32_t>(u / 4) * 73856093u ^ static_cast<uint32_t>(v / 4) * 19349669u;
  return (cell >> 4) % 5 < 3;
}

WireColours ColoursOf(const std::vector<WireCandidates>& frames) {
  WireColours colours = LearnWireColours(frames, OneCamera(), Asked());
  SharpenColours(frames, OneCamera(), colours);
  return colours;
}

TEST(SheetStripes, TellHowFarWiresAreApart) {
  const std::vector<WireCandidates> frames = {Board(IsWire)};
  const SheetStripes stripes = MeasureStripes(frames, ColoursOf(frames), OneCamera(), 0.013);
  // Crests are a pixel or two wide, so the next one begins up to one pixel nearer.
  EXPECT_NEAR(stripes.spacing, 0.008, 0.001);
  EXPECT_GT(stripes.share, 0.7);
  EXPECT_NEAR(stripes.width, 0.005, 0.001);  // whole pixels
}

TEST(SheetStripes, AreNoneWhereTheyAreFartherApartThanAsked) {
  const std::vector<WireCandidates> frames = {Board([](int u, int /*v*/) { return u % 16 < 5; })};
  EXPECT_LT(MeasureStripes(frames, ColoursOf(frames), OneCamera(), 0.013).share, 0.1);
}

TEST(SheetStripes, AreNotSpots) {
  const std::vector<WireCandidates> frames = {Board(IsSpot)};
  EXPECT_LT(MeasureStripes(frames, ColoursOf(frames), OneCamera(), 0.013).share, 0.35);
}

TEST(SheetStripes, AreNoneWithoutRows) {
  EXPECT_EQ(MeasureStripes({}, {}, OneCamera(), 0.013).spacing, 0);
  std::vector<WireCandidates> frames = {Board(IsWire)};
  const WireColours colours = ColoursOf(frames);
  frames[0].arrays = MaskImage(kWidth / 2, kHeight / 2, 0);
  EXPECT_EQ(MeasureStripes(frames, colours, OneCamera(), 0.013).share, 0);
}

TEST(ThinToCrests, LeavesTheMiddleOfWires) {
  const std::vector<WireCandidates> frames = {Board(IsWire)};
  WireCandidates thinned = frames[0];
  ThinToCrests(ColoursOf(frames), OneCamera(), thinned);
  int middle = 0, beside = 0;
  for (int v = 40; v < 120; ++v) {
    for (int u = 88; u < 152; ++u) {
      const int offset = std::abs(u % 8 - 2);
      if (offset == 0) middle += thinned.mask(u, v);
      if (offset >= 2) beside += thinned.mask(u, v);
    }
  }
  EXPECT_GE(middle, 0.95 * 80 * 8);
  EXPECT_LE(beside, 0.05 * 80 * 8);
}

TEST(ThinToCrests, LeavesAloneWhatIsInNoRow) {
  std::vector<WireCandidates> frames = {Board(IsWire)};
  const WireColours colours = ColoursOf(frames);
  frames[0].arrays = MaskImage(kWidth / 2, kHeight / 2, 0);
  const MaskImage before = frames[0].mask;
  ThinToCrests(colours, OneCamera(), frames[0]);
  for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(frames[0].mask.data()[i], before.data()[i]);
}

}  // namespace
}  // namespace curvefusion
