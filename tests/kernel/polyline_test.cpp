#include "kernel/polyline.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvefusion {
namespace {

Polyline Helix(int n) {
  Polyline points;
  for (int i = 0; i <= n; ++i) {
    const double angle = 2 * M_PI * i / n;
    points.emplace_back(std::cos(angle), std::sin(angle), angle);
  }
  return points;
}

// One turn of a helix of radius 1 and pitch 2 pi is 2 pi sqrt(2) long; a polyline of 1000 segments
// is shorter by a relative angle^2 / 24, about 1e-6.
TEST(Polyline, LengthOfAHelix) {
  EXPECT_NEAR(Length(Helix(1000)), 2 * M_PI * std::sqrt(2.0), 1e-4);
}

TEST(Polyline, ResampleKeepsEndsAndSpacesEvenly) {
  const Polyline helix = Helix(200);
  const Polyline resampled = Resample(helix, 0.1);
  EXPECT_EQ(resampled.front(), helix.front());
  EXPECT_EQ(resampled.back(), helix.back());
  EXPECT_EQ(resampled.size(), 90u);  // 8.885 / 0.1 rounds to 89 segments
  for (size_t i = 1; i < resampled.size(); ++i) {
    EXPECT_NEAR((resampled[i] - resampled[i - 1]).norm(), Length(helix) / 89,
                1e-4);  // chords cut corners
  }
}

TEST(Polyline, ResampleOfAPointIsThePoint) {
  EXPECT_EQ(Resample({Vec3(1, 2, 3)}, 0.1).size(), 1u);
  EXPECT_EQ(Resample({Vec3(1, 2, 3), Vec3(1, 2, 3)}, 0.1).size(), 2u);
}

TEST(Polyline, ProjectFindsArcLengthAndDistance) {
  const Polyline corner = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  EXPECT_DOUBLE_EQ(Project(corner, {0.25, -2, 0}).arc_length, 0.25);
  EXPECT_DOUBLE_EQ(Project(corner, {0.25, -2, 0}).distance, 2);
  EXPECT_DOUBLE_EQ(Project(corner, {3, 0.5, 0}).arc_length, 1.5);
  EXPECT_DOUBLE_EQ(Project({Vec3(1, 0, 0)}, {0, 0, 0}).distance, 1);
}

TEST(Polyline, PointAtClampsToTheEnds) {
  const Polyline line = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const auto cumulative = CumulativeLength(line);
  EXPECT_EQ(PointAt(line, cumulative, -1), line.front());
  EXPECT_EQ(PointAt(line, cumulative, 9), line.back());
  EXPECT_EQ(PointAt(line, cumulative, 1.5), Vec3(1.5, 0, 0));
}

TEST(Polyline, TangentsOfALineAreItsDirection) {
  for (const Vec3& t : Tangents({{0, 0, 0}, {0, 2, 0}, {0, 3, 0}})) EXPECT_EQ(t, Vec3(0, 1, 0));
}

}  // namespace
}  // namespace curvefusion
