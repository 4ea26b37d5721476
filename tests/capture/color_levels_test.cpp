#include "capture/color_levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "capture/png.h"
#include "capture/sequence.h"
#include "kernel/atomic_file.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

constexpr int kWidth = 32;
constexpr int kHeight = 24;

// A fixture sequence whose grey images have this level in pixel (u, v).
Sequence SequenceOf(const std::filesystem::path& folder,
                    const std::function<int(int, int)>& level) {
  WriteTumSequence(folder);
  ColorImage image(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const auto grey = static_cast<uint8_t>(std::clamp(level(u, v), 0, 255));
      image(u, v) = {grey, grey, grey};
    }
  }
  Sequence sequence = OpenSequence(folder);
  for (const SequenceFrame& frame : sequence.frames) {
    WriteBytesAtomically(frame.color_path, EncodePng(image));
  }
  return OpenSequence(folder);
}

int Level(const Sequence& sequence, int u) { return LoadColor(sequence, 0)(u, kHeight / 2)[0]; }

TEST(ColorLevels, DarkImagesGetTheRangeOfUsualOnes) {
  const TemporaryFolder folder;
  const Sequence dark = SequenceOf(folder.path(), [](int u, int) { return 20 + u / 2; });
  EXPECT_NEAR(dark.color_levels.gain, 80.0 / 15, 0.5);
  EXPECT_NEAR(Level(dark, 30) - Level(dark, 2), 75, 8);
  EXPECT_NEAR(Level(dark, 16), 128, 10);
}

TEST(ColorLevels, UsualImagesStayAsStored) {
  const TemporaryFolder folder;
  const Sequence usual = SequenceOf(folder.path(), [](int u, int) { return 60 + 3 * u; });
  EXPECT_EQ(usual.color_levels.gain, 1);
  for (int u = 0; u < kWidth; ++u) EXPECT_EQ(Level(usual, u), 60 + 3 * u);
}

TEST(ColorLevels, NoiseIsNotStretchedBeyondThatOfCameras) {
  const TemporaryFolder folder;
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 2);
  const Sequence noisy = SequenceOf(
      folder.path(), [&](int u, int) { return static_cast<int>(20 + u / 2 + noise(random)); });
  EXPECT_GT(noisy.color_levels.gain, 1.2);
  EXPECT_LT(noisy.color_levels.gain, 1.8);
}

TEST(ColorLevels, ImagesOfOneLevelStayAsTheyAre) {
  const TemporaryFolder folder;
  const Sequence blank = SequenceOf(folder.path(), [](int, int) { return 40; });
  EXPECT_EQ(blank.color_levels.gain, 1);
  EXPECT_EQ(Level(blank, 5), 40);
}

TEST(ColorLevels, NoChannelLeavesTheScale) {
  ColorImage image(2, 1);
  image(0, 0) = {0, 100, 255};
  ApplyLevels({4, 100}, image);
  EXPECT_EQ(image(0, 0), (Rgb{0, 128, 255}));
}

}  // namespace
}  // namespace curvefusion
