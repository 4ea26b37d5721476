#include "fusion/strips/wire_gauges.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

TEST(FindGaugesTest, GroupsWiresAroundTheBestMeasuredOnes) {
  // Two of about 5 mm, badly measured ones of 4.2 and 8, and well measured ones of 11.
  const auto gauges =
      FindGauges({{0.0042, 10}, {0.005, 40}, {0.0051, 60}, {0.008, 6}, {0.011, 90}});
  ASSERT_EQ(gauges.size(), 2u);  // six strips are too few for a gauge
  EXPECT_EQ(gauges[0].diameter, 0.0051);
  EXPECT_EQ(gauges[0].strips, 110);
  EXPECT_EQ(gauges[1].diameter, 0.011);
}

TEST(FindGaugesTest, WiresThatAreHardlyMeasuredCountTogether) {
  const auto gauges = FindGauges({{0.0045, 8}, {0.0044, 7}, {0.0046, 6}});
  ASSERT_EQ(gauges.size(), 1u);
  EXPECT_EQ(gauges[0].diameter, 0.0045);
  EXPECT_TRUE(FindGauges({{0.0045, 8}, {0.0044, 7}}).empty());
  EXPECT_TRUE(FindGauges({}).empty());
}

TEST(FindGaugesTest, TheOrderOfWiresDoesNotMatter) {
  const std::vector<MeasuredDiameter> wires = {{0.004, 30}, {0.0047, 30}, {0.0055, 30}};
  const auto forward = FindGauges(wires);
  const auto backward = FindGauges({wires.rbegin(), wires.rend()});
  ASSERT_EQ(forward.size(), backward.size());
  for (size_t i = 0; i < forward.size(); ++i) {
    EXPECT_EQ(forward[i].diameter, backward[i].diameter);
  }
}

TEST(DrawnToGaugeTest, IsTheMeanWeightedByStrips) {
  const std::vector<MeasuredDiameter> gauges = {{0.005, 500}, {0.011, 500}};
  EXPECT_DOUBLE_EQ(DrawnToGauge({0.0048, 100}, gauges, 100), 0.0049);
  EXPECT_DOUBLE_EQ(DrawnToGauge({0.0048, 100}, gauges, 0), 0.0048);
  EXPECT_DOUBLE_EQ(DrawnToGauge({0.0104, 300}, gauges, 100), 0.01055);
}

TEST(DrawnToGaugeTest, AWireOfItsOwnGaugeStaysAsItIs) {
  const std::vector<MeasuredDiameter> gauges = {{0.005, 500}};
  EXPECT_EQ(DrawnToGauge({0.008, 20}, gauges, 100), 0.008);
  // Too few strips to be that sure.
  EXPECT_EQ(DrawnToGauge({0.008, 19}, gauges, 100), 0.005);
  EXPECT_EQ(DrawnToGauge({0.008, 19}, {}, 100), 0.008);
}

}  // namespace
}  // namespace curvefusion
