#include "fusion/silhouettes/view_evidence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

// A wall 1 m before four cameras at the origin. In image 0 a wire at 0.6 m goes all across the
// middle, in image 1 only its left half was measured, in image 2 a board at 0.4 m hides its right
// half, image 3 is without any measurement.
class ViewEvidenceTest : public testing::Test {
 protected:
  static constexpr double kDepth = 0.6, kRadius = 0.002;

  ViewEvidenceTest() {
    std::filesystem::create_directories(folder_);
    sequence_.depth_camera = sequence_.color_camera = {160, 120, 145, 145, 79.5, 59.5};
    sequence_.depth_scale = 1000;
    for (int i = 0; i < 4; ++i) {
      SequenceFrame frame;
      frame.T_world_camera = RigidTransform::Identity();
      frame.depth_path = folder_ / fmt::format("{}.png", i);
      sequence_.frames.push_back(frame);
      WriteDepth(i);
    }
    const EdgeId edge = skeleton_.AddPolyline({{-0.1, 0, kDepth}, {0.1, 0, kDepth}});
    skeleton_.SetCurve(edge, skeleton_.edge(edge).points, {kRadius, kRadius});
  }
  ~ViewEvidenceTest() override { std::filesystem::remove_all(folder_); }

  void WriteDepth(int frame) const {
    cv::Mat depth(120, 160, CV_16U, cv::Scalar(frame == 3 ? 0 : 1000));
    if (frame < 3) depth(cv::Rect(0, 59, frame == 1 ? 80 : 160, 2)) = 598;
    if (frame == 2) depth(cv::Rect(80, 0, 80, 120)) = 400;
    cv::imwrite(sequence_.frames[frame].depth_path.string(), depth);
  }

  std::filesystem::path folder_ = TemporaryPath("view_evidence");
  Sequence sequence_;
  SkeletonGraph skeleton_;
};

TEST_F(ViewEvidenceTest, CountsWhereAPointWasSeenAndLookedFor) {
  const ViewEvidence evidence = CountViews(skeleton_, sequence_, {});
  EXPECT_EQ(evidence.frames, 4);
  ASSERT_EQ(evidence.edges.size(), 1u);
  const std::vector<ViewCount>& points = evidence.edges[0].points;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].looked, 4);
  EXPECT_EQ(points[0].seen, 3);
  EXPECT_EQ(points[1].looked, 3);  // hidden by the board
  EXPECT_EQ(points[1].seen, 1);
}

TEST_F(ViewEvidenceTest, WhatLiesOutsideTheImageIsNotLookedFor) {
  SkeletonGraph outside;
  outside.AddPolyline({{-0.1, 0, -kDepth}, {2, 0, kDepth}});
  const ViewEvidence evidence = CountViews(outside, sequence_, {});
  for (const ViewCount& point : evidence.edges[0].points) {
    EXPECT_EQ(point.looked, 0);
    EXPECT_EQ(point.seen, 0);
  }
}

TEST_F(ViewEvidenceTest, ADepthBeyondTheToleranceIsNoneOfTheWire) {
  SkeletonGraph before;
  before.AddPolyline({{-0.1, 0, kDepth - 0.03}, {-0.05, 0, kDepth - 0.03}});
  EXPECT_EQ(CountViews(before, sequence_, {}).edges[0].points[0].seen, 0);
  ViewEvidenceOptions wide;
  wide.tolerance = 0.04;
  EXPECT_EQ(CountViews(before, sequence_, wide).edges[0].points[0].seen, 3);
}

TEST_F(ViewEvidenceTest, ObservationsAreTheImagesThatSawAPoint) {
  AssignObservations(CountViews(skeleton_, sequence_, {}), skeleton_);
  EXPECT_EQ(skeleton_.edge(0).observations, (std::vector<double>{3, 1}));
  EXPECT_EQ(skeleton_.edge(0).radii, (std::vector<double>{kRadius, kRadius}));
}

TEST_F(ViewEvidenceTest, AnEmptySkeletonRestsOnNothing) {
  const ViewEvidence evidence = CountViews({}, sequence_, {});
  EXPECT_TRUE(evidence.edges.empty());
}

TEST(TypicalViews, AreTheMediansOfBothCounts) {
  const ViewCount typical = TypicalViews({{5, 1}, {9, 2}, {7, 7}});
  EXPECT_EQ(typical.looked, 7);
  EXPECT_EQ(typical.seen, 2);
  EXPECT_EQ(TypicalViews({}).looked, 0);
}

}  // namespace
}  // namespace curvefusion
