#include "apps/demo_scan.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "apps/demo_scene.h"
#include "capture/sequence.h"
#include "kernel/error.h"
#include "kernel/parallel.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

const DemoScanOptions kSmall = {.frame_count = 3, .width = 160, .height = 120};

class DemoScan : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }
  const fs::path folder_ =
      fs::temp_directory_path() / ("curvefusion_demo_scan_test_" + std::to_string(getpid()));
};

TEST_F(DemoScan, IsASequenceThatOpensWithThePosesItWasMadeFrom) {
  WriteDemoScan(folder_, kSmall, NoProgress);
  const Sequence sequence = OpenSequence(folder_);
  ASSERT_EQ(sequence.frame_count(), kSmall.frame_count);
  EXPECT_EQ(sequence.depth_camera.width, kSmall.width);
  for (int frame = 0; frame < sequence.frame_count(); ++frame) {
    const RigidTransform difference =
        sequence.frames[frame].T_world_camera.inverse() * DemoCameraPose(frame, kSmall.frame_count);
    // The trajectory file has six decimals.
    EXPECT_LT((difference.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-5);
  }
}

TEST_F(DemoScan, TheBackgroundLiesWhereTheSceneSaysIt) {
  WriteDemoScan(folder_, kSmall, NoProgress);
  const Sequence sequence = OpenSequence(folder_);
  const DepthImage depth = LoadDepth(sequence, 1);
  const Vec3 p_world =
      sequence.frames[1].T_world_camera * sequence.depth_camera.Unproject(80, 115, depth(80, 115));
  // Depth noise is 1.4 mm z^2, a disparity step at this focal length 9 mm at 0.8 m.
  EXPECT_NEAR(p_world.z(), 0, 0.02);
}

TEST_F(DemoScan, AnInterruptedScanHasNoListOfImages) {
  const auto interrupt = [](std::string_view, int64_t done, int64_t) {
    if (done == 2) throw Error(ErrorKind::kInterrupted, "");
  };
  EXPECT_THROW(WriteDemoScan(folder_, kSmall, interrupt), Error);
  EXPECT_FALSE(fs::exists(folder_ / "depth.txt"));
}

TEST_F(DemoScan, AFolderThatCannotBeMadeIsAnError) {
  std::ofstream(folder_) << "a file";
  EXPECT_THROW(WriteDemoScan(folder_, kSmall, NoProgress), Error);
}

TEST(DemoScene, ThreadsDoNotChangeABit) {
  const PinholeCamera camera{160, 120, 144, 144, 79.5, 59.5};
  const auto render = [&](int threads) {
    const ThreadLimit limit(threads);
    return RenderDemoFrame(MakeDemoScene(), camera, DemoCameraPose(4, 10), 4);
  };
  const DemoFrame one = render(1);
  const DemoFrame three = render(3);
  EXPECT_TRUE(
      std::equal(one.depth.data(), one.depth.data() + one.depth.size(), three.depth.data()));
  EXPECT_TRUE(
      std::equal(one.color.data(), one.color.data() + one.color.size(), three.color.data()));
}

TEST(DemoScene, WiresAreSeenWhereTheyAre) {
  const PinholeCamera camera{640, 480, 576, 576, 319.5, 239.5};
  const RigidTransform T_world_camera = DemoCameraPose(3, 10);
  const DemoScene scene = MakeDemoScene();
  const DemoFrame frame = RenderDemoFrame(scene, camera, T_world_camera, 3);
  int near = 0;
  for (const Capsule& wire : scene.wires) {
    const Vec3 middle = T_world_camera.inverse() * ((wire.a + wire.b) / 2);
    const Vec2 pixel = camera.Project(middle);
    const float depth = frame.depth(int(std::lround(pixel.x())), int(std::lround(pixel.y())));
    near += std::abs(depth - middle.z()) < 0.01 ? 1 : 0;
  }
  // A quarter of the pixels at silhouettes is lost, and few wires hide others.
  EXPECT_GE(near, static_cast<int>(0.6 * static_cast<double>(scene.wires.size())));
}

}  // namespace
}  // namespace curvefusion
