// Rooms without anything thin give no curves.
#include <gtest/gtest.h>

#include <filesystem>

#include "capture/content/colour_findings.h"
#include "capture/sequence.h"
#include "experiments/config.h"
#include "experiments/simulation/families/scan_draw.h"
#include "experiments/simulation/simulate.h"
#include "fusion/pipeline.h"
#include "tests/fusion/plan_follower.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

// A training scan. Of its curves .18 m have probabilities above evidence.min_probability, of .47 on
// average.
TEST(RoomWithoutWires, GivesWhatIsRatherNoWireAsUncertain) {
  const TemporaryFolder folder("room");
  SimulationOptions scan = DrawScan("room", 3);
  scan.frames = 40;
  SimulateScan(scan, folder, NoProgress);
  Sequence sequence = OpenSequence(folder);
  UseFittedColourCamera(sequence);  // as the command does
  PlanFollower follower;
  const Reconstruction result = Reconstruct(sequence, ProfileOptions(Profile::kBest), follower);
  EXPECT_EQ(result.skeleton.TotalLength(), 0);
  EXPECT_GT(result.uncertain.graph.TotalLength(), 0.1);
  EXPECT_EQ(follower.unplanned, std::vector<std::string>());
}

}  // namespace
}  // namespace curvefusion
