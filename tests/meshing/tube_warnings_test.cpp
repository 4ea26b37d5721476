#include "meshing/tube_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TubeWarnings, TellOfAnAssumedThickness) {
  SkeletonGraph skeleton;
  const EdgeId edge = skeleton.AddPolyline({{0, 0, 0}, {0, 0, 1}});
  skeleton.AddPolyline({{1, 0, 0}, {1, 0, 1}});
  skeleton.SetCurve(edge, skeleton.edge(edge).points, {0.002, 0.002});
  const TubeOptions options{.default_radius = 0.003};
  EXPECT_THAT(TubeWarnings(skeleton, {}, options),
              ElementsAre(HasSubstr("1 of 2 curves is unknown; 6 mm was assumed")));
}

TEST(TubeWarnings, TellOfJunctionsThatTookSeveralAttempts) {
  TubeMesh tubes;
  tubes.fallbacks.push_back({{0.1, 0.2, 0.3}, 5, 3, "moved by 1 um"});
  EXPECT_THAT(
      TubeWarnings({}, tubes, {}),
      ElementsAre(HasSubstr("5 tubes that meet at (0.100, 0.200, 0.300) m took 3 attempts")));
}

TEST(TubeWarnings, AreNoneWhereAllIsWell) { EXPECT_THAT(TubeWarnings({}, {}, {}), IsEmpty()); }

}  // namespace
}  // namespace curvefusion
