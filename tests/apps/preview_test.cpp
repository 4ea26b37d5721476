#include "apps/preview.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "apps/demo_scan.h"
#include "apps/frame_overlay.h"
#include "experiments/pictures/picture_style.h"
#include "experiments/pictures/png.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

// One upright 200 mm curve where the demo's wires are.
SkeletonGraph Upright() {
  SkeletonGraph graph;
  graph.AddPolyline({{0, 0, 0.08}, {0, 0, 0.28}});
  return graph;
}

int CountOf(const ColorImage& image, const Rgb& color) {
  return static_cast<int>(std::count(image.data(), image.data() + image.size(), color));
}

class Preview : public testing::Test {
 protected:
  void SetUp() override {
    WriteDemoScan(folder_, {.frame_count = 5, .width = 160, .height = 120}, NoProgress);
    sequence_ = OpenSequence(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  const fs::path folder_ =
      fs::temp_directory_path() / ("curvefusion_preview_test_" + std::to_string(getpid()));
  Sequence sequence_;
};

TEST_F(Preview, ShowsTheCurveInItsColour) {
  const ColorImage preview = DrawPreview(Upright(), {}, sequence_, "one curve");
  // Front and side show 200 mm of it over hundreds of pixels, each line several pixels wide.
  EXPECT_GT(CountOf(preview, EdgeColor(0)), 500);
  EXPECT_GT(CountOf(preview, kWhite), static_cast<int>(preview.size() / 3));
}

TEST_F(Preview, IsTheSameEveryTime) {
  const ColorImage a = DrawPreview(Upright(), {}, sequence_, "one curve");
  const ColorImage b = DrawPreview(Upright(), {}, sequence_, "one curve");
  EXPECT_TRUE(std::equal(a.data(), a.data() + a.size(), b.data()));
}

TEST_F(Preview, IsWrittenAsAPicture) {
  WritePng(folder_ / "preview.png", DrawPreview(Upright(), {}, sequence_, "one curve"));
  EXPECT_GT(fs::file_size(folder_ / "preview.png"), 1000u);
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
  EXPECT_GT(axes.row(1).dot(Vec3::UnitZ()), 0.8);   // up: the demo camera looks a little down
  EXPECT_LT(axes.row(2).dot(Vec3::UnitY()), -0.8);  // towards the viewer, who stands at -y
}

}  // namespace
}  // namespace curvefusion
