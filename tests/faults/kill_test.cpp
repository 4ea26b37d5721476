// Runs are killed at random times: what lies under a final name is of an earlier run or complete,
// and the next run removes what the killed ones left.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/faults/trials.h"

namespace curvefusion {
namespace {

constexpr int kKillsToRerun = 20;  // after so many kills a run is left alone
constexpr uint32_t kSeed = 3;

struct KilledCommand {
  std::string name;
  int kills;       // of `./run faults`; 1,100 together
  int some_kills;  // of ctest
};

class KillTest : public testing::TestWithParam<KilledCommand> {};

TEST_P(KillTest, LeavesNothingCorrupt) {
  const TrialFolder folder;
  const WritingCommand command = CommandNamed(GetParam().name);
  const References references = folder.MakeReferences(command);
  const int kills = TriesEverything() ? GetParam().kills : GetParam().some_kills;
  std::mt19937 random(kSeed);
  int early = 0, reruns = 0;
  double duration = folder.Duration(command);
  folder.Prepare(references.earlier);
  for (int kill = 1; kill <= kills; ++kill) {
    const double after = std::uniform_real_distribution<double>(0, duration)(random);
    const ProgramRun run = folder.Run(command, {.signal_after = after});
    early += run.signal != 0 ? 1 : 0;
    const Files found = folder.Found();
    ASSERT_EQ(KillFaultOf(found, references), "") << fmt::format("killed after {} s", after);
    const bool is_done = found.contains("out/") && !command.replaces;
    if (kill % kKillsToRerun != 0 && kill != kills && !is_done) continue;
    if (!is_done) {
      const ProgramRun rerun = folder.Run(command);
      ASSERT_EQ(rerun.exit_code, 0) << rerun.output;
      ASSERT_EQ(Difference(folder.Found(), references.result), "none");
      ++reruns;
    }
    duration = folder.Duration(command);
    folder.Prepare(references.earlier);
  }
  fmt::print("{:<14} {} kills, {} before its end; {} undisturbed runs after them\n", command.name,
             kills, early, reruns);
  EXPECT_GT(4 * early, kills) << "half of them come too late where the machine is free again";
}

const auto kName = [](const auto& parameter) { return parameter.param.name; };
INSTANTIATE_TEST_SUITE_P(Commands, KillTest,
                         testing::Values(KilledCommand{"reconstruct", 550, 6},
                                         KilledCommand{"shard", 100, 4},
                                         KilledCommand{"simulate", 150, 4},
                                         KilledCommand{"contract", 150, 4},
                                         KilledCommand{"mesh_ply", 150, 4}),
                         kName);

}  // namespace
}  // namespace curvefusion
