#include "fusion/live/sighting_grid.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

// A wire of 100 mm along x with a point a millimetre, seen along -z.
ObservedPoints Wire() {
  ObservedPoints points;
  for (int i = 0; i < 100; ++i) points.Add(Vec3(i * kMillimetre, 0, 0), -Vec3::UnitZ(), 1);
  return points;
}

TEST(SightingGrid, AFrameCountsOnceWhereverItSawManyPoints) {
  SightingGrid grid;
  for (int frame = 0; frame < 7; ++frame) grid.AddFrame(Wire());
  EXPECT_EQ(grid.Around(Vec3(0.05, 0, 0)).frames, 7);
  EXPECT_EQ(grid.Around(Vec3(0.05, 0.1, 0)).frames, 0);
}

TEST(SightingGrid, WhatLiesBesideThePointsIsFound) {
  SightingGrid grid;
  grid.AddFrame(Wire());
  // The axis of a wire 8 mm thick lies so far behind its points; half a cell is always reached.
  for (const double behind : {-0.004, 0.004}) {
    EXPECT_EQ(grid.Around(Vec3(0.05, behind, behind)).frames, 1);
  }
}

TEST(SightingGrid, ViewsPointTowardsTheCamera) {
  SightingGrid grid;
  grid.AddFrame(Wire());
  const ViewDirections views = grid.Around(Vec3(0.05, 0, 0)).views;
  for (int bin = 0; bin < ViewDirections::kBins; ++bin) {
    if (views.count(bin) == 0) continue;
    EXPECT_GT(ViewDirections::Direction(bin).z(), 0.9);
  }
}

TEST(SightingGrid, FramesThatSawTheSameTakeNoMoreMemory) {
  SightingGrid grid;
  grid.AddFrame(Wire());
  const int cells = grid.cell_count();
  EXPECT_EQ(cells, 10);
  for (int frame = 0; frame < 1000; ++frame) grid.AddFrame(Wire());
  EXPECT_EQ(grid.cell_count(), cells);
}

}  // namespace
}  // namespace curvefusion
