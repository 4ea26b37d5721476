#include "fusion/segmentation/floating_sheets.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

const PinholeCamera kCamera{160, 120, 145, 145, 79.5, 59.5};

// A wall at two metres and a board of 40 x 60 pixels at one metre; `standing`: on a floor that runs
// from the board's lower edge to the wall.
DepthImage Room(bool standing) {
  DepthImage depth(160, 120, 2.0f);
  for (int v = 90; standing && v < 120; ++v) {
    for (int u = 0; u < 160; ++u) depth(u, v) = 1.0f;
  }
  for (int v = 30; v < 90; ++v) {
    for (int u = 60; u < 100; ++u) depth(u, v) = 1.0f;
  }
  return depth;
}

TEST(FloatingSheets, AreWhatHangsTogetherWithNothing) {
  const DepthImage room = Room(false);
  const MaskImage floating = FloatingSheets(room, room);
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 160; ++u) EXPECT_EQ(floating(u, v), room(u, v) < 1.5f);
  }
}

TEST(FloatingSheets, AreNotWhatStandsOnSomething) {
  const DepthImage room = Room(true);
  EXPECT_EQ(FloatingSheets(room, room)(80, 60), 0);
}

TEST(FloatingSheets, AreNotHoleEdgesOrNothing) {
  // A far board seen through a window: what surrounds it is nearer.
  DepthImage room(160, 120, 1.0f);
  for (int v = 30; v < 90; ++v) {
    for (int u = 60; u < 100; ++u) room(u, v) = 2.0f;
  }
  EXPECT_EQ(FloatingSheets(room, room)(80, 60), 0);
  const DepthImage nothing(160, 120, 0.0f);
  const MaskImage floating = FloatingSheets(nothing, nothing);
  for (size_t i = 0; i < floating.size(); ++i) EXPECT_EQ(floating.data()[i], 0);
}

TEST(SheetGrid, MarksWhatFloatsInEnoughViews) {
  const DepthImage room = Room(false);
  const MaskImage none(160, 120, 0);
  const RigidTransform pose = RigidTransform::Identity();
  SheetGrid often, seldom;
  for (int i = 0; i < 10; ++i) {
    often.AddFrame(i < 5 ? FloatingSheets(room, room) : none, room, kCamera, pose);
    seldom.AddFrame(i < 1 ? FloatingSheets(room, room) : none, room, kCamera, pose);
  }
  often.Pool();
  seldom.Pool();
  EXPECT_TRUE(seldom.empty());
  EXPECT_EQ(seldom.Mask(room, kCamera, pose)(80, 60), 0);
  const MaskImage sheets = often.Mask(room, kCamera, pose);
  EXPECT_EQ(sheets(80, 60), 1);
  EXPECT_EQ(sheets(20, 60), 0);
  EXPECT_TRUE(often.Contains(kCamera.Unproject(80, 60, 1.0)));
  EXPECT_FALSE(often.Contains(kCamera.Unproject(80, 60, 2.0)));
}

}  // namespace
}  // namespace curvefusion
