#include "capture/intrinsics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/capture/sequence_fixture.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

class IntrinsicsTest : public testing::Test {
 protected:
  std::filesystem::path Write(const std::string& text) {
    WriteText(folder_.path() / "intrinsics.json", text);
    return folder_.path() / "intrinsics.json";
  }
  std::string Defect(const std::string& text) {
    std::string message;
    ReadIntrinsics(Write(text), [&message](const CheckFinding& f) { message += f.message; });
    return message;
  }

  TemporaryFolder folder_;
};

TEST_F(IntrinsicsTest, OneCameraServesBoth) {
  const Intrinsics read =
      ReadIntrinsics(Write(R"({"width":640,"height":480,"fx":580,"fy":581,"cx":319.5,"cy":239.5})"),
                     FailOnFinding());
  EXPECT_EQ(read.depth_camera.width, 640);
  EXPECT_EQ(read.depth_camera.fy, 581);
  EXPECT_EQ(read.color_camera.cx, 319.5);
  EXPECT_FALSE(read.depth_scale);
  EXPECT_TRUE(read.T_color_depth.isApprox(RigidTransform::Identity()));
}

TEST_F(IntrinsicsTest, ColourCameraOfItsOwn) {
  const Intrinsics read = ReadIntrinsics(Write(R"({
    "width":512,"height":424,"fx":365,"fy":365,"cx":255.5,"cy":211.5,"depth_scale":1000,
    "color_camera":{"width":1920,"height":1080,"fx":1060,"fy":1061,"cx":959.5,"cy":539.5},
    "T_color_depth":[[0,-1,0,0.05],[1,0,0,0.06],[0,0,1,0.07],[0,0,0,1]]})"),
                                         FailOnFinding());
  EXPECT_EQ(*read.depth_scale, 1000);
  EXPECT_EQ(read.color_camera.width, 1920);
  EXPECT_EQ(read.color_camera.fy, 1061);
  EXPECT_TRUE((read.T_color_depth * Vec3(1, 0, 0)).isApprox(Vec3(0.05, 1.06, 0.07), 1e-12));
}

TEST_F(IntrinsicsTest, ATransformMayBeFlat) {
  const Intrinsics read = ReadIntrinsics(Write(R"({
    "width":64,"height":48,"fx":36,"fy":36,"cx":31,"cy":21,
    "T_color_depth":[0,-1,0,0.05, 1,0,0,0.06, 0,0,1,0.07, 0,0,0,1]})"),
                                         FailOnFinding());
  EXPECT_TRUE((read.T_color_depth * Vec3(1, 0, 0)).isApprox(Vec3(0.05, 1.06, 0.07), 1e-12));
}

TEST_F(IntrinsicsTest, DefectsAreNamed) {
  EXPECT_THAT(Defect("{"), HasSubstr("not valid JSON"));
  EXPECT_THAT(Defect("[]"), HasSubstr("must be a JSON object"));
  EXPECT_THAT(Defect(R"({"width":64,"height":48,"fx":36})"), HasSubstr("'fy' is missing"));
  EXPECT_THAT(Defect(R"({"width":"x"})"), HasSubstr("'width' is \"x\", a number is needed"));
  EXPECT_THAT(Defect(R"({"width":1e300})"), HasSubstr("at most 65536 pixels a side"));
  EXPECT_THAT(Defect(R"({"width":64,"height":48,"fx":-36,"fy":36,"cx":31,"cy":21})"),
              HasSubstr("fx = -36"));
  EXPECT_THAT(Defect(R"({"width":64,"height":48,"fx":36,"fy":36,"cx":319.5,"cy":21})"),
              HasSubstr("(319.5, 21) lies outside the 64x48 image"));
  EXPECT_THAT(Defect(R"({"width":64,"height":48,"fx":36,"fy":36,"cx":31,"cy":21,"depth_scale":0})"),
              HasSubstr("depth_scale is 0"));
  EXPECT_THAT(
      Defect(R"({"width":64,"height":48,"fx":36,"fy":36,"cx":31,"cy":21,"T_color_depth":[1,0,0]})"),
      HasSubstr("16 numbers is needed, 3 are there"));
}

TEST_F(IntrinsicsTest, RedwoodMatricesAreColumnMajor) {
  const Intrinsics read = ReadRedwoodIntrinsics(
      Write(R"({"width":640,"height":480,"intrinsic_matrix":[525,0,0,0,526,0,319.5,239.5,1]})"),
      FailOnFinding());
  EXPECT_EQ(read.depth_camera.fx, 525);
  EXPECT_EQ(read.depth_camera.fy, 526);
  EXPECT_EQ(read.depth_camera.cx, 319.5);
  EXPECT_EQ(read.depth_camera.cy, 239.5);
}

TEST_F(IntrinsicsTest, ARowMajorRedwoodMatrixIsReported) {
  std::string message;
  ReadRedwoodIntrinsics(
      Write(R"({"width":640,"height":480,"intrinsic_matrix":[525,0,319.5,0,525,239.5,0,0,1]})"),
      [&message](const CheckFinding& finding) { message = finding.message; });
  EXPECT_THAT(message, HasSubstr("row by row; it must be column by column"));
}

}  // namespace
}  // namespace curvefusion
