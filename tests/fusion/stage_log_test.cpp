#include "fusion/stage_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvefusion {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(StageLog, CountsOfRoundsAddUp) {
  StageLog log;
  for (const double added : {0.5, 0.25}) {
    const StageLog::Timer timer(log, "wires");
    log.Count("wires", "points", 100 * added);
    log.CountMore("wires", "added, m", added);
  }
  ASSERT_EQ(log.stages().size(), 1u);
  EXPECT_THAT(log.stages()[0].counts, ElementsAre(Pair("points", 25), Pair("added, m", 0.75)));
}

}  // namespace
}  // namespace curvefusion
