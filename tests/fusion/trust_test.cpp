#include "fusion/trust.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fusion/best/measure_trust.h"
#include "fusion/curve_graph/wire_proof.h"
#include "kernel/angle.h"

namespace curvefusion {
namespace {

// Two straight edges of 100 mm in steps of 10 mm, with evidence for the first one.
struct TwoEdges {
  Sequence given;
  Reconstruction result;
  std::vector<EdgeId> edges;

  TwoEdges() {
    for (const double y : {0.0, 0.5}) {
      Polyline points;
      for (int i = 0; i <= 10; ++i) points.emplace_back(0.01 * i, y, 0);
      edges.push_back(result.skeleton.AddPolyline(points));
    }
    given.frames.resize(3);
    for (SequenceFrame& frame : given.frames) frame.T_world_camera.setIdentity();
    result.sequence = given;
    result.radii.edges = {{edges[0], 0.002, 0.0001, 12, {}}, {edges[1], 0, 0, 2, {}}};
    result.views.edges = {{edges[0], std::vector<ViewCount>(11, {10, 9})},
                          {edges[1], std::vector<ViewCount>(11, {10, 4})}};
  }
  Trust Measure() const { return MeasureTrust(given, result); }
};

TEST(Trust, SharesAreOfTheLength) {
  TwoEdges two;
  const Trust trust = two.Measure();
  EXPECT_NEAR(trust.length, 0.2, 1e-12);  // rounding of twenty additions
  EXPECT_NEAR(trust.measured_share, 0.5, 1e-12);
  EXPECT_NEAR(trust.depth_share, 0.5, 1e-12);
  EXPECT_EQ(trust.colour_share, 0);
}

TEST(Trust, AStripSpeaksForTheCurveAroundIt) {
  TwoEdges two;
  // For the points at 40, 50 and 60 mm: 30 of 200 mm.
  two.result.radii.strips = {{two.edges[1], 0.05, 0, 0.004}};
  EXPECT_NEAR(two.Measure().colour_share, 0.15, 1e-12);
}

// Curves are cut after they were proven.
TEST(Trust, NoMoreIsWireThanIsLeft) {
  TwoEdges two;
  two.result.trust.wire_length = 0.21;
  const Trust trust = two.Measure();
  EXPECT_EQ(trust.wire_length, trust.length);
}

TEST(Trust, TellsHowFarPosesWereMoved) {
  TwoEdges two;
  two.result.sequence.frames[1].T_world_camera.translation() = Vec3(0.003, 0, 0);
  two.result.sequence.frames[2].T_world_camera.translation() = Vec3(0, 0.008, 0);
  for (const int i : {1, 2}) {
    two.result.sequence.frames[i].T_world_camera.linear() =
        Eigen::AngleAxisd(0.01, Vec3::UnitZ()).toRotationMatrix();
  }
  const Trust trust = two.Measure();
  EXPECT_NEAR(trust.pose_shift, 0.003, 1e-12);
  EXPECT_NEAR(trust.max_pose_shift, 0.008, 1e-12);
  EXPECT_NEAR(trust.pose_turn, 0.01, 1e-9);
}

// On an arc about the middle of the curves, at (.05, .25, 0).
TEST(Trust, WarnsWhereTheCameraSawOneSideOnly) {
  for (const double degrees : {20.0, 60.0}) {
    TwoEdges two;
    for (const int i : {0, 1, 2}) {
      const double angle = (i - 1) * 0.5 * degrees * kDegree;
      two.result.sequence.frames[i].T_world_camera.translation() =
          Vec3(0.05 + 0.6 * std::sin(angle), 0.25, -0.6 * std::cos(angle));
    }
    const Trust trust = two.Measure();
    EXPECT_NEAR(trust.view_angle, degrees * kDegree, 1e-9);  // rounding
    EXPECT_EQ(ViewWarning(trust).find("from 20 degrees") != std::string::npos, degrees < 25);
    EXPECT_EQ(ViewWarning(trust).empty(), degrees > 25);
  }
  EXPECT_EQ(ViewWarning(Trust()), "");  // no result
}

TEST(Trust, IsHardlyWireWhereLittleMoreThanHalfIs) {
  EXPECT_TRUE(IsHardlyWire(0.5, 1));
  EXPECT_FALSE(IsHardlyWire(0.6, 1));
  EXPECT_FALSE(IsHardlyWire(0, 0));  // there is nothing
}

TEST(Trust, IsDoubtedWhereMuchIsHardlyAWire) {
  TwoEdges two;
  Trust trust = two.Measure();
  trust.wire_length = 0.1;  // of 0.2 m
  ASSERT_EQ(Doubts(trust).size(), 1u);
  EXPECT_NE(Doubts(trust)[0].find("about 50 %"), std::string::npos);
  trust.wire_length = 0.18;
  EXPECT_TRUE(Doubts(trust).empty());
  EXPECT_TRUE(Doubts(Trust()).empty());  // no result: nothing to doubt
}

TEST(Trust, IsDoubtedWhereNoDiameterWasMeasured) {
  TwoEdges two;
  Trust trust = two.Measure();
  trust.wire_length = trust.length;
  EXPECT_TRUE(Doubts(trust).empty());
  trust.measured_share = 0;
  ASSERT_EQ(Doubts(trust).size(), 1u);
  EXPECT_NE(Doubts(trust)[0].find("how thick"), std::string::npos);
}

TEST(Trust, IsDoubtedWhereColourAloneHardlyShowsItsCurves) {
  TwoEdges two;
  two.result.radii.strips = {{two.edges[1], 0.05, 0, 0.004}};
  Trust trust = two.Measure();  // a strip along .15 of the length
  trust.wire_length = trust.length;
  EXPECT_TRUE(Doubts(trust).empty());
  trust.from_colour = true;
  ASSERT_EQ(Doubts(trust).size(), 1u);
  EXPECT_NE(Doubts(trust)[0].find("along 15 %"), std::string::npos);
  trust.colour_share = 0.45;
  trust.measured_share = 0.56;
  EXPECT_TRUE(Doubts(trust).empty());
  trust.measured_share = 0.31;
  ASSERT_EQ(Doubts(trust).size(), 1u);
  EXPECT_NE(Doubts(trust)[0].find("on 31 %"), std::string::npos);
  trust.from_colour = false;
  EXPECT_TRUE(Doubts(trust).empty());
}

TEST(Trust, WarnsOfPlacesThatColourCouldNotConfirm) {
  TwoEdges two;
  Trust trust = two.Measure();
  trust.pose_shift = 0.016;
  EXPECT_NE(PlacesWarning(trust).find("by 16 mm"), std::string::npos);
  trust.adjusted = true;
  EXPECT_EQ(PlacesWarning(trust), "");
  EXPECT_EQ(PlacesWarning(Trust()), "");  // no result
}

}  // namespace
}  // namespace curvefusion
