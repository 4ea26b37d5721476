#include "fusion/segmentation/segmentation.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/fusion/wire_images.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

// Ten images of an upright wire of 6 mm, .6 m away; depth of what is behind it in metres, 0 = none.
class WireBefore {
 public:
  explicit WireBefore(double background) {
    std::filesystem::create_directories(folder_);
    WriteImage(folder_ / "color.jpg",
               DrawStrip(160, 120, 77, 83, {40, 160, 60}, {150, 120, 160}, 0.8));
    cv::Mat depth(120, 160, CV_16U, cv::Scalar(5000 * background));
    depth.colRange(77, 84) = 3000;
    cv::imwrite((folder_ / "depth.png").string(), depth);
    sequence_.depth_camera = sequence_.color_camera = {160, 120, 600, 600, 79.5, 59.5};
    for (int i = 0; i < 10; ++i) {
      SequenceFrame frame;
      frame.T_world_camera = RigidTransform::Identity();
      frame.color_path = folder_ / "color.jpg";
      frame.depth_path = folder_ / "depth.png";
      sequence_.frames.push_back(frame);
    }
  }
  ~WireBefore() { std::filesystem::remove_all(folder_); }
  WireBefore(const WireBefore&) = delete;
  WireBefore& operator=(const WireBefore&) = delete;

  // The camera moves by so much from each frame to the next, metres.
  void Spread(double step) {
    for (int i = 0; i < 10; ++i) {
      sequence_.frames[i].T_world_camera.translation() = Vec3(0, i * step, 0);
    }
  }

  // From this frame on nothing has depth.
  void HideFrom(int first) {
    cv::imwrite((folder_ / "nothing.png").string(), cv::Mat::zeros(120, 160, CV_16U));
    for (int i = first; i < 10; ++i) sequence_.frames[i].depth_path = folder_ / "nothing.png";
  }

  // Against a volume in which nothing has been integrated.
  SegmentedBundle Segment(SegmentationOptions options) const {
    options.difference.accept_where_nothing_rendered = false;
    const TsdfVolume volume{TsdfOptions{}};
    const SegmentationModel model = LearnSegmentation(sequence_, volume, options);
    return SegmentBundle(sequence_, 0, 10, volume, model, options, [] {});
  }

  size_t PointsFound(double min_measured_share) const {
    SegmentationOptions options;
    options.min_measured_share = min_measured_share;
    return Segment(options).difference_set.size();
  }

  // Which frames see points of wires, 1 or 0 a frame, where so many are enough.
  std::string FramesThatSee(int max_frame_points, int min_frames = 1) const {
    SegmentationOptions options;
    options.min_measured_share = 0.5;
    options.gate.frames = 2;
    options.max_frame_points = max_frame_points;
    options.bundle.min_frames = min_frames;
    std::string seen;
    for (const ObservedPoints& frame : Segment(options).frames) seen += frame.empty() ? '0' : '1';
    return seen;
  }

 private:
  std::filesystem::path folder_ = TemporaryPath("segmentation");
  Sequence sequence_;
};

TEST(Segmentation, WiresBeforeABackgroundOutOfRangeAreFound) {
  const WireBefore scan(0);
  EXPECT_GT(scan.PointsFound(0.5), 20u);
  EXPECT_EQ(scan.PointsFound(0), 0u);
}

// Where nothing is rendered before a background that was measured, the surface is just not known.
TEST(Segmentation, WhereABackgroundIsMeasuredItIsToBeRendered) {
  EXPECT_EQ(WireBefore(1).PointsFound(0.5), 0u);
}

// The wire covers 7 x 120 pixels of 1 mm, about 50 x 3 voxels of 2.5 mm.
TEST(Segmentation, CrowdedFramesOfAVideoAreThinned) {
  const WireBefore scan(0);
  EXPECT_EQ(scan.FramesThatSee(50), "1010101010");
  EXPECT_EQ(scan.FramesThatSee(500), "1111111111");
  EXPECT_EQ(scan.FramesThatSee(0), "1111111111");
}

TEST(Segmentation, ViewsFarApartAreNeverThinned) {
  WireBefore scan(0);
  scan.Spread(0.03);
  EXPECT_EQ(scan.FramesThatSee(50), "1111111111");
}

// What three of the frames must see it is enough for two to see where half of them are left out.
TEST(Segmentation, ThinnedFramesNeedNotSeeAPointAsOften) {
  WireBefore scan(0);
  scan.HideFrom(4);
  EXPECT_EQ(scan.FramesThatSee(50, 3), "1010000000");
  EXPECT_EQ(scan.FramesThatSee(0, 4), "1111000000");
  EXPECT_EQ(scan.FramesThatSee(50, 5), "0000000000");
}

}  // namespace
}  // namespace curvefusion
