#include "apps/interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "kernel/error.h"

namespace curvefusion {
namespace {

// What main does with an error, in a process of its own: the flag lasts as long as the process.
[[noreturn]] void ExitAsMainWould() {
  try {
    ThrowIfInterrupted();
  } catch (const Error& error) {
    std::exit(ExitCode(error.kind()));
  }
  std::exit(0);
}

void CatchAndRaise(int signal) {
  CatchInterrupts();
  std::raise(signal);
}

TEST(InterruptDeathTest, ASignalEndsARunWhereItAsks) {
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EXIT(
        {
          CatchAndRaise(signal);
          ExitAsMainWould();
        },
        testing::ExitedWithCode(130), "");
  }
}

TEST(InterruptDeathTest, WithoutASignalNothingHappens) {
  EXPECT_EXIT(ExitAsMainWould(), testing::ExitedWithCode(0), "");
}

TEST(InterruptDeathTest, ASecondSignalEndsTheProgram) {
  EXPECT_EXIT(
      {
        CatchAndRaise(SIGINT);
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

}  // namespace
}  // namespace curvefusion
