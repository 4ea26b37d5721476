#include "kernel/child_program.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>

#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

TEST(ChildProgram, GetsItsArgumentsAsTheyAreAndItsStreamsAreApart) {
  const TemporaryFolder folder("child's");
  const ProgramResult result =
      RunProgram("sh", {"-c", "pwd; echo \"$1\" >&2; cat", "sh", "it's $HOME"}, folder.path());
  EXPECT_TRUE(result.succeeded);
  EXPECT_EQ(result.output, std::filesystem::canonical(folder.path()).string() + "\n");
  EXPECT_EQ(result.messages, "it's $HOME\n");
}

TEST(ChildProgram, TellsFailureFromSuccess) {
  EXPECT_FALSE(RunProgram("sh", {"-c", "exit 3"}, ".").succeeded);
  EXPECT_FALSE(RunProgram("sh", {"-c", "kill -TERM $$"}, ".").succeeded);
  EXPECT_FALSE(RunProgram("no_program_has_this_name", {}, ".").succeeded);
  EXPECT_FALSE(RunProgram("true", {}, "no_folder_has_this_name").succeeded);
}

TEST(ChildProgram, IsKilledWhereItsCallerIsInterrupted) {
  const auto start = std::chrono::steady_clock::now();
  const auto interrupt = [] { throw std::runtime_error("enough"); };
  EXPECT_THROW(RunProgram("sleep", {"60"}, ".", interrupt), std::runtime_error);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

}  // namespace
}  // namespace curvefusion
