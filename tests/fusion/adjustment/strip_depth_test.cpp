#include "fusion/adjustment/strip_depth.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

void AddUprightWire(int centre, DepthImage& depth) {
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = centre - 2; u <= centre + 2; ++u) depth(u, v) = 0.6f;
  }
}

// An upright wire 5 px wide around u = `centre` at .6 m before a wall at 1 m.
DepthImage WireDepth(int centre) {
  DepthImage depth(80, 60, 1.0f);
  AddUprightWire(centre, depth);
  return depth;
}

const StripPlace kPlace = {{40, 30}, {1, 0}, 2.5, 0.605};

TEST(MeasureStripDepthTest, DepthAndEdgesOfTheWire) {
  DepthImage image = WireDepth(41);
  image(44, 30) = 0;  // a shadow
  const StripDepth found = MeasureStripDepth(image, kPlace, 0.02);
  ASSERT_TRUE(found.measured);
  EXPECT_NEAR(found.depth, 0.6, 1e-6);                // float
  EXPECT_NEAR(found.edges_px[0].value(), 1.5, 0.25);  // steps of half a pixel
  EXPECT_NEAR(found.edges_px[1].value(), 3.5, 0.25);
}

TEST(MeasureStripDepthTest, NothingOfTheWireMeasured) {
  EXPECT_FALSE(MeasureStripDepth(WireDepth(60), kPlace, 0.02).measured);
  EXPECT_FALSE(MeasureStripDepth(DepthImage(80, 60, 0.0f), kPlace, 0.02).measured);
}

TEST(MeasureStripDepthTest, NoEdgeBesideAnotherWireOrOnASurface) {
  DepthImage crowded = WireDepth(41);
  AddUprightWire(49, crowded);
  const StripDepth found = MeasureStripDepth(crowded, kPlace, 0.02);
  EXPECT_TRUE(found.edges_px[0]);
  EXPECT_FALSE(found.edges_px[1]);
  const StripDepth surface = MeasureStripDepth(DepthImage(80, 60, 0.6f), kPlace, 0.02);
  EXPECT_TRUE(surface.measured);
  EXPECT_FALSE(surface.edges_px[0] || surface.edges_px[1]);
}

}  // namespace
}  // namespace curvefusion
