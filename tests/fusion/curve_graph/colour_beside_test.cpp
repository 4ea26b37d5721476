#include "fusion/curve_graph/colour_beside.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernel/polyline.h"

namespace curvefusion {
namespace {

const PinholeCamera kCamera = {320, 240, 400, 400, 160, 120};
constexpr double kDistance = 0.5;  // metres, of the curve

// A plane across the view that has patches of some millimetres.
ColorImage ImageOfPlane(const Vec3& camera, double plane_z, double contrast) {
  ColorImage image(kCamera.width, kCamera.height);
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Vec3 p = camera + kCamera.Unproject(u, v, plane_z - camera.z());
      const double wave = std::sin(p.x() / 0.005) * std::cos(p.y() / 0.007);
      const auto grey = static_cast<uint8_t>(128 + contrast * wave);
      image(u, v) = {grey, grey, grey};
    }
  }
  return image;
}

std::vector<CurvePlace> Line() {
  std::vector<CurvePlace> places;
  for (int i = 0; i < 9; ++i)
    places.push_back({0, 0.004 * i, 0.003, {0.01, 0.004 * (i - 4), kDistance}, Vec3::UnitY()});
  return places;
}

// What a line is told of by cameras on an arc of 24 cm around it, before a plane; with other curves
// to leave out, and others that the images show.
ColourChange Change(double plane_z, double contrast, int cameras = 12,
                    const std::vector<CurvePlace>& left_out = {},
                    const std::vector<CurvePlace>& drawn = {}) {
  ColourBeside beside(Line());
  beside.LeaveOut(OnCurves(left_out));
  for (int i = 0; i < cameras; ++i) {
    const Vec3 center(0.02 * (i - 5.5), 0.01 * (i % 3), 0);
    RigidTransform T_camera_world = RigidTransform::Identity();
    T_camera_world.translation() = -center;
    ColorImage image = ImageOfPlane(center, plane_z, contrast);
    for (const CurvePlace& place : drawn) {
      const Eigen::Vector2i at =
          PinholeCamera::Rounded(kCamera.Project(Vec3(T_camera_world * place.position)));
      for (int v = -3; v <= 3; ++v) image(at.x(), at.y() + v) = {40, 40, 40};
    }
    beside.Look(image, kCamera, T_camera_world, CurvesInFront({}, kCamera, T_camera_world));
  }
  return beside.Change();
}

TEST(ColourBeside, PastAWireAllDirectionsChange) {
  const ColourChange wire = Change(kDistance + 0.2, 60);
  EXPECT_GT(wire.most, 20);
  EXPECT_GT(wire.least, 0.6 * wire.most);
}

TEST(ColourBeside, OnASurfaceItsOwnColourStays) {
  const ColourChange printed = Change(kDistance, 60);
  EXPECT_LT(printed.least, 0.4 * Change(kDistance + 0.2, 60).least);
  EXPECT_LT(printed.least, 0.6 * printed.most);
}

TEST(ColourBeside, AnEvenBackgroundTellsNothing) { EXPECT_LT(Change(kDistance + 0.2, 0).most, 1); }

// A dark wire before a wall whose brightness drifts: near or far, it would look the same.
TEST(ColourBeside, WhatIsEvenAndOfAnotherColourIsLeftOut) {
  const auto change_before_wall = [](uint8_t wire) {
    ColourBeside beside(Line());
    for (int i = 0; i < 12; ++i) {
      const auto wall = static_cast<uint8_t>(200 + 4 * (i % 3));
      ColorImage image(kCamera.width, kCamera.height, Rgb{wall, wall, wall});
      for (int v = 0; v < image.height(); ++v)
        for (int u = 164; u <= 172; ++u) image(u, v) = {wire, wire, wire};
      beside.Look(image, kCamera, RigidTransform::Identity(),
                  CurvesInFront({}, kCamera, RigidTransform::Identity()));
    }
    return beside.Change();
  };
  EXPECT_EQ(change_before_wall(20).most, 0);
  EXPECT_GT(change_before_wall(200).most, 1);  // of the wall's own colour: may be printed on it
}

TEST(ColourBeside, IsNotKnownFromFewImages) {
  EXPECT_EQ(Change(kDistance + 0.2, 60, 5).most, 0);
  EXPECT_EQ(ColourBeside(Line()).Change().most, 0);
}

TEST(ColourBeside, AnotherCurveBesideItLeavesItUnknown) {
  std::vector<CurvePlace> next = Line();
  for (CurvePlace& place : next) place.position.x() += 0.01;
  EXPECT_EQ(Change(kDistance + 0.2, 60, 12, next).most, 0);
}

// Beside the line, where they cross it, their colour stays the same in all images.
TEST(ColourBeside, CurvesThatCrossAreNoSurface) {
  std::vector<CurvePlace> crossing;
  for (const double y : {-0.008, 0.008})
    for (int i = -30; i <= 30; ++i)
      crossing.push_back({1, 0, 0.003, {0.01 + 0.001 * i, y, kDistance}, Vec3::UnitX()});
  const ColourChange taken_for_surface = Change(kDistance + 0.2, 60, 12, {}, crossing);
  EXPECT_GT(Change(kDistance + 0.2, 60, 12, crossing, crossing).most, 1.3 * taken_for_surface.most);
}

// A line on a surface, before which nearer dark bars stand: each image shows them elsewhere.
TEST(ColourBeside, BarsInFrontAreNotTakenForWhatLiesBehind) {
  constexpr double kBar = 0.006, kBarDepth = 0.3;
  SkeletonGraph bars;
  for (int i = -8; i <= 8; ++i) {
    const Polyline points =
        Resample(Polyline{{0.02 * i, -0.1, kBarDepth}, {0.02 * i, 0.1, kBarDepth}}, 0.005);
    bars.SetCurve(bars.AddPolyline(points), points, std::vector<double>(points.size(), kBar / 2));
  }
  const auto least_change = [&](const SkeletonGraph& known) {
    ColourBeside beside(Line());
    for (int i = 0; i < 30; ++i) {
      const Vec3 center(0.006 * (i - 14.5), 0, 0);
      RigidTransform T_camera_world = RigidTransform::Identity();
      T_camera_world.translation() = -center;
      ColorImage image = ImageOfPlane(center, kDistance, 60);
      for (int v = 0; v < image.height(); ++v) {
        for (int u = 0; u < image.width(); ++u) {
          const double x = (center + kCamera.Unproject(u, v, kBarDepth)).x();
          if (std::abs(std::remainder(x, 0.02)) < kBar / 2) image(u, v) = {10, 10, 10};
        }
      }
      beside.Look(image, kCamera, T_camera_world, CurvesInFront(known, kCamera, T_camera_world));
    }
    return beside.Change().least;
  };
  EXPECT_GT(least_change({}), 20);
  EXPECT_LT(least_change(bars), 0.3 * least_change({}));
}

TEST(Smoothed, IsTheMeanOfThePixelsAround) {
  ColorImage image(5, 5, Rgb{0, 0, 0});
  image(2, 2) = {90, 180, 9};
  const ColorImage smoothed = Smoothed(image);
  EXPECT_EQ(smoothed(1, 1), (Rgb{10, 20, 1}));
  EXPECT_EQ(smoothed(0, 0), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace curvefusion
