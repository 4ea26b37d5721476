#include "fusion/curve_graph/depth_profile.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

// A camera at the origin, a vertical curve .6 m before it in the middle of the image.
class DepthProfileTest : public testing::Test {
 protected:
  static constexpr double kDepth = 0.6;
  static constexpr int kCenter = 80;  // column of the curve

  // Columns [first, last) at a depth.
  void Fill(int first, int last, double depth) {
    for (int v = 0; v < depth_.height(); ++v) {
      for (int u = first; u < last; ++u) depth_(u, v) = static_cast<float>(depth);
    }
  }
  DepthProfile Look(const std::vector<CurvePlace>& places) const {
    const CurveMap curves(places, camera_, RigidTransform::Identity());
    return LookAcross(depth_, camera_, RigidTransform::Identity(), places.front(), curves);
  }
  DepthProfile Look() const { return Look({place_}); }
  static void ExpectSides(const DepthProfile& profile, Beside one, Beside other) {
    ASSERT_EQ(profile.sight, Sight::kSeen);
    EXPECT_TRUE((profile.sides[0] == one && profile.sides[1] == other) ||
                (profile.sides[0] == other && profile.sides[1] == one));
  }

  PinholeCamera camera_{161, 121, 300, 300, kCenter, 60};  // 2 mm a pixel at the curve
  DepthImage depth_{161, 121, 1.0F};                       // a wall
  CurvePlace place_{0, 0, 0.002, Vec3(0, 0, kDepth), Vec3::UnitY()};
};

TEST_F(DepthProfileTest, AWireIsOpenOnBothSides) {
  Fill(kCenter - 1, kCenter + 2, kDepth - 0.002);
  const DepthProfile profile = Look();
  ExpectSides(profile, Beside::kOpen, Beside::kOpen);
  EXPECT_NEAR(profile.width, 3 * kDepth / 300, 1e-12);
}

TEST_F(DepthProfileTest, AnEdgeGoesOnOnOneSide) {
  Fill(kCenter - 1, 161, kDepth - 0.002);
  ExpectSides(Look(), Beside::kOpen, Beside::kSame);
}

TEST_F(DepthProfileTest, AnObliqueSurfaceGoesOn) {
  // Like the top of a shelf: 45 degrees, 2 mm deeper a pixel.
  for (int k = 0; k < 80; ++k) Fill(kCenter + k, kCenter + k + 1, kDepth - 0.002 + 0.002 * k);
  ExpectSides(Look(), Beside::kOpen, Beside::kSame);
}

TEST_F(DepthProfileTest, ARampThatTheSensorLaysBehindAWireIsNoSurface) {
  Fill(kCenter - 1, kCenter + 2, kDepth - 0.002);
  for (int k = 2; k < 30; ++k) Fill(kCenter + k, kCenter + k + 1, kDepth + 0.006 * (k - 1));
  ExpectSides(Look(), Beside::kOpen, Beside::kOpen);
}

TEST_F(DepthProfileTest, WhatWasNotMeasuredIsUnknown) {
  Fill(kCenter - 1, kCenter + 2, kDepth - 0.002);
  Fill(kCenter + 2, kCenter + 20, 0);
  ExpectSides(Look(), Beside::kOpen, Beside::kUnknown);
}

TEST_F(DepthProfileTest, WhatIsNearerIsUnknown) {
  Fill(kCenter - 1, kCenter + 2, kDepth - 0.002);
  Fill(kCenter + 2, 161, 0.4);
  ExpectSides(Look(), Beside::kOpen, Beside::kUnknown);
}

TEST_F(DepthProfileTest, AnotherCurveIsNoSurface) {
  Fill(kCenter - 1, 161, kDepth - 0.002);
  CurvePlace other = place_;
  other.edge = 1;
  other.position.x() = 0.02;
  ExpectSides(Look({place_, other}), Beside::kOpen, Beside::kUnknown);
}

TEST_F(DepthProfileTest, TellsWhyACurveIsNotSeen) {
  EXPECT_EQ(Look().sight, Sight::kPast);
  Fill(0, 161, 0.4);
  EXPECT_EQ(Look().sight, Sight::kHidden);
  Fill(0, 161, 0);
  EXPECT_EQ(Look().sight, Sight::kNothing);
  place_.position.x() = 1;
  EXPECT_EQ(Look().sight, Sight::kOutside);
  place_.position = {0, 0, -kDepth};
  EXPECT_EQ(Look().sight, Sight::kOutside);
}

TEST_F(DepthProfileTest, ACurveSeenEndOnIsNotLookedAt) {
  Fill(kCenter - 1, kCenter + 2, kDepth - 0.002);
  place_.tangent = Vec3::UnitZ();
  EXPECT_EQ(Look().sight, Sight::kOutside);
}

}  // namespace
}  // namespace curvefusion
