#include "fusion/best/scale_of_poses.h"

#include <gtest/gtest.h>

#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

Sequence CamerasAt(const std::vector<Vec3>& centers) {
  Sequence sequence;
  for (const Vec3& center : centers) {
    SequenceFrame frame;
    frame.T_world_camera = RigidTransform::Identity();
    frame.T_world_camera.translation() = center;
    sequence.frames.push_back(frame);
  }
  return sequence;
}

// A world that came out too small shows its curves too near.
TEST(ScaleOfPoses, CamerasStayWhereTheTrackerSawThemAndCurvesMove) {
  const Sequence given = CamerasAt({{-0.1, 0, 0}, {0, 0.05, 0}, {0.1, -0.05, 0}});
  Reconstruction result;
  result.sequence = CamerasAt({{-0.09, 0, 0}, {0, 0.045, 0}, {0.09, -0.045, 0}});
  AddTestEdge(result.skeleton, TestLine({0, 0, 0.45}, {0.09, 0, 0.45}));
  HoldToScaleOf(given, result);
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 off = result.sequence.frames[i].T_world_camera.translation() -
                     given.frames[i].T_world_camera.translation();
    EXPECT_LT(off.norm(), 1e-9);
  }
  EXPECT_NEAR(result.skeleton.TotalLength(), 0.1, 1e-9);
  const EdgeId edge = result.skeleton.Edges().front();
  EXPECT_NEAR(result.skeleton.edge(edge).points.front().z(), 0.5, 1e-9);
}

TEST(ScaleOfPoses, ACameraThatStandsTellsNoScale) {
  Reconstruction result;
  result.sequence = CamerasAt({Vec3::Zero(), Vec3::Zero()});
  AddTestEdge(result.skeleton, TestLine({0, 0, 0.45}, {0.09, 0, 0.45}));
  HoldToScaleOf(CamerasAt({{0, 0, 0}, {0.1, 0, 0}}), result);
  EXPECT_NEAR(result.skeleton.TotalLength(), 0.09, 1e-12);
}

}  // namespace
}  // namespace curvefusion
