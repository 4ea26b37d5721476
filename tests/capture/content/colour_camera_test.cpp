#include "capture/content/colour_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "capture/content/colour_findings.h"
#include "capture/content/depth_edges.h"
#include "capture/content/edge_distance.h"
#include "tests/capture/content/layered_scene.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

class ColourCamera : public testing::Test {
 protected:
  Sequence Open(const LayeredScene& scene) const {
    WriteLayeredScene(scene, folder_.path());
    return OpenSequence(folder_.path());
  }

  TemporaryFolder folder_;
};

// Focal length 8 % shorter, 4 px beside the centre, 26 mm beside the depth camera: what the mug and
// the kitchen have, in images of half the size.
LayeredScene Unregistered() {
  LayeredScene scene;
  scene.color_camera = {320, 240, 267, 267, 161.5, 116.5};
  scene.offset = {-0.026, 0.004, 0};
  return scene;
}

TEST_F(ColourCamera, IsFoundWhereColourLiesBesideDepth) {
  const LayeredScene scene = Unregistered();
  const Sequence sequence = Open(scene);
  const ColourCameraFit fit = FitColourCamera(sequence, {});
  EXPECT_TRUE(fit.IsMisregistered());
  EXPECT_LT(fit.fitted_px, fit.given_px);
  for (const double depth : {0.7, 1.1, 1.6}) {
    for (const Vec2& pixel : {Vec2(40, 40), Vec2(160, 120), Vec2(280, 200)}) {
      const Vec3 p = scene.depth_camera.Unproject(pixel.x(), pixel.y(), depth);
      const Vec2 seen = scene.color_camera.Project(p + scene.offset);
      // Depth edges are known to a pixel, the near one, and 1.5 px of these images
      // are 3 px of images of 640 px, the width of the coarsest smoothing.
      EXPECT_LT((fit.color_camera.Project(fit.T_color_depth * p) - seen).norm(), 1.5);
    }
  }
}

// Of edges at one distance, a centre 8 px lower looks like a camera 24 mm higher; nearer wires tell
// them apart.
TEST_F(ColourCamera, LiesBesideTheDepthCameraNotAboveWhereEdgesDoNotTell) {
  LayeredScene scene = Unregistered();
  scene.nearest = 0.8;
  scene.farthest = 0.82;
  scene.offset.y() = 0;
  scene.color_camera.cy = scene.depth_camera.cy + 8;
  const ColourCameraFit fit = FitColourCamera(Open(scene), {});
  EXPECT_TRUE(fit.IsMisregistered());
  EXPECT_LT(std::abs(fit.T_color_depth.translation().y()), 0.004);
  EXPECT_NEAR(fit.color_camera.cy, scene.color_camera.cy, 1.5);
}

// The colour camera of a D400 sees less than half as much as its depth camera.
TEST_F(ColourCamera, OfAMuchLongerFocalLengthIsFound) {
  LayeredScene scene = Unregistered();
  scene.color_camera.fx = scene.color_camera.fy = 1.6 * scene.depth_camera.fx;
  const ColourCameraFit fit = FitColourCamera(Open(scene), {});
  EXPECT_TRUE(fit.IsMisregistered());
  EXPECT_NEAR(fit.color_camera.fx, scene.color_camera.fx, 0.02 * scene.color_camera.fx);
}

TEST_F(ColourCamera, IsLeftAloneWhereColourIsRegistered) {
  const ColourCameraFit fit = FitColourCamera(Open({}), {});
  EXPECT_TRUE(fit.measured);
  EXPECT_FALSE(fit.IsMisregistered());
  EXPECT_LT(fit.displacement_px, 2);  // a pixel of these images
}

TEST_F(ColourCamera, IsLeftAloneWhereCalibrationIsOffByTwoPixels) {
  LayeredScene scene;
  scene.color_camera.cx += 2;
  const ColourCameraFit fit = FitColourCamera(Open(scene), {});
  EXPECT_FALSE(fit.IsMisregistered());
  EXPECT_NEAR(fit.displacement_px, 4, 1.5);  // in pixels of twice the size
}

TEST_F(ColourCamera, IsNotFittedToImagesWithoutEdges) {
  LayeredScene scene = Unregistered();
  scene.colour = SceneColour::kConstant;
  EXPECT_FALSE(FitColourCamera(Open(scene), {}).measured);
}

TEST_F(ColourCamera, IsNotBelievedWhereImagesAreNoise) {
  LayeredScene scene = Unregistered();
  scene.colour = SceneColour::kNoise;
  EXPECT_FALSE(FitColourCamera(Open(scene), {}).IsMisregistered());
}

TEST_F(ColourCamera, IsUsedOnlyWhereItIsNeeded) {
  Sequence sequence = Open({});
  EXPECT_FALSE(UseFittedColourCamera(sequence));
  EXPECT_EQ(sequence.color_camera.fx, 290);
  EXPECT_THAT(sequence.warnings, testing::IsEmpty());
}

TEST_F(ColourCamera, IsUsedWithAWarning) {
  Sequence sequence = Open(Unregistered());
  EXPECT_TRUE(UseFittedColourCamera(sequence));
  EXPECT_NEAR(sequence.color_camera.fx, 267, 4);  // 1.5 %: traded against the offset
  ASSERT_EQ(sequence.warnings.size(), 1u);
  EXPECT_THAT(sequence.warnings[0], HasSubstr("px beside depth"));
}

TEST_F(ColourCamera, AsReportedIsReadBackFromTheIntrinsics) {
  const Sequence sequence = Open(Unregistered());
  const ColourCameraFit fit = FitColourCamera(sequence, {});
  std::vector<CheckFinding> findings;
  ReportColourCamera(sequence, fit, [&](const CheckFinding& f) { findings.push_back(f); });
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].cause, "colour-misregistered");
  const std::string& message = findings[0].message;
  WriteText(folder_.path() / "intrinsics.json",
            R"({"width":320,"height":240,"fx":290,"fy":290,"cx":159.5,"cy":119.5,)" +
                message.substr(message.find("\"color_camera\"")) + "}");
  const ColourCameraFit again = FitColourCamera(OpenSequence(folder_.path()), {});
  EXPECT_FALSE(again.IsMisregistered());
  EXPECT_LT(again.displacement_px, 2);  // a pixel of these images
}

TEST(DepthEdges, LieOnTheNearSideAcrossAShadow) {
  DepthImage depth(320, 48, 2.0f);
  for (int v = 0; v < 48; ++v) {
    for (int u = 20; u < 40; ++u) depth(u, v) = u < 38 ? 1.0f : 0.0f;
  }
  const std::vector<DepthEdgePoint> edges = FindDepthEdges(depth, 1000);
  ASSERT_EQ(edges.size(), 80u);  // two sides of 40 rows: 4 px of border are left out
  for (const DepthEdgePoint& edge : edges) {
    EXPECT_TRUE(edge.u == 20 || edge.u == 37) << edge.u;
    EXPECT_EQ(edge.depth, 1.0f);
    EXPECT_EQ(EdgeDistance::DirectionOf(edge.angle), 0);
  }
}

TEST(DepthEdges, AreNotSpecksOfNoise) {
  DepthImage depth(640, 480, 2.0f);
  for (int v = 8; v < 470; v += 16) {
    for (int u = 8; u < 630; u += 16) depth(u, v) = depth(u + 1, v) = 1.0f;
  }
  EXPECT_THAT(FindDepthEdges(depth, 1000), testing::IsEmpty());
}

TEST(EdgeDistance, GrowsAwayFromAnEdgeOfItsDirection) {
  ColorImage image(640, 480, Rgb{30, 30, 30});
  for (int v = 0; v < 480; ++v) {
    for (int u = 300; u < 640; ++u) image(u, v) = {200, 200, 200};
  }
  const EdgeDistance distance(image);
  // The edge is between pixels 299 and 300; images are looked at in squares of 2 px.
  EXPECT_NEAR(distance.Interpolated({299.5, 200}, 0).distance, 0, 1.1);
  EXPECT_NEAR(distance.Interpolated({310.5, 200}, 0).distance, 11, 1.1);
  EXPECT_NEAR(distance.Interpolated({289.5, 200}, 0).distance, 10, 1.1);
  EXPECT_NEAR(distance.Interpolated({310.5, 200}, 0).du, 1, 1e-6);
  EXPECT_EQ(distance.Nearest({310.5, 200}, 2), EdgeDistance::kFarthest);
}

}  // namespace
}  // namespace curvefusion
