#include "capture/distortion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "capture/intrinsics.h"
#include "capture/sequence.h"
#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr PinholeCamera kCamera = {320, 240, 250, 255, 158, 121};
// A lens of a cheap camera: pixels in the corners move by 15 px.
constexpr Distortion kLens = {-0.2, 0.05, 0.002, -0.001, 0.01};

// Where the lens shows what an ideal camera sees at a pixel.
Vec2 Seen(const Vec2& pixel) {
  const Vec2 bent = kLens.Apply(kCamera.Unproject(pixel.x(), pixel.y(), 1).head<2>());
  return {kCamera.fx * bent.x() + kCamera.cx, kCamera.fy * bent.y() + kCamera.cy};
}

// The inverse, by fixed-point iteration: the lens shifts by less than a third of the radius.
Vec2 Ideal(const Vec2& seen) {
  Vec2 pixel = seen;
  for (int i = 0; i < 60; ++i) pixel += seen - Seen(pixel);
  return pixel;
}

// Depths and greys that vary linearly over the ideal image.
double Plane(const Vec2& pixel) { return 0.5 + pixel.x() / 400 + pixel.y() / 800; }

// As the documentation of cv::projectPoints has it, written out.
TEST(Distortion, HasTheCoefficientsOfOpenCv) {
  const Vec2 bent = Distortion{0.1, 0.01, 0.002, 0.003, 0.001}.Apply({0.5, -0.25});
  const double r2 = 0.3125, radial = 1 + 0.1 * r2 + 0.01 * r2 * r2 + 0.001 * r2 * r2 * r2;
  EXPECT_NEAR(bent.x(), 0.5 * radial + 2 * 0.002 * -0.125 + 0.003 * (r2 + 0.5), 1e-15);
  EXPECT_NEAR(bent.y(), -0.25 * radial + 0.002 * (r2 + 0.125) + 2 * 0.003 * -0.125, 1e-15);
}

TEST(Distortion, OfDepthIsUndone) {
  DepthImage stored(kCamera.width, kCamera.height, 0);
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) stored(u, v) = static_cast<float>(Plane(Ideal(Vec2(u, v))));
  }
  const DepthImage depth = Undistorted(stored, kCamera, kLens);
  int valid = 0;
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      if (depth(u, v) == 0) continue;
      ++valid;
      // The nearest pixel is at most .71 px off, .9 px of the ideal image.
      EXPECT_NEAR(depth(u, v), Plane(Vec2(u, v)), 0.9 * std::hypot(1 / 400., 1 / 800.));
    }
  }
  EXPECT_EQ(valid, 320 * 240);  // a barrel lens sees more than the ideal image shows
}

TEST(Distortion, OfDepthMakesNoValuesBetweenNearAndFar) {
  DepthImage stored(kCamera.width, kCamera.height, 2);
  for (int v = 0; v < 240; ++v) {
    for (int u = 60; u < 100; ++u) stored(u, v) = 1;
  }
  const DepthImage depth = Undistorted(stored, kCamera, kLens);
  for (size_t i = 0; i < depth.size(); ++i) {
    EXPECT_TRUE(depth.data()[i] == 1 || depth.data()[i] == 2);
  }
}

TEST(Distortion, OfColourIsUndone) {
  const auto grey = [](const Vec2& pixel) { return 100 * Plane(pixel); };
  ColorImage stored(kCamera.width, kCamera.height, Rgb{});
  for (int v = 0; v < 240; ++v) {
    for (int u = 0; u < 320; ++u) {
      stored(u, v)[0] = static_cast<uint8_t>(std::lround(grey(Ideal(Vec2(u, v)))));
    }
  }
  const ColorImage color = Undistorted(stored, kCamera, kLens);
  for (int v = 0; v < 240; ++v) {
    // Twice rounded to whole grey levels, and interpolated between rounded ones.
    for (int u = 0; u < 320; ++u) EXPECT_NEAR(color(u, v)[0], grey(Vec2(u, v)), 1.1);
  }
}

TEST(Distortion, GoesOutwardsOnlyToTheFold) {
  // r (1 + k1 r^2) is largest where 1 + 3 k1 r^2 = 0.
  EXPECT_NEAR((Distortion{-0.5, 0, 0, 0, 0}.ValidRadius(1)), std::sqrt(1 / 1.5), 0.01);  // one step
  EXPECT_EQ((Distortion{0.5, 0, 0, 0, 0}.ValidRadius(1)), 1);
}

// The lens of a wide depth camera: as OpenCV's documentation has the rational model, written out.
TEST(Distortion, OfTheRationalModelHasADenominator) {
  const Distortion lens = {1.2, 0.3, 0.0001, -0.0002, 0.01, 1.5, 0.5, 0.05};
  const double r2 = 0.3125;
  const double radial = (1 + 1.2 * r2 + 0.3 * r2 * r2 + 0.01 * r2 * r2 * r2) /
                        (1 + 1.5 * r2 + 0.5 * r2 * r2 + 0.05 * r2 * r2 * r2);
  const Vec2 bent = lens.Apply({0.5, -0.25});
  EXPECT_NEAR(bent.x(), 0.5 * radial + 2 * 0.0001 * -0.125 - 0.0002 * (r2 + 0.5), 1e-15);
  EXPECT_NEAR(bent.y(), -0.25 * radial + 0.0001 * (r2 + 0.125) - 2 * 0.0002 * -0.125, 1e-15);
  EXPECT_TRUE(lens.IsRational());
  EXPECT_FALSE((Distortion{0, 0, 0, 0, 0, 0, 0.1, 0}.IsZero()));
}

TEST(Distortion, OfTheRationalModelGoesOutwardsOnlyToTheFold) {
  // r / (1 + k4 r^2) is largest where k4 r^2 = 1.
  EXPECT_NEAR((Distortion{0, 0, 0, 0, 0, 4, 0, 0}.ValidRadius(1)), 0.5, 0.01);  // one step
  EXPECT_EQ((Distortion{0, 0, 0, 0, 0, 0.9, 0, 0}.ValidRadius(1)), 1);
  // The denominator vanishes at r = .5.
  EXPECT_LT((Distortion{0, 0, 0, 0, 0, -4, 0, 0}.ValidRadius(1)), 0.5);
}

class DistortionKeys : public testing::Test {
 protected:
  Intrinsics Read(const std::string& more) {
    WriteText(folder_.path() / "intrinsics.json",
              R"({"width":320,"height":240,"fx":250,"fy":255,"cx":158,"cy":121)" + more + "}");
    findings_.clear();
    return ReadIntrinsics(folder_.path() / "intrinsics.json",
                          [this](const CheckFinding& f) { findings_.push_back(f); });
  }
  std::string Defect(const std::string& more) {
    Read(more);
    return findings_.size() == 1 && findings_[0].severity == Severity::kError ? findings_[0].message
                                                                              : "no error";
  }

  TemporaryFolder folder_;
  std::vector<CheckFinding> findings_;
};

TEST_F(DistortionKeys, AreReadByNameAndAsAList) {
  for (const char* keys : {R"(,"k1":-0.2,"k2":0.05,"p1":0.002,"p2":-0.001,"k3":0.01)",
                           R"(,"distortion":[-0.2,0.05,0.002,-0.001,0.01])",
                           R"(,"distortion":[-0.2,0.05,0.002,-0.001,0.01,0,0,0])"}) {
    const Intrinsics read = Read(keys);
    EXPECT_THAT(findings_, IsEmpty());
    EXPECT_EQ(read.depth_distortion.k1, -0.2);
    EXPECT_EQ(read.depth_distortion.p1, 0.002);
    EXPECT_EQ(read.color_distortion.p2, -0.001);
    EXPECT_EQ(read.color_distortion.k3, 0.01);
  }
}

TEST_F(DistortionKeys, OfTheRationalModelAreReadAsAList) {
  const Intrinsics read = Read(R"(,"distortion":[0.2,0.05,0.002,-0.001,0.01,0.3,0.04,0.02])");
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_EQ(read.depth_distortion.k3, 0.01);
  EXPECT_EQ(read.depth_distortion.k4, 0.3);
  EXPECT_EQ(read.depth_distortion.k6, 0.02);
}

TEST_F(DistortionKeys, BelongToTheCameraTheyStandWith) {
  const Intrinsics read = Read(
      R"(,"k1":0.1,"color_camera":{"width":64,"height":48,"fx":60,"fy":60,"cx":31,"cy":23,"k1":-0.1})");
  EXPECT_EQ(read.depth_distortion.k1, 0.1);
  EXPECT_EQ(read.color_distortion.k1, -0.1);
}

TEST_F(DistortionKeys, OfOtherModelsAreRefused) {
  EXPECT_THAT(Defect(R"(,"k1":0.1,"k4":0.2)"), AllOf(HasSubstr("'k4'"), HasSubstr("undistort")));
  EXPECT_THAT(Defect(R"(,"model":"fisheye")"), HasSubstr("fisheye"));
  EXPECT_THAT(Defect(R"(,"model":"inverse_brown_conrady","k1":0.1)"), HasSubstr("inverse"));
  EXPECT_THAT(Defect(R"(,"distortion":[0,0,0,0,0,0.1])"), HasSubstr("6 coefficients"));
  EXPECT_THAT(Defect(R"(,"distortion":[0.1])"), HasSubstr("4, 5 or 8 numbers"));
  EXPECT_THAT(Defect(R"(,"k1":"big")"), HasSubstr("a number is needed"));
  EXPECT_THAT(Defect(R"(,"k1":-9)"), HasSubstr("folds"));
  EXPECT_THAT(Defect(R"(,"p1":1e300)"), HasSubstr("moves pixels"));
}

TEST_F(DistortionKeys, WithoutCoefficientsNeedNoModel) {
  const Intrinsics read =
      Read(R"(,"model":"inverse_brown_conrady","distortion":[0,0,0,0,0],"k4":0)");
  EXPECT_THAT(findings_, IsEmpty());
  EXPECT_TRUE(read.depth_distortion.IsZero());
}

TEST_F(DistortionKeys, UnknownOnesAreNamedWithTheNearest) {
  Read(R"(,"depthscale":1000,"note":"by hand","registered":true)");
  ASSERT_EQ(findings_.size(), 1u);
  EXPECT_EQ(findings_[0].cause, "unknown-key");
  EXPECT_EQ(findings_[0].severity, Severity::kWarning);
  EXPECT_THAT(findings_[0].message,
              AllOf(HasSubstr("'depthscale'"), HasSubstr("did you mean depth_scale?")));
}

TEST_F(DistortionKeys, ReachTheImages) {
  WriteTumSequence(folder_.path());
  WriteText(folder_.path() / "intrinsics.json",
            R"({"width":32,"height":24,"fx":30,"fy":30,"cx":15.5,"cy":11.5,"k1":0.5})");
  const Sequence sequence = OpenSequence(folder_.path());
  // At the corner r = .64: what is shown there lies 1.2 times as far out, outside the image.
  EXPECT_EQ(LoadDepth(sequence, 0)(0, 0), 0);
  EXPECT_EQ(LoadColor(sequence, 0)(0, 0), (Rgb{0, 0, 0}));
  EXPECT_GT(LoadDepth(sequence, 0)(16, 12), 0);
}

}  // namespace
}  // namespace curvefusion
