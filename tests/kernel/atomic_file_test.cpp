#include "kernel/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <string>

#include "kernel/error.h"
#include "tests/error_message.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class AtomicFile : public testing::Test {
 protected:
  const TemporaryFolder folder_{"atomic_file"};
};

TEST_F(AtomicFile, AppearsOnlyWhenComplete) {
  const fs::path path = folder_ / "a.txt";
  WriteStreamAtomically(path, [&](std::ostream& stream) {
    stream << "whole";
    EXPECT_FALSE(fs::exists(path));
  });
  std::string content;
  std::ifstream(path) >> content;
  EXPECT_EQ(content, "whole");
}

TEST_F(AtomicFile, AFailedWriteLeavesNothingAndKeepsTheOld) {
  const fs::path path = folder_ / "a.txt";
  WriteStreamAtomically(path, [](std::ostream& stream) { stream << "old"; });
  EXPECT_THROW(
      WriteStreamAtomically(path, [](std::ostream&) { throw Error(ErrorKind::kInterrupted, ""); }),
      Error);
  std::string content;
  std::ifstream(path) >> content;
  EXPECT_EQ(content, "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(AtomicFile, AMissingFolderIsAnError) {
  EXPECT_THROW(WriteStreamAtomically(folder_ / "no" / "a.txt", [](std::ostream&) {}), Error);
}

TEST_F(AtomicFile, AFileThatReachesItsLimitIsToldWithTheReason) {
  rlimit before;
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  const std::string message = MessageOf(ErrorKind::kResource, [&] {
    WriteStreamAtomically(folder_ / "a.txt",
                          [](std::ostream& stream) { stream << std::string(100000, 'a'); });
  });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(message, (folder_ / "a.txt").string() + ": cannot be written (File too large)");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(AtomicFile, ErrorsNameTheFileAndNotItsTemporary) {
  const fs::path path = folder_ / "a.txt";
  const auto write = [](const fs::path& temporary) {
    throw Error(ErrorKind::kBadInput, temporary.string() + ": bad");
  };
  EXPECT_EQ(MessageOf([&] { WriteFileAtomically(path, write); }), path.string() + ": bad");
}

TEST_F(AtomicFile, NeitherAFolderNorADeviceIsReplaced) {
  const auto write = [](std::ostream& stream) { stream << "a"; };
  EXPECT_THROW(WriteStreamAtomically(folder_, write), Error);
  fs::create_symlink("/dev/null", folder_ / "null");
  EXPECT_THROW(WriteStreamAtomically(folder_ / "null", write), Error);
  EXPECT_TRUE(fs::is_symlink(folder_ / "null"));
}

TEST_F(AtomicFile, WhatComesIntoAFolderMeanwhileIsNotReplaced) {
  const fs::path path = folder_ / "scan";
  const auto write = [&](const fs::path&) {
    fs::create_directory(path);
    std::ofstream(path / "of_another") << "1";
  };
  EXPECT_THROW(WriteFolderAtomically(path, write), Error);
  EXPECT_TRUE(fs::exists(path / "of_another"));
}

TEST_F(AtomicFile, AFolderAppearsOnlyWhenComplete) {
  const fs::path path = folder_ / "above" / "scan";
  WriteFolderAtomically(path / "", [&](const fs::path& temporary) {
    std::ofstream(temporary / "a.txt") << "whole";
    EXPECT_FALSE(fs::exists(path));
  });
  EXPECT_TRUE(fs::exists(path / "a.txt"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "above"), fs::directory_iterator()), 1);
}

TEST_F(AtomicFile, AFailedFolderLeavesNothing) {
  const auto fail = [](const fs::path& temporary) {
    std::ofstream(temporary / "a.txt") << "half";
    throw Error(ErrorKind::kInterrupted, "");
  };
  EXPECT_THROW(WriteFolderAtomically(folder_ / "scan", fail), Error);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(AtomicFile, AnEmptyFolderIsTakenAndAFullOneRefused) {
  const auto write = [](const fs::path& temporary) { std::ofstream(temporary / "a.txt") << "1"; };
  fs::create_directories(folder_ / "scan");
  WriteFolderAtomically(folder_ / "scan", write);
  EXPECT_TRUE(fs::exists(folder_ / "scan" / "a.txt"));
  EXPECT_THROW(WriteFolderAtomically(folder_ / "scan", write), Error);
  EXPECT_THROW(WriteFolderAtomically(folder_ / "scan" / "a.txt", write), Error);
}

}  // namespace
}  // namespace curvefusion
