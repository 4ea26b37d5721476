#include "capture/decoded_images.h"

#include <gtest/gtest.h>

#include "capture/sequence.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

Image<uint16_t> DepthOf(uint16_t value) { return {4, 2, value}; }

TEST(DecodedImages, AnImageIsDecodedOnce) {
  DecodedImages images;
  int decoded = 0;
  for (int i = 0; i < 3; ++i) {
    const auto image = images.Depth("a", [&] {
      ++decoded;
      return DepthOf(7);
    });
    EXPECT_EQ((*image)(3, 1), 7);
  }
  EXPECT_EQ(decoded, 1);
  EXPECT_EQ(images.bytes(), 4u * 2 * sizeof(uint16_t));
}

TEST(DecodedImages, DepthAndColourOfOneNameAreDifferentImages) {
  DecodedImages images;
  images.Depth("a", [] { return DepthOf(7); });
  const auto color = images.Color("a", [] { return ColorImage(4, 2, Rgb{1, 2, 3}); });
  EXPECT_EQ((*color)(0, 0), (Rgb{1, 2, 3}));
}

TEST(DecodedImages, TheFirstStayWhereThereIsNoRoomForAll) {
  DecodedImages images(2 * 4 * 2 * sizeof(uint16_t));
  int decoded = 0;
  for (int round = 0; round < 2; ++round) {
    for (const char* name : {"a", "b", "c"}) {
      images.Depth(name, [&] {
        ++decoded;
        return DepthOf(1);
      });
    }
  }
  EXPECT_EQ(decoded, 4) << "a and b once, c twice";
  EXPECT_EQ(images.bytes(), 2u * 4 * 2 * sizeof(uint16_t));
}

TEST(DecodedImages, ASequenceThatKeepsItsImagesReadsNoFileTwice) {
  const TemporaryFolder folder;
  WriteTumSequence(folder.path());
  const Sequence given = OpenSequence(folder.path());
  const Sequence keeping = KeepingImages(given);
  const DepthImage depth = LoadDepth(keeping, 1);
  const ColorImage color = LoadColor(keeping, 1);
  std::filesystem::remove(given.frames[1].depth_path);
  std::filesystem::remove(given.frames[1].color_path);
  EXPECT_EQ(LoadDepth(keeping, 1)(5, 7), depth(5, 7));
  EXPECT_EQ(LoadColor(keeping, 1)(3, 3), color(3, 3));
  EXPECT_ANY_THROW(LoadDepth(given, 1));
}

}  // namespace
}  // namespace curvefusion
