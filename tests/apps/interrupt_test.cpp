#include "apps/interrupt.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/partial_folder.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

// What main does with an error, in a process of its own: the request lasts as long as the process.
[[noreturn]] void ExitAsMainWould() {
  try {
    ThrowIfCancelled();
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

TEST(InterruptDeathTest, ARunThatNeverAsksIsEndedAndLeavesNothing) {
  const fs::path folder = TemporaryPath("interrupt_test");
  EXPECT_EXIT(
      {
        const PartialFolder partial(folder);
        std::ofstream(partial.path() / "half.txt") << "half";
        CatchAndRaise(SIGINT);
        while (true) pause();
      },
      testing::ExitedWithCode(130), "interrupted");
  for (const auto& entry : fs::directory_iterator(folder.parent_path())) {
    EXPECT_NE(entry.path().stem(), folder.filename());
  }
}

TEST(InterruptDeathTest, ASecondSignalEndsTheProgram) {
  EXPECT_EXIT(
      {
        CatchAndRaise(SIGINT);
        std::raise(SIGINT);
      },
      testing::KilledBySignal(SIGINT), "");
}

TEST(InterruptDeathTest, TheFirstOfACaptureOnlyEndsTheCapture) {
  EXPECT_EXIT(
      {
        CatchInterrupts();
        {
          const CaptureInterrupt interrupt;
          if (interrupt.requested()) std::exit(1);
          std::raise(SIGINT);
          if (!interrupt.requested()) std::exit(2);
        }
        ThrowIfCancelled();  // does not: what was captured is still to be reconstructed
        std::exit(3);
      },
      testing::ExitedWithCode(3), "");
}

TEST(InterruptDeathTest, TheSecondOfACaptureEndsTheRun) {
  EXPECT_EXIT(
      {
        CatchInterrupts();
        const CaptureInterrupt interrupt;
        std::raise(SIGINT);
        std::raise(SIGINT);
        ExitAsMainWould();
      },
      testing::ExitedWithCode(130), "");
}

TEST(InterruptDeathTest, OneAfterTheCaptureEndsTheRun) {
  EXPECT_EXIT(
      {
        CatchInterrupts();
        { const CaptureInterrupt interrupt; }
        std::raise(SIGINT);
        ExitAsMainWould();
      },
      testing::ExitedWithCode(130), "");
}

}  // namespace
}  // namespace curvefusion
