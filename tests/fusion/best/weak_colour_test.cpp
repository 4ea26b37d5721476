#include "fusion/best/weak_colour.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <opencv2/imgcodecs.hpp>

#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

// Eight images of 64x48 pixels, of which nothing but the colours is looked at.
class WeakColour : public testing::Test {
 protected:
  ~WeakColour() override { std::filesystem::remove_all(folder_); }

  Sequence Images(const std::function<cv::Vec3b(int u, int v)>& colour) {
    Sequence sequence;
    sequence.color_camera = {64, 48, 60, 60, 31.5, 23.5};
    cv::Mat image(48, 64, CV_8UC3);
    for (int v = 0; v < 48; ++v) {
      for (int u = 0; u < 64; ++u) image.at<cv::Vec3b>(v, u) = colour(u, v);
    }
    for (int i = 0; i < 8; ++i) {
      sequence.frames.emplace_back();
      sequence.frames.back().color_path = folder_ / fmt::format("{}.png", i);
      cv::imwrite(sequence.frames.back().color_path.string(), image);
    }
    return sequence;
  }

  std::filesystem::path folder_ = [] {
    auto folder = TemporaryPath("weak_colour");
    std::filesystem::create_directories(folder);
    return folder;
  }();
  BestOptions options_ = DefaultBestOptions();
};

uint8_t Stripes(int u) { return u % 16 < 8 ? 60 : 180; }

TEST_F(WeakColour, OfColouredImagesIsNone) {
  const Sequence sequence =
      Images([](int u, int) { return cv::Vec3b(Stripes(u), 100, Stripes(u)); });
  EXPECT_EQ(SwitchOffUselessColour(sequence, options_), "");
  EXPECT_TRUE(options_.colour_adjustment.enabled);
  EXPECT_GT(options_.silhouettes.max_frames, 0);
}

TEST_F(WeakColour, OfGreyImagesStillHasEdges) {
  const Sequence sequence =
      Images([](int u, int) { return cv::Vec3b(Stripes(u), Stripes(u), Stripes(u)); });
  EXPECT_THAT(SwitchOffUselessColour(sequence, options_), HasSubstr("grey"));
  EXPECT_EQ(options_.silhouettes.max_frames, 0);
  EXPECT_GT(options_.segmentation.ghosts.verified_share, 0);
}

TEST_F(WeakColour, OfImagesThatShowNothingVerifiesNothing) {
  const Sequence sequence = Images([](int, int) { return cv::Vec3b(90, 90, 90); });
  EXPECT_THAT(SwitchOffUselessColour(sequence, options_), HasSubstr("depth alone"));
  EXPECT_EQ(options_.segmentation.ghosts.verified_share, 0);
  EXPECT_FALSE(options_.colour_adjustment.enabled);
}

}  // namespace
}  // namespace curvefusion
