#include "fusion/registration/frame_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace curvefusion {
namespace {

// Places 0 to `places` - 1 along the x axis, as every frame names them.
ObservedPoints Line(int places) {
  ObservedPoints points;
  for (int i = 0; i < places; ++i) points.Add({1.0 * i, 0, 0}, Vec3::UnitZ(), 1);
  return points;
}

FramePoints Frames(int count, int places, size_t max_points) {
  FramePoints frames(max_points);
  for (int i = 0; i < count; ++i) frames.Add(Line(places));
  return frames;
}

size_t Total(const std::vector<ObservedPoints>& frames) {
  size_t total = 0;
  for (const ObservedPoints& frame : frames) total += frame.size();
  return total;
}

TEST(FramePoints, FewAreKeptAsTheyAre) {
  FramePoints frames = Frames(10, 100, 1000);
  EXPECT_EQ(frames.stride(), 1u);
  const std::vector<ObservedPoints> kept = std::move(frames).Release();
  ASSERT_EQ(kept.size(), 10u);
  for (const ObservedPoints& frame : kept) {
    EXPECT_EQ(frame.positions, Line(100).positions);
    EXPECT_EQ(frame.viewing_rays, Line(100).viewing_rays);
    EXPECT_EQ(frame.counts, Line(100).counts);
  }
}

TEST(FramePoints, OfManyEveryFrameKeepsAsManyAndEveryPlaceIsSeen) {
  FramePoints frames = Frames(50, 100, 1000);
  EXPECT_EQ(frames.stride(), 8u);  // 5000 of them by 1000, in powers of two
  const std::vector<ObservedPoints> kept = std::move(frames).Release();
  EXPECT_LE(Total(kept), 1000u);
  EXPECT_GT(Total(kept), 500u);
  std::vector<int> seen(100);
  for (const ObservedPoints& frame : kept) {
    EXPECT_NEAR(static_cast<double>(frame.size()), 100.0 / 8, 1.5);
    for (const Vec3& p : frame.positions) ++seen[static_cast<size_t>(p.x())];
  }
  EXPECT_GE(*std::min_element(seen.begin(), seen.end()), 1);  // of some 6
}

TEST(FramePoints, MemoryDoesNotGrowWithTheNumberOfFrames) {
  for (const int count : {20, 100, 500}) {
    EXPECT_LE(Total(Frames(count, 100, 1000).Release()), 1000u);
  }
}

TEST(FramePoints, FramesWithoutPointsHaveTheirPlace) {
  FramePoints frames(10);
  frames.Add(Line(8));
  frames.Add({});
  frames.Add(Line(8));
  const std::vector<ObservedPoints> kept = std::move(frames).Release();
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0].size(), 4u);
  EXPECT_TRUE(kept[1].empty());
  EXPECT_EQ(kept[2].size(), 4u);
}

}  // namespace
}  // namespace curvefusion
