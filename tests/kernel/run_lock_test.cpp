#include "kernel/run_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "kernel/error.h"
#include "kernel/process_mark.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class RunLockFile : public testing::Test {
 protected:
  // The message of the refusal; empty where the lock was given.
  std::string Refusal() const {
    try {
      const RunLock lock(file_, "out");
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kBusy);
      return error.what();
    }
    return "";
  }

  const TemporaryFolder folder_{"run_lock"};
  const fs::path file_ = folder_ / "curvefusion.lock";
};

TEST_F(RunLockFile, TheSecondIsToldWhoHoldsItAndTheFileGoesWithTheFirst) {
  {
    const RunLock lock(file_, "out");
    const ProcessMark process = ThisProcess();
    EXPECT_THAT(Refusal(), AllOf(HasSubstr("out: process " + std::to_string(process.pid)),
                                 HasSubstr("on " + process.host), HasSubstr("since 20")));
  }
  EXPECT_FALSE(fs::exists(file_));
  EXPECT_EQ(Refusal(), "");
}

TEST_F(RunLockFile, WhatAKilledRunHasLeftIsTakenOver) {
  const pid_t child = ::fork();
  if (child == 0) {
    const RunLock lock(file_, "out");
    ::_exit(0);  // without destructors, like a kill
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  ASSERT_TRUE(fs::exists(file_));
  EXPECT_EQ(Refusal(), "");
}

TEST_F(RunLockFile, AFileOfAnEarlierBootIsStale) {
  std::ofstream(file_) << "pid 1\nhost " << ThisProcess().host << "\nboot earlier\nsince then\n";
  EXPECT_EQ(Refusal(), "");
}

TEST_F(RunLockFile, AFileOfAnotherHostIsRefusedWithTheRemedy) {
  std::ofstream(file_) << "pid 7\nhost elsewhere\nboot other\nsince 2026-01-02 03:04:05\n";
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("process 7 on elsewhere, since 2026-01-02 03:04:05"),
                               HasSubstr("remove " + file_.string())));
  EXPECT_TRUE(fs::exists(file_));  // not ours to remove
}

TEST_F(RunLockFile, GarbageInTheFileIsNobody) {
  std::ofstream(file_) << "\n\npid\npid x\nhost";
  EXPECT_EQ(Refusal(), "");
}

TEST_F(RunLockFile, AFolderThatIsMissingIsNoResource) {
  MessageOf(ErrorKind::kResource, [&] { const RunLock lock(folder_ / "no" / "lock", "out"); });
}

}  // namespace
}  // namespace curvefusion
