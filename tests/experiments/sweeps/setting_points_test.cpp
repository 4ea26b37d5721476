#include "experiments/sweeps/setting_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "kernel/error.h"

namespace curvefusion {
namespace {

using testing::ElementsAre;

// In how many of `slices` equal slices of an axis a point lies.
size_t FilledSlices(const std::vector<std::vector<double>>& samples, int axis, int slices) {
  std::set<int> filled;
  for (const auto& point : samples) filled.insert(static_cast<int>(point[axis] * slices));
  return filled.size();
}

TEST(UnitSamples, LatinHypercubeHasAPointInEverySlice) {
  for (const int points : {1, 7, 20}) {
    const auto samples = UnitSamples(Sampling::kLatinHypercube, points, 5, 3);
    for (int axis = 0; axis < 5; ++axis) {
      EXPECT_EQ(FilledSlices(samples, axis, points), static_cast<size_t>(points));
    }
  }
}

// A power of two of Sobol points is a net: one point in each slice of every axis, and in each of
// 4 x 4 squares of the first two axes, whatever the digits they are shifted by.
TEST(UnitSamples, SobolPointsAreANet) {
  for (const uint64_t seed : {1, 2, 77}) {
    const auto samples = UnitSamples(Sampling::kSobol, 16, 12, seed);
    for (int axis = 0; axis < 12; ++axis) EXPECT_EQ(FilledSlices(samples, axis, 16), 16u);
    std::set<std::pair<int, int>> squares;
    for (const auto& p : samples) {
      squares.emplace(static_cast<int>(p[0] * 4), static_cast<int>(p[1] * 4));
    }
    EXPECT_EQ(squares.size(), 16u);
  }
}

TEST(UnitSamples, DependOnTheSeedAloneAndLieInTheCube) {
  for (const std::string& name : SamplingNames()) {
    const auto samples = UnitSamples(SamplingNamed(name), 50, 3, 5);
    EXPECT_EQ(samples, UnitSamples(SamplingNamed(name), 50, 3, 5)) << name;
    EXPECT_NE(samples, UnitSamples(SamplingNamed(name), 50, 3, 6)) << name;
    for (const auto& point : samples) {
      for (const double x : point) EXPECT_TRUE(x >= 0 && x < 1) << name;
    }
  }
  EXPECT_THROW(SamplingNamed("sobel"), Error);
}

TEST(SettingPoints, GridHasAllCombinations) {
  EXPECT_THAT(GridPoints({{"a.b", {"1", "2"}}, {"c.d", {"true"}}}),
              ElementsAre(ElementsAre("a.b=1", "c.d=true"), ElementsAre("a.b=2", "c.d=true")));
}

TEST(SettingPoints, SamplesStayInTheirRangesAndKeepTheirType) {
  const std::vector<SettingRange> ranges = {{"bundle.min_frames", 1, 5},
                                            {"ridge_projection.kernel_sigma", 0.0005, 0.05, true}};
  const auto points = SampledPoints(ranges, {Sampling::kLatinHypercube, 40, 1}, Profile::kBest);
  ASSERT_EQ(points.size(), 40u);
  int below = 0;
  for (const SettingPoint& point : points) {
    EXPECT_NO_THROW(ReadConfig({Profile::kBest, {}, point}));  // refuses 2.5 frames
    const double value = std::stod(point[1].substr(point[1].find('=') + 1));
    EXPECT_TRUE(value >= 0.0005 && value <= 0.05) << value;
    below += value < 0.005 ? 1 : 0;
  }
  EXPECT_EQ(below, 20);  // half of the slices lie below the geometric middle
}

TEST(SettingPoints, RefusesRangesThatAreNone) {
  const auto sample = [](const SettingRange& range) {
    SampledPoints({range}, {Sampling::kRandom, 2, 1}, Profile::kBest);
  };
  EXPECT_THROW(sample({"ridge_projection.kernel_sigma", 0.02, 0.01}), Error);
  EXPECT_THROW(sample({"ridge_projection.kernel_sigma", 0, 0.01, true}), Error);
  EXPECT_THROW(sample({"colour_adjustment.enabled", 0, 1}), Error);
}

}  // namespace
}  // namespace curvefusion
