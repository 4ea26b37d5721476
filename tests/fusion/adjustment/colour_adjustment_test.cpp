#include "fusion/adjustment/colour_adjustment.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <opencv2/imgcodecs.hpp>

#include "fusion/registration/pose_correction.h"
#include "kernel/parallel.h"
#include "tests/fusion/wire_images.h"

namespace curvefusion {
namespace {

constexpr int kFrames = 6;

std::vector<RenderedWire> Wires(const Rgb& color) {
  return {{{-0.10, -0.06, 0.50}, {0.10, -0.05, 0.56}, 0.005, color},
          {{-0.09, 0.05, 0.58}, {0.11, 0.07, 0.52}, 0.005, color},
          {{-0.05, -0.09, 0.60}, {-0.04, 0.09, 0.60}, 0.006, color},
          {{0.06, -0.09, 0.50}, {0.03, 0.09, 0.55}, 0.006, color}};
}

RigidTransform TruePose(double frame) {
  const double angle = 0.08 * (frame - kFrames / 2);
  RigidTransform T = RigidTransform::Identity();
  T.linear() = Eigen::AngleAxisd(angle, Vec3(0.5, 1, 0).normalized()).toRotationMatrix();
  T.translation() = Vec3(0, 0, 0.55) - T.linear() * Vec3(0, 0, 0.55);
  return T;
}

// Rendered images of four wires as JPEG, without depth (all zero).
class ColourAdjustmentTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("curvefusion_colour_adjustment_{}", getpid());
    std::filesystem::create_directories(folder_);
    cv::imwrite((folder_ / "depth.png").string(), cv::Mat(240, 320, CV_16UC1, cv::Scalar(0)));
    for (int i = 0; i < kFrames; ++i) {
      WriteFrame(i, Wires({60, 160, 70}), "green");
      WriteFrame(i, Wires({144, 138, 156}), "grey");  // .83 of it is the background's colour
    }
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }

  static PinholeCamera Camera() { return {320, 240, 480, 480, 159.5, 119.5}; }

  static void WriteFrame(int i, const std::vector<RenderedWire>& wires, const std::string& name) {
    WriteImage(folder_ / fmt::format("{}{}.jpg", name, i),
               RenderWires(wires, Camera(), TruePose(i), 0.8));
  }

  // In millimetres.
  static void WriteDepth(const std::filesystem::path& path, DepthImage depth) {
    const cv::Mat metres(depth.height(), depth.width(), CV_32FC1, depth.data());
    cv::Mat millimetres;
    metres.convertTo(millimetres, CV_16UC1, 1000);
    cv::imwrite(path.string(), millimetres);
  }

  // Poses zig-zag by 2 mm and 2 mrad (2 px together) around the true ones.
  static Sequence DriftedSequence(const std::string& name) {
    Sequence sequence;
    sequence.depth_camera = sequence.color_camera = Camera();
    sequence.depth_scale = 1000;
    for (int i = 0; i < kFrames; ++i) {
      const double sign = i % 2 == 0 ? 1 : -1;
      SmallMotion error;
      error << sign * 0.002, sign * (i % 3 - 1) * 0.002, 0, (i % 3 - 1) * 0.002, sign * 0.002, 0;
      SequenceFrame frame;
      frame.timestamp = i;
      frame.T_world_camera = TruePose(i) * RigidTransformOf(error);
      frame.color_path = folder_ / fmt::format("{}{}.jpg", name, i);
      frame.depth_path = folder_ / "depth.png";
      sequence.frames.push_back(frame);
    }
    return sequence;
  }

  // The wires' axes, bent by up to 2 mm.
  static SkeletonGraph WrongSkeleton() {
    SkeletonGraph skeleton;
    for (const RenderedWire& wire : Wires({})) {
      Polyline points;
      for (int i = 0; i <= 20; ++i) {
        const Vec3 error = 0.002 * Vec3(std::sin(0.3 * i), std::cos(0.4 * i), 0);
        points.push_back(wire.front + i / 20.0 * (wire.back - wire.front) + error);
      }
      const EdgeId edge = skeleton.AddPolyline(points);
      skeleton.SetCurve(edge, points, std::vector<double>(points.size(), 0.5 * wire.diameter));
    }
    return skeleton;
  }

  // How far points lie beside the wires' axes.
  static std::vector<Vec3> Offsets(const SkeletonGraph& skeleton) {
    std::vector<Vec3> offsets;
    const std::vector<RenderedWire> wires = Wires({});
    const std::vector<EdgeId> edges = skeleton.Edges();
    for (size_t e = 0; e < edges.size(); ++e) {
      const Vec3 axis = (wires[e].back - wires[e].front).normalized();
      for (const Vec3& p : skeleton.edge(edges[e]).points) {
        const Vec3 from_front = p - wires[e].front;
        offsets.push_back(from_front - axis * axis.dot(from_front));
      }
    }
    return offsets;
  }

  static Vec3 MeanOffset(const SkeletonGraph& skeleton) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& offset : Offsets(skeleton)) sum += offset;
    return sum / static_cast<double>(Offsets(skeleton).size());
  }

  // Mean distance from the wires' axes after the mean offset, which poses may share, is taken off.
  static double MeanDistance(const SkeletonGraph& skeleton) {
    const Vec3 mean = MeanOffset(skeleton);
    double sum = 0;
    for (const Vec3& offset : Offsets(skeleton)) sum += (offset - mean).norm();
    return sum / static_cast<double>(Offsets(skeleton).size());
  }

  // The same after the motion along which all lie nearest: curves and poses may share one.
  static double DistanceAsMoved(const SkeletonGraph& skeleton) {
    const std::vector<RenderedWire> wires = Wires({});
    const std::vector<EdgeId> edges = skeleton.Edges();
    const std::vector<Vec3> offsets = Offsets(skeleton);
    std::vector<Mat3> across;
    for (size_t e = 0; e < edges.size(); ++e) {
      const Vec3 axis = (wires[e].back - wires[e].front).normalized();
      across.insert(across.end(), skeleton.edge(edges[e]).points.size(),
                    Mat3::Identity() - axis * axis.transpose());
    }
    Mat3 matrix = Mat3::Zero();
    Vec3 rhs = Vec3::Zero();
    for (size_t i = 0; i < offsets.size(); ++i) {
      matrix += across[i];
      rhs += offsets[i];
    }
    const Vec3 motion = matrix.ldlt().solve(rhs);
    double sum = 0;
    for (size_t i = 0; i < offsets.size(); ++i) sum += (offsets[i] - across[i] * motion).norm();
    return sum / static_cast<double>(offsets.size());
  }

  static std::filesystem::path folder_;
};
std::filesystem::path ColourAdjustmentTest::folder_;

TEST_F(ColourAdjustmentTest, CurvesAndPosesFitTheImages) {
  const Sequence sequence = DriftedSequence("green");
  const ColourAdjustment adjusted =
      AdjustToColours(WrongSkeleton(), sequence, {CameraPoses(sequence)}, {.frame_stride = 1});
  EXPECT_EQ(adjusted.skipped, "");
  EXPECT_GT(adjusted.start_residual_px, 1);
  EXPECT_LT(adjusted.residual_px, 0.15);  // what the real cable is asked for
  EXPECT_GT(adjusted.accepted_share, 0.4);
  EXPECT_EQ(adjusted.depths, 0);
  ASSERT_GT(MeanDistance(WrongSkeleton()), 0.001);
  EXPECT_LT(MeanDistance(adjusted.skeleton), 0.0007);  // half a millimetre by the prototype
}

// A video: the camera turns by .02 rad from frame to frame. Colour images lie .6 and -.9 px beside
// the depth images, each by half a pixel more of its own, and depth is fattened.
TEST_F(ColourAdjustmentTest, ColourImagesBesideTheirDepthImages) {
  const Vec2 shift(0.6, -0.9);
  const Vec2 of_frames[kFrames] = {{0.5, 0.5}, {-0.5, 0.5}, {0, -0.5},
                                   {0.5, 0},   {-0.5, 0},   {0, -0.5}};
  Sequence sequence = DriftedSequence("green");
  std::vector<RigidTransform> true_poses;
  for (int i = 0; i < kFrames; ++i) {
    const RigidTransform pose = TruePose(kFrames / 2 + 0.25 * i);
    true_poses.push_back(pose);
    PinholeCamera color_camera = Camera();
    color_camera.cx += shift.x() + of_frames[i].x();
    color_camera.cy += shift.y() + of_frames[i].y();
    SequenceFrame& frame = sequence.frames[i];
    frame.color_path = folder_ / fmt::format("shifted{}.jpg", i);
    frame.depth_path = folder_ / fmt::format("shifted{}.png", i);
    WriteImage(frame.color_path, RenderWires(Wires({60, 160, 70}), color_camera, pose, 0.8));
    WriteDepth(frame.depth_path, RenderWireDepth(Wires({}), Camera(), pose, 2));
    SmallMotion drift;
    drift << 0.0003 * i, -0.0003 * i, 0, 0, 0.0003 * i, 0.0003 * i;
    frame.T_world_camera = pose * RigidTransformOf(drift);
  }
  const ColourAdjustment adjusted = AdjustToColours(
      WrongSkeleton(), sequence, {CameraPoses(sequence)}, {.frame_stride = 1, .axis_depth = 0});
  EXPECT_EQ(adjusted.skipped, "");
  EXPECT_NEAR((adjusted.color_shift_px - shift).norm(), 0, 0.25);
  // Half a pixel is .6 mm.
  EXPECT_LT(MeanOffset(adjusted.skeleton).norm(), 0.0003);
  EXPECT_LT(MeanDistance(adjusted.skeleton), 0.0003);
  // Poses fit their colour images once the common shift is taken off.
  for (int i = 0; i < kFrames; ++i) {
    const Vec3 p = Wires({})[0].front;
    const Vec2 seen = Camera().Project(true_poses[i].inverse() * p) + of_frames[i];
    const Vec2 found = Camera().Project(adjusted.T_world_camera[i].inverse() * p);
    EXPECT_NEAR((found - seen).norm(), 0, 0.3);
  }
}

// A video whose colour images show every wire 2 mm beside where depth images show it, each on
// another side: what colour says of the curves is refused by the frames that were not used.
TEST_F(ColourAdjustmentTest, WhatDepthOfOtherFramesContradictsIsRefused) {
  constexpr int kVideoFrames = 24;
  std::vector<RenderedWire> moved = Wires({60, 160, 70});
  const Vec3 aside[] = {{0, 0.002, 0}, {0, -0.002, 0}, {0.002, 0, 0}, {-0.002, 0, 0}};
  for (size_t i = 0; i < moved.size(); ++i) {
    moved[i].front += aside[i];
    moved[i].back += aside[i];
  }
  Sequence sequence = DriftedSequence("green");
  const SequenceFrame any = sequence.frames[0];
  sequence.frames.assign(kVideoFrames, any);
  for (int i = 0; i < kVideoFrames; ++i) {
    SequenceFrame& frame = sequence.frames[i];
    frame.timestamp = i;
    frame.T_world_camera = TruePose(kFrames / 2 + 0.1 * i);
    frame.color_path = folder_ / fmt::format("beside{}.jpg", i);
    frame.depth_path = folder_ / fmt::format("beside{}.png", i);
    WriteImage(frame.color_path, RenderWires(moved, Camera(), frame.T_world_camera, 0.8));
    WriteDepth(frame.depth_path, RenderWireDepth(Wires({}), Camera(), frame.T_world_camera, 2));
  }
  SkeletonGraph skeleton;
  for (const RenderedWire& wire : Wires({})) {
    const Polyline points = {wire.front, wire.back};
    skeleton.SetCurve(skeleton.AddPolyline(points), points,
                      std::vector<double>(2, 0.5 * wire.diameter));
  }
  const ColourAdjustment adjusted = AdjustToColours(skeleton, sequence, {CameraPoses(sequence)},
                                                    {.frame_stride = 3, .axis_depth = 0});
  EXPECT_NE(adjusted.skipped.find("depth images that were not used"), std::string::npos)
      << adjusted.skipped << adjusted.start_residual_px << " " << adjusted.residual_px;
  EXPECT_TRUE(adjusted.color_shift_px.isZero());
  for (int i = 0; i < kVideoFrames; ++i) {
    EXPECT_EQ(adjusted.T_world_camera[i].matrix(), sequence.frames[i].T_world_camera.matrix());
  }
}

// 7 mm are 6 pixels, more than a strip is wide: at the curves' places is background, and what is
// learned there tells it from nothing.
TEST_F(ColourAdjustmentTest, CurvesBesideAllOfTheirStripsAreFoundByContrast) {
  const Sequence sequence = DriftedSequence("green");
  SkeletonGraph skeleton = WrongSkeleton();
  for (const EdgeId edge : skeleton.Edges()) {
    Polyline points = skeleton.edge(edge).points;
    for (Vec3& p : points) p += Vec3(0.005, 0.005, 0);
    skeleton.SetCurve(edge, points, skeleton.edge(edge).radii);
  }
  const ColourAdjustment adjusted =
      AdjustToColours(skeleton, sequence, {CameraPoses(sequence)}, {.frame_stride = 1});
  EXPECT_EQ(adjusted.skipped, "");
  EXPECT_GT(adjusted.start_residual_px, 3);
  EXPECT_LT(adjusted.residual_px, 0.15);
  EXPECT_GT(adjusted.agreed_share, 0.9);
  EXPECT_LT(DistanceAsMoved(adjusted.skeleton), 0.0007);
}

// Grey wires of the colours of their grey background still are darker than it on one side.
TEST_F(ColourAdjustmentTest, WiresOfTheBackgroundsColoursAreFoundByContrast) {
  const Sequence sequence = DriftedSequence("grey");
  const ColourAdjustment adjusted =
      AdjustToColours(WrongSkeleton(), sequence, {CameraPoses(sequence)}, {.frame_stride = 1});
  EXPECT_EQ(adjusted.skipped, "");
  EXPECT_LT(adjusted.residual_px, 0.15);
  EXPECT_LT(DistanceAsMoved(adjusted.skeleton), 0.001);  // 1.3 mm before
}

TEST_F(ColourAdjustmentTest, WithoutContrastNothingChanges) {
  for (int i = 0; i < kFrames; ++i) WriteFrame(i, {}, "background");
  const Sequence sequence = DriftedSequence("background");
  const ColourAdjustment adjusted =
      AdjustToColours(WrongSkeleton(), sequence, {CameraPoses(sequence)}, {.frame_stride = 1});
  EXPECT_NE(adjusted.skipped, "");
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(adjusted.T_world_camera[i].matrix(), sequence.frames[i].T_world_camera.matrix());
  }
  const EdgeId first = WrongSkeleton().Edges()[0];
  EXPECT_EQ(adjusted.skeleton.edge(first).points, WrongSkeleton().edge(first).points);
}

TEST_F(ColourAdjustmentTest, NoCurvesNoRadiiNoAdjustment) {
  const Sequence sequence = DriftedSequence("green");
  EXPECT_NE(AdjustToColours({}, sequence, {CameraPoses(sequence)}, {}).skipped, "");
  SkeletonGraph without_radii;
  without_radii.AddPolyline({{0, 0, 0.5}, {0.1, 0, 0.5}});
  EXPECT_NE(AdjustToColours(without_radii, sequence, {CameraPoses(sequence)}, {}).skipped, "");
}

// Rungs every 14 mm, nowhere on the bar is 8.8 pixels from all of them, which a strip would need.
TEST_F(ColourAdjustmentTest, ABarWithARowOfWiresIsFoundByItsEdge) {
  const Rgb color{60, 160, 70};
  std::vector<RenderedWire> wires = {{{-0.10, -0.05, 0.5}, {0.10, -0.05, 0.5}, 0.009, color}};
  for (int i = -7; i <= 7; ++i) {
    wires.push_back({{0.014 * i, -0.05, 0.5}, {0.014 * i, 0.04, 0.5}, 0.004, color});
  }
  wires.push_back({{-0.10, 0.09, 0.5}, {0.10, 0.09, 0.5}, 0.004, color});  // tells the colour
  Sequence sequence = DriftedSequence("green");
  for (int i = 0; i < kFrames; ++i) {
    sequence.frames[i].color_path = folder_ / fmt::format("row{}.jpg", i);
    sequence.frames[i].T_world_camera = TruePose(i);
    WriteImage(sequence.frames[i].color_path, RenderWires(wires, Camera(), TruePose(i), 0.8));
  }
  SkeletonGraph skeleton;
  for (RenderedWire wire : wires) {
    for (Vec3* end : {&wire.front, &wire.back}) {
      if (end->y() == -0.05) end->y() += 0.003;  // the bar and where it is reached
    }
    const Polyline points = {wire.front, wire.back};
    const std::vector<double> radii(2, 0.5 * wire.diameter);
    skeleton.SetCurve(skeleton.AddPolyline(points), points, radii);
  }
  const auto mean_error = [&](bool edges) {
    const ColourAdjustment adjusted = AdjustToColours(skeleton, sequence, {CameraPoses(sequence)},
                                                      {.frame_stride = 1, .edges = edges});
    EXPECT_EQ(adjusted.skipped, "");
    double sum = 0;
    const Polyline& bar = adjusted.skeleton.edge(adjusted.skeleton.Edges().front()).points;
    for (const Vec3& p : bar) sum += p.y() + 0.05;
    return sum / static_cast<double>(bar.size());
  };
  EXPECT_GT(std::abs(mean_error(false)), 0.0025);
  // Thick wires are shaded farther in than thin ones.
  EXPECT_LT(std::abs(mean_error(true)), 0.0018);
}

TEST_F(ColourAdjustmentTest, MuchWireHasVerticesFartherApart) {
  SkeletonGraph skeleton = WrongSkeleton();
  const Polyline unseen = {{-11, 0, -1}, {11, 0, -1}};  // behind the cameras
  skeleton.SetCurve(skeleton.AddPolyline(unseen), unseen, {0.002, 0.002});
  const Sequence sequence = DriftedSequence("green");
  const ColourAdjustment adjusted =
      AdjustToColours(skeleton, sequence, {CameraPoses(sequence)}, {.frame_stride = 1});
  EXPECT_EQ(adjusted.skipped, "");
  size_t points = 0;
  for (const EdgeId edge : adjusted.skeleton.Edges()) {
    points += adjusted.skeleton.edge(edge).points.size();
  }
  EXPECT_NEAR(static_cast<double>(points), 5500, 20);  // 7,600 every 3 mm
  EXPECT_LT(adjusted.residual_px, 0.15);
}

TEST_F(ColourAdjustmentTest, OfManyFramesTheFirstAndSomeOthersAreUsed) {
  const Sequence few = DriftedSequence("green");
  Sequence many = few;
  while (many.frames.size() < 400) many.frames.push_back(few.frames[many.frames.size() % kFrames]);
  const ColourAdjustment adjusted =
      AdjustToColours(WrongSkeleton(), many, {CameraPoses(many)}, {.frame_stride = 1});
  EXPECT_EQ(adjusted.skipped, "");
  EXPECT_LT(adjusted.residual_px, 0.15);
  ASSERT_EQ(adjusted.frames.size(), 120u);
  ASSERT_EQ(adjusted.posteriors.size(), 120u);
  EXPECT_EQ(adjusted.T_world_camera.size(), 400u);
  EXPECT_EQ(adjusted.frames[39], 39);
  for (size_t i = 40; i < adjusted.frames.size(); ++i) {
    const int gap = adjusted.frames[i] - adjusted.frames[i - 1];
    EXPECT_GE(gap, 1);
    EXPECT_LE(gap, 5);  // 80 of 360
  }
  EXPECT_GE(adjusted.frames.back(), 395);
}

TEST_F(ColourAdjustmentTest, TheSameForAnyNumberOfThreads) {
  const Sequence sequence = DriftedSequence("green");
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return AdjustToColours(WrongSkeleton(), sequence, {CameraPoses(sequence)}, {});
  };
  const ColourAdjustment one = run(1);
  const ColourAdjustment two = run(2);
  for (const EdgeId edge : one.skeleton.Edges()) {
    EXPECT_EQ(one.skeleton.edge(edge).points, two.skeleton.edge(edge).points);
  }
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(one.T_world_camera[i].matrix(), two.T_world_camera[i].matrix());
  }
}

}  // namespace
}  // namespace curvefusion
