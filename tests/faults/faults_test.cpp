// Every write and every allocation of every command that writes files fails in turn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "tests/faults/trials.h"

namespace curvefusion {
namespace {

constexpr int kMostMessages = 10;  // of one command; more of them tell nothing new

class FaultTest : public testing::TestWithParam<WritingCommand> {
 protected:
  static void SetUpTestSuite() {
    if (CanInjectFaults()) folder_ = new TrialFolder;
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  void SetUp() override {
    if (!CanInjectFaults()) GTEST_SKIP() << "a sanitizer takes the place of the allocator";
    static std::map<std::string, References> known;
    const auto [place, is_new] = known.try_emplace(GetParam().name);
    if (is_new) place->second = folder_->MakeReferences(GetParam());
    references_ = place->second;
  }

  // How many such operations a run makes.
  long Count(const Disturbance& disturbance) const {
    folder_->Prepare({});
    return folder_->Run(GetParam(), disturbance).operations;
  }

  // Runs the command with this disturbance on an earlier result or on nothing.
  void Try(const Disturbance& disturbance, bool on_earlier) {
    const Files& before = on_earlier ? references_.earlier : references_.none;
    folder_->Prepare(before);
    const ProgramRun run = folder_->Run(GetParam(), disturbance);
    if (run.failed.empty()) return;  // runs with an earlier result make fewer operations
    ++tried_;
    ++ends_[run.exit_code];
    const std::string fault = FaultOf(run, folder_->Found(), before, references_);
    if (fault.empty()) return;
    if (++faults_ <= kMostMessages) {
      ADD_FAILURE() << fmt::format(
          "{} {}{} ({}){}: {}\n{}", GetParam().name, run.failed,
          disturbance.count == 0 ? " and more" : "",
          disturbance.error == 0 ? "no memory" : std::strerror(disturbance.error),
          on_earlier ? " on an earlier result" : "", fault, run.output);
    }
  }

  // For the documents: how many of how many ended how.
  void Tell(const char* what, long operations) const {
    fmt::print("{:<14} {:>8} {}, {} made to fail: {} exit 5, {} exit 0, {} wrong\n",
               GetParam().name, operations, what, tried_, ends_.contains(5) ? ends_.at(5) : 0,
               ends_.contains(0) ? ends_.at(0) : 0, faults_);
  }

  static TrialFolder* folder_;
  References references_;
  int tried_ = 0;
  int faults_ = 0;
  std::map<int, int> ends_;
};
TrialFolder* FaultTest::folder_ = nullptr;

// `wanted` numbers from 1 to `last`, evenly spread but for chance within each step.
std::set<long> Spread(long last, long wanted, std::mt19937& random) {
  std::set<long> numbers;
  const double step = std::max(1.0, static_cast<double>(last) / static_cast<double>(wanted));
  for (double begin = 1; begin <= static_cast<double>(last); begin += step) {
    const double chance = std::uniform_real_distribution<double>(0, step)(random);
    numbers.insert(std::min(last, static_cast<long>(begin + (step > 1 ? chance : 0))));
  }
  return numbers;
}

class WriteFaultTest : public FaultTest {};

TEST_P(WriteFaultTest, LeavesNothingHalfWritten) {
  const long writes = Count({.kind = "write"});
  ASSERT_GT(writes, 2) << "at least a file is opened, written and renamed";
  std::mt19937 random(1);
  // Each of reconstruct and live takes 0.6 s, of the others some hundredths.
  const long some = GetParam().name == "reconstruct" ? 8 : 5;
  for (const long number : Spread(writes, TriesEverything() ? writes : some, random)) {
    for (const int error : {ENOSPC, EIO}) {
      if (!TriesEverything() && error != (number % 2 == 0 ? ENOSPC : EIO)) continue;
      // From a full device nothing can be written any more; other failures pass.
      const long count = error == ENOSPC ? 0 : 1;
      const bool on_earlier = GetParam().replaces && (number + (error == EIO ? 1 : 0)) % 4 < 2;
      Try({.kind = "write", .first = number, .count = count, .error = error}, on_earlier);
    }
  }
  Tell("writes", writes);
}

class AllocationFaultTest : public FaultTest {};

TEST_P(AllocationFaultTest, EndsWithExitCodeFive) {
  const long allocations = Count({.kind = "allocation"});
  ASSERT_GT(allocations, 100);
  std::mt19937 random(2);
  const bool is_slow = GetParam().name == "reconstruct";
  const long some = is_slow ? 4 : 2;
  const long many = is_slow ? 1000 : 300;
  // The command line is taken apart early, where allocations are most unlike one another.
  std::set<long> numbers = Spread(allocations, TriesEverything() ? many : some, random);
  numbers.merge(Spread(std::min(allocations, 2000L), TriesEverything() ? 200 : 2, random));
  for (const long number : numbers) {
    // One alone, or all until something is freed.
    Try({.kind = "allocation", .first = number, .count = number % 2},
        GetParam().replaces && number % 4 < 2);
  }
  Tell("allocations", allocations);
}

// What is small comes from what was freed before, what is large no longer comes at all: so ends a
// limit on address space.
TEST_P(AllocationFaultTest, EndsWithExitCodeFiveWhereOnlyLittleIsLeft) {
  constexpr long kLarge = 1 << 16;
  const long allocations = Count({.kind = "allocation", .least_bytes = kLarge});
  std::mt19937 random(4);
  const long some = GetParam().name == "reconstruct" ? 4 : 2;
  for (const long number : Spread(allocations, TriesEverything() ? 200 : some, random)) {
    Try({.kind = "allocation", .first = number, .count = allocations, .least_bytes = kLarge},
        GetParam().replaces && number % 2 == 0);
  }
  Tell("large allocations", allocations);
}

const auto kName = [](const auto& parameter) { return parameter.param.name; };
INSTANTIATE_TEST_SUITE_P(Commands, WriteFaultTest, testing::ValuesIn(WritingCommands()), kName);
INSTANTIATE_TEST_SUITE_P(Commands, AllocationFaultTest, testing::ValuesIn(WritingCommands()),
                         kName);

}  // namespace
}  // namespace curvefusion
