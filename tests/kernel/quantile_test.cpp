#include "kernel/quantile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace curvefusion {
namespace {

TEST(Quantile, IsTheValueOfItsRank) {
  const std::vector<double> values = {5, 1, 4, 2};
  EXPECT_EQ(Quantile(values, 0), 1);
  EXPECT_EQ(Quantile(values, 0.25), 2);
  EXPECT_EQ(Quantile(values, 0.74), 4);
  EXPECT_EQ(Quantile(values, 0.75), 5);
  EXPECT_EQ(Quantile(values, 1), 5);
  EXPECT_EQ(Quantile({7}, 0.5), 7);
}

TEST(Quantile, TheMedianOfAnEvenNumberIsTheGreaterOfTheMiddleTwo) {
  EXPECT_EQ(Median({3, 1, 2}), 2);
  EXPECT_EQ(Median({4, 3, 1, 2}), 3);
}

TEST(Quantile, AgreesWithSorting) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  for (const size_t count : {2u, 7u, 100u, 101u}) {
    std::vector<double> values;
    for (size_t i = 0; i < count; ++i) values.push_back(uniform(random));
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(Median(values), sorted[count / 2]);
    EXPECT_EQ(Quantile(values, 0.75), sorted[3 * count / 4]);
  }
}

TEST(WeightedMedian, HalfOfTheWeightLiesBelow) {
  EXPECT_EQ(WeightedMedian({{3, 1}, {1, 1}, {2, 1}}), 2);
  EXPECT_EQ(WeightedMedian({{3, 10}, {1, 1}, {2, 1}}), 3);
  EXPECT_EQ(WeightedMedian({{2, 1}, {1, 1}}), 1);  // exactly half
  EXPECT_EQ(WeightedMedian({{5, 0}}), 5);
}

TEST(RobustDeviation, OutliersDoNotCount) {
  EXPECT_EQ(RobustDeviation({}), 0);
  EXPECT_DOUBLE_EQ(RobustDeviation({-1, 1, -1, 1, 1000}), kGaussianMad);
}

}  // namespace
}  // namespace curvefusion
