#include "apps/preview.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "apps/frame_overlay.h"
#include "experiments/pictures/picture_style.h"
#include "experiments/pictures/png.h"
#include "tests/apps/result_fixtures.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

// One upright 200 mm curve where the simulator puts its objects.
SkeletonGraph Upright() {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, -0.1}, {0, 0, 0.1}});
  return graph;
}

int CountOf(const ColorImage& image, const Rgb& color) {
  return static_cast<int>(std::count(image.data(), image.data() + image.size(), color));
}

class Preview : public FiveViews {};

TEST_F(Preview, ShowsTheCurveInItsColour) {
  const ColorImage preview = DrawPreview(Upright(), {}, {}, sequence_, "one curve");
  // Front and side show 200 mm of it over hundreds of pixels, each line several pixels wide.
  EXPECT_GT(CountOf(preview, EdgeColor(0)), 500);
  EXPECT_GT(CountOf(preview, kWhite), static_cast<int>(preview.size() / 3));
}

TEST_F(Preview, WhatIsUncertainAloneIsDrawnInGrey) {
  const ColorImage preview = DrawPreview({}, Upright(), {}, sequence_, "nothing proven");
  EXPECT_EQ(CountOf(preview, EdgeColor(0)), 0);
  const auto grey =
      std::count_if(preview.data(), preview.data() + preview.size(),
                    [](const Rgb& c) { return c[0] == c[1] && c[1] == c[2] && c[0] < 240; });
  EXPECT_GT(grey, 500);
}

TEST_F(Preview, IsTheSameEveryTime) {
  const ColorImage a = DrawPreview(Upright(), {}, {}, sequence_, "one curve");
  const ColorImage b = DrawPreview(Upright(), {}, {}, sequence_, "one curve");
  EXPECT_TRUE(std::equal(a.data(), a.data() + a.size(), b.data()));
}

TEST_F(Preview, IsWrittenAsAPicture) {
  WritePng(Folder() / "preview.png", DrawPreview(Upright(), {}, {}, sequence_, "one curve"));
  EXPECT_GT(fs::file_size(Folder() / "preview.png"), 1000u);
}

TEST_F(Preview, TheChosenFrameSeesTheGraph) {
  for (int i : {0, 1, 3, 4}) sequence_.frames[i].T_world_camera.translation() += Vec3(9, 0, 0);
  EXPECT_EQ(FrameSeeingMost(Upright(), sequence_), 2);
  sequence_.frames.clear();
  EXPECT_EQ(FrameSeeingMost(Upright(), sequence_), -1);
}

TEST_F(Preview, TheFrontViewLooksAlongTheMeanCamera) {
  const Mat3 axes = MeanCameraAxes(sequence_);
  EXPECT_LT((axes * axes.transpose() - Mat3::Identity()).norm(), 1e-12);
  EXPECT_GT(axes.determinant(), 0);
  EXPECT_GT(axes.row(1).dot(Vec3::UnitZ()), 0.8);   // up: the camera looks down by 18 degrees
  EXPECT_LT(axes.row(2).dot(Vec3::UnitY()), -0.8);  // towards the viewer, who stands at -y
}

}  // namespace
}  // namespace curvefusion
