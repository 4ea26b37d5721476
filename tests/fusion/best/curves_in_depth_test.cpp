#include "fusion/best/curves_in_depth.h"

#include <gtest/gtest.h>

#include "capture/png.h"
#include "tests/capture/sequence_fixture.h"
#include "tests/fusion/silhouettes/silhouette_scan.h"

namespace curvefusion {
namespace {

constexpr double kRange = 0.6;    // metres to the wire, which is upright
constexpr double kWall = 0.9;     // to what is behind it
constexpr double kScale = 1000;   // of depth images
constexpr uint16_t kNothing = 0;  // not measured

// A wire in the middle of the image, whose depth differs `half_width` pixels to both sides of it.
class CurvesInDepth : public testing::Test {
 protected:
  PlacesInDepth LookUp(uint16_t at_wire, int half_width, double right_of_it = kWall) {
    const PinholeCamera camera = {160, 120, 140, 140, 80, 60};
    Image<uint16_t> depth(camera.width, camera.height, Millimetres(kWall));
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 80 - half_width; u < camera.width; ++u)
        depth(u, v) = u <= 80 + half_width ? at_wire : Millimetres(right_of_it);
    }
    WriteText(folder_.path() / "depth.png", EncodePng(depth));
    Sequence sequence;
    sequence.depth_camera = camera;
    sequence.depth_scale = kScale;
    sequence.frames.resize(1);
    sequence.frames[0].T_world_camera = RigidTransform::Identity();
    sequence.frames[0].depth_path = folder_.path() / "depth.png";
    SkeletonGraph wire;
    wire.AddPolyline(TestLine({0, -0.1, kRange}, {0, 0.1, kRange}));
    return LookUpDepth(sequence, wire, {0});
  }

  static uint16_t Millimetres(double metres) { return static_cast<uint16_t>(kScale * metres); }

  TemporaryFolder folder_;
};

TEST_F(CurvesInDepth, WhatDepthLooksPastIsOpen) {
  const PlacesInDepth places = LookUp(Millimetres(kWall), 3);
  EXPECT_FALSE(places.HaveHoles());
  EXPECT_EQ(places.ShareOpen(), 1);
  EXPECT_TRUE(places.AreOpen());
}

TEST_F(CurvesInDepth, WhatLiesOnASurfaceIsNot) {
  const PlacesInDepth places = LookUp(Millimetres(kRange), 30);
  EXPECT_FALSE(places.HaveHoles());
  EXPECT_EQ(places.ShareOpen(), 0);
  EXPECT_FALSE(places.AreOpen());
}

// As of a wire that is too thin for the camera.
TEST_F(CurvesInDepth, ANarrowHoleBeforeWhatIsBehindIsOpen) {
  const PlacesInDepth places = LookUp(kNothing, 3);
  EXPECT_TRUE(places.HaveHoles());
  EXPECT_EQ(places.ShareOpen(), 1);
  EXPECT_TRUE(places.AreOpen());
}

TEST_F(CurvesInDepth, AWideHoleIsNot) {
  EXPECT_TRUE(LookUp(kNothing, 30).HaveHoles());
  EXPECT_FALSE(LookUp(kNothing, 30).AreOpen());
}

// As of the edge of a black surface.
TEST_F(CurvesInDepth, AHoleThatIsOpenOnOneSideIsNot) {
  EXPECT_FALSE(LookUp(kNothing, 3, kRange).AreOpen());
}

TEST_F(CurvesInDepth, WhatIsHiddenTellsNothing) {
  const PlacesInDepth places = LookUp(Millimetres(0.4), 3);
  EXPECT_EQ(places.looked, 0u);
  EXPECT_FALSE(places.AreOpen());
}

// An upright wire of which depth has points, at whatever distance along its line of sight.
class ThinInDepth : public testing::Test {
 protected:
  ThinInDepth() {
    depth_.sequence.color_camera = depth_.sequence.depth_camera = {640, 480, 525, 525, 320, 240};
    depth_.sequence.frames.resize(1);
    depth_.sequence.frames[0].T_world_camera = RigidTransform::Identity();
    for (const Vec3& p : TestLine({0, -0.1, kRange}, {0, 0.1, kRange}))
      depth_.points.Add(1.1 * p, Vec3::UnitZ(), 1);
  }

  // A wire beside it, seen by the same camera.
  Reconstruction WireAt(double x) const {
    Reconstruction colour;
    colour.sequence = depth_.sequence;
    AddTestEdge(colour.skeleton, TestLine({x, -0.1, kRange}, {x, 0.1, kRange}));
    return colour;
  }

  Reconstruction depth_;
};

TEST_F(ThinInDepth, PixelsElsewhereAreUnlikelyWire) {
  const std::vector<PosteriorImage> kept =
      KeepThinInDepth(depth_, {0}, {PosteriorImage(640, 480, 200)});
  EXPECT_EQ(kept[0](320, 240), 200);
  EXPECT_EQ(kept[0](332, 240), 200);
  EXPECT_EQ(kept[0](350, 240), 0);
  EXPECT_EQ(kept[0](320, 380), 0);
}

TEST_F(ThinInDepth, IsOnCurvesInItsPixels) {
  EXPECT_EQ(ShareOnCurves(depth_, WireAt(0), {0}), 1);
  EXPECT_EQ(ShareOnCurves(depth_, WireAt(0.1), {0}), 0);
  EXPECT_EQ(ShareThinInDepth(depth_, WireAt(0), {0}), 1);
  EXPECT_EQ(ShareThinInDepth(depth_, WireAt(0.1), {0}), 0);
}

}  // namespace
}  // namespace curvefusion
