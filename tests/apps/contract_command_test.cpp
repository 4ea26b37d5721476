// Runs `curvefusion contract` as a user does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "graph/graph_figures.h"
#include "graph/io/graph_io.h"
#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

using testing::HasSubstr;

class ContractCommand : public CommandLine {
 protected:
  // Points on two wires of 4 mm and 200 mm that cross at their middles, with `more` behind them.
  void WriteCross(const std::string& file, double unit, const std::vector<Vec3>& more = {}) const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> along(-0.1, 0.1);
    std::uniform_real_distribution<double> around(0, 2 * std::numbers::pi);
    std::vector<Vec3> points;
    for (int i = 0; i < 4000; ++i) {
      const double angle = around(random);
      const Vec3 p(along(random), 0.002 * std::cos(angle), 0.002 * std::sin(angle));
      points.push_back(i % 2 == 0 ? p : Vec3(p.y(), p.x(), p.z()));
    }
    points.insert(points.end(), more.begin(), more.end());
    std::ofstream stream(folder_ / file);
    for (const Vec3& p : points) stream << (p / unit).transpose() << '\n';
  }

  void ExpectCross(const std::string& file) const {
    const GraphFigures figures = MeasureGraph(ReadSkeleton(folder_ / file));
    EXPECT_EQ(figures.edges, 4);
    EXPECT_EQ(figures.junctions, 1);
    EXPECT_EQ(figures.free_ends, 4);
    EXPECT_NEAR(figures.length, 0.4, 0.02);
  }
};

TEST_F(ContractCommand, FindsTheCurvesOfACloudInMetresAndInMillimetres) {
  WriteCross("metres.xyz", 1);
  const Outcome metres = Run("contract metres.xyz -o metres.json");
  EXPECT_EQ(metres.exit_code, 0);
  EXPECT_THAT(metres.output, HasSubstr("Found 4 curves"));
  EXPECT_THAT(metres.output, Not(HasSubstr("millimetres")));
  ExpectCross("metres.json");

  WriteCross("millimetres.xyz", kMillimetre);
  const Outcome millimetres = Run("contract millimetres.xyz -o millimetres.json");
  EXPECT_THAT(millimetres.output, HasSubstr("Coordinates are taken as millimetres"));
  ExpectCross("millimetres.json");
}

TEST_F(ContractCommand, OutliersMoveNeitherTheUnitNorTheCurves) {
  WriteCross("outliers.xyz", 1, {{2000, 0, 0}, {0, -3e7, 0}});
  const Outcome outcome = Run("contract outliers.xyz -o outliers.json");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.output, Not(HasSubstr("millimetres")));
  ExpectCross("outliers.json");
}

TEST_F(ContractCommand, ARadiusBecomesThatOfEveryCurve) {
  WriteCross("cross.xyz", 1);
  EXPECT_THAT(Run("contract cross.xyz -o cross.json --radius 2").output,
              HasSubstr("diameter 4.0 mm"));
}

TEST_F(ContractCommand, NothingThinIsFour) {
  std::ofstream(folder_ / "few.xyz") << "0 0 0\n1 0 0\n0 1 0\n";
  const Outcome outcome = Run("contract few.xyz -o few.json");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.output, HasSubstr("no curve in the 3 points of few.xyz"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "few.json"));
}

}  // namespace
}  // namespace curvefusion
