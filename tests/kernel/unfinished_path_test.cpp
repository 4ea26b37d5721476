#include "kernel/unfinished_path.h"

#include <gtest/gtest.h>

#include <fstream>

#include "kernel/atomic_file.h"
#include "kernel/partial_folder.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

struct UnfinishedPathTest : testing::Test {
  bool IsEmpty() const { return fs::is_empty(folder); }

  const TemporaryFolder folder{"unfinished_path_test"};
};

TEST_F(UnfinishedPathTest, AFileBeingWrittenIsRemoved) {
  WriteFileAtomically(folder / "a.txt", [&](const fs::path& temporary) {
    std::ofstream(temporary) << "half";
    EXPECT_FALSE(IsEmpty());
    RemoveUnfinishedPaths();
    EXPECT_TRUE(IsEmpty());
    std::ofstream(temporary) << "whole";
  });
  RemoveUnfinishedPaths();
  EXPECT_TRUE(fs::exists(folder / "a.txt"));  // finished
}

TEST_F(UnfinishedPathTest, AFolderBeingFilledIsRemoved) {
  PartialFolder partial(folder / "scan");
  std::ofstream(partial.path() / "a.txt") << "half";
  RemoveUnfinishedPaths();
  EXPECT_TRUE(IsEmpty());
}

TEST_F(UnfinishedPathTest, AFinishedFolderStays) {
  PartialFolder partial(folder / "scan");
  std::ofstream(partial.path() / "a.txt") << "whole";
  partial.Finish();
  RemoveUnfinishedPaths();
  EXPECT_TRUE(fs::exists(folder / "scan/a.txt"));
}

}  // namespace
}  // namespace curvefusion
