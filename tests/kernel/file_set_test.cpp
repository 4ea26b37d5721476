#include "kernel/file_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <map>

#include "kernel/error.h"
#include "kernel/partial_name.h"
#include "tests/error_message.h"
#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const std::vector<std::string> kNames = {"a", "b", "c", "report"};

class FileSet : public testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, text] : old_) std::ofstream(folder_ / name) << text;
  }
  static Files FilesIn(const fs::path& folder) {
    Files files;
    for (const auto& entry : fs::directory_iterator(folder)) {
      files[entry.path().filename()] = FileText(entry.path());
    }
    return files;
  }

  static void WriteNew(const fs::path& folder) {
    for (const char* name : {"a", "c", "report"}) std::ofstream(folder / name) << "new";
  }

  // The temporary folder of a process that has ended, with what `fill` puts into it.
  template <class Fill>
  void LeaveBehind(const Fill& fill) const {
    const pid_t child = ::fork();
    if (child == 0) {
      const fs::path temporary = PartialFolderPath(folder_ / "result");
      fs::create_directory(temporary);
      fill(temporary);
      ::_exit(0);
    }
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  }

  const Files old_ = {{"a", "old"}, {"b", "old"}, {"report", "old"}, {"notes", "mine"}};
  const Files new_ = {{"a", "new"}, {"c", "new"}, {"report", "new"}, {"notes", "mine"}};
  const TemporaryFolder folder_{"file_set"};
};

TEST_F(FileSet, ReplacesAllOfTheNamesAndNothingElse) {
  WriteFilesTogether(folder_, kNames, [&](const fs::path& temporary) {
    WriteNew(temporary);
    EXPECT_EQ(FilesIn(folder_).at("a"), "old");
  });
  EXPECT_EQ(FilesIn(folder_), new_);
}

TEST_F(FileSet, AFailingWriterKeepsTheOldAndNamesTheFinalPlace) {
  const auto write = [&](const fs::path& temporary) {
    WriteNew(temporary);
    throw Error(ErrorKind::kResource, (temporary / "c").string() + ": full");
  };
  EXPECT_EQ(MessageOf([&] { WriteFilesTogether(folder_, kNames, write); }),
            (folder_ / "c").string() + ": full");
  EXPECT_EQ(FilesIn(folder_), old_);
}

// A folder with content cannot be replaced by a file: the last move fails.
TEST_F(FileSet, AMoveThatFailsPutsAllBack) {
  const auto write = [&](const fs::path& temporary) {
    WriteNew(temporary);
    fs::create_directories(folder_ / "d" / "full");
    std::ofstream(temporary / "d") << "new";
    fs::create_directories(temporary / "leaving" / "d" / "occupied");
  };
  std::vector<std::string> names = kNames;
  names.insert(names.begin(), "d");
  EXPECT_THROW(WriteFilesTogether(folder_, names, write), Error);
  fs::remove_all(folder_ / "d");
  RecoverFileSet(folder_);
  for (const auto& [name, text] : old_) EXPECT_EQ(FilesIn(folder_)[name], text) << name;
}

TEST_F(FileSet, WhatWasKilledBeforeAllHadLeftGoesBack) {
  LeaveBehind([&](const fs::path& temporary) {
    WriteNew(temporary);
    fs::create_directory(temporary / "leaving");
    fs::rename(folder_ / "report", temporary / "leaving" / "report");
  });
  RecoverFileSet(folder_);
  EXPECT_EQ(FilesIn(folder_), old_);
}

TEST_F(FileSet, WhatWasKilledAfterwardsIsFinished) {
  LeaveBehind([&](const fs::path& temporary) {
    WriteNew(temporary);
    fs::create_directory(temporary / "replaced");
    for (const char* name : {"a", "b", "report"}) {
      fs::rename(folder_ / name, temporary / "replaced" / name);
    }
    fs::rename(temporary / "a", folder_ / "a");
  });
  RecoverFileSet(folder_);
  EXPECT_EQ(FilesIn(folder_), new_);
}

TEST_F(FileSet, WhatWasKilledWhileWritingDisappears) {
  LeaveBehind(WriteNew);
  RecoverFileSet(folder_);
  EXPECT_EQ(FilesIn(folder_), old_);
}

}  // namespace
}  // namespace curvefusion
