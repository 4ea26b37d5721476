#include "fusion/paper/wire_radius.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/fusion/wire_images.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

// Four colour images of a wire of 5 mm, 0.6 m away: 4 pixels wide.
class WireRadius : public testing::Test {
 protected:
  WireRadius() {
    std::filesystem::create_directories(folder_);
    sequence_.depth_camera = sequence_.color_camera = {320, 240, 480, 480, 159.5, 119.5};
    for (int i = 0; i < 4; ++i) {
      SequenceFrame frame;
      frame.T_world_camera = RigidTransform::Identity();
      frame.T_world_camera.translation() = Vec3(0.01 * i, -0.01 * i, 0);
      frame.color_path = folder_ / fmt::format("{}.png", i);
      WriteImage(frame.color_path, RenderWires({{kFront, kBack, 0.005, {60, 160, 70}}},
                                               sequence_.color_camera, frame.T_world_camera, 0.8));
      sequence_.frames.push_back(frame);
    }
  }
  ~WireRadius() override { std::filesystem::remove_all(folder_); }

  static SkeletonGraph Axis(const Vec3& error) {
    SkeletonGraph skeleton;
    skeleton.AddPolyline({kFront + error, kBack + error});
    return skeleton;
  }

  static inline const Vec3 kFront{-0.1, 0.01, 0.6};
  static inline const Vec3 kBack{0.1, 0.02, 0.6};
  std::filesystem::path folder_ = TemporaryPath("wire_radius");
  Sequence sequence_;
};

TEST_F(WireRadius, IsTheMostProminentOfAllBoxes) {
  const std::vector<double> diameters = MeasureDiameters(Axis(Vec3::Zero()), sequence_, {0, 4}, {});
  EXPECT_GT(diameters.size(), 80u);  // of 160 samples: 40 in each image
  SkeletonGraph final_skeleton = Axis({0.3, 0, 0});
  const double radius = AssignProminentRadius(diameters, {}, final_skeleton);
  EXPECT_NEAR(2 * radius, 0.005, 0.00125);  // pixels between edges are counted: one is 1.25 mm
  for (const EdgeId edge : final_skeleton.Edges()) {
    for (const double at : final_skeleton.edge(edge).radii) EXPECT_EQ(at, radius);
  }
}

// "Project these points from 3D to the RGB images associated with the bundle": a skeleton that has
// drifted away from other bundles' images is measured in its own.
TEST_F(WireRadius, OfABundleIsMeasuredInItsOwnFrames) {
  const SkeletonGraph drifted = Axis({0, 0.05, 0});
  for (int i = 2; i < 4; ++i) sequence_.frames[i].T_world_camera.translation() += Vec3(0, 0.05, 0);
  const size_t in_own = MeasureDiameters(drifted, sequence_, {2, 4}, {}).size();
  EXPECT_GT(in_own, 40u);
  EXPECT_EQ(MeasureDiameters(drifted, sequence_, {0, 2}, {}).size(), 0u);
}

// The mode of a few that agree and some that do not.
TEST(AssignProminentRadius, FollowsTheMajority) {
  SkeletonGraph skeleton;
  skeleton.AddPolyline({{0, 0, 0}, {0.1, 0, 0}});
  const std::vector<double> diameters = {0.0049, 0.005, 0.005, 0.0051, 0.009, 0.009, 0.012};
  EXPECT_NEAR(AssignProminentRadius(diameters, {}, skeleton), 0.0025, 0.0001);
  EXPECT_EQ(AssignProminentRadius({}, {}, skeleton), 0);
}

}  // namespace
}  // namespace curvefusion
