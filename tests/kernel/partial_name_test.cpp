#include "kernel/partial_name.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "kernel/atomic_file.h"
#include "kernel/partial_folder.h"
#include "tests/temporary_path.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;

class PartialName : public testing::Test {
 protected:
  // Runs `work` in a process that ends at once afterwards, as when killed.
  template <class Work>
  static void Killed(const Work& work) {
    const pid_t child = ::fork();
    if (child == 0) {
      work();
      ::_exit(0);
    }
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  }

  int Count() const {
    return static_cast<int>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const TemporaryFolder folder_{"partial_name"};
};

TEST_F(PartialName, OnlyWhatAGoneProcessHasLeftOfThatNameIsRemoved) {
  const fs::path file = folder_ / "mesh.ply";
  Killed([&] {
    WriteStreamAtomically(file, [&](std::ostream& stream) {
      stream << "half";
      ::_exit(0);
    });
  });
  Killed([&] { std::ofstream(PartialFilePath(folder_ / "other.ply")) << "half"; });
  std::ofstream(PartialFilePath(file)) << "of a living process";
  std::ofstream(folder_ / "mesh.partial-notours-1.ply") << "of another machine";
  std::ofstream(folder_ / "mesh.partial-.ply") << "of the user";
  ASSERT_EQ(Count(), 5);
  RemoveStalePartials(file);
  EXPECT_EQ(Count(), 4);
  RemoveStalePartialsIn(folder_);
  EXPECT_EQ(Count(), 3);
  EXPECT_TRUE(fs::exists(PartialFilePath(file)));
}

TEST_F(PartialName, TheNextFolderOfTheNameRemovesTheStaleOne) {
  const fs::path scan = folder_ / "scan.v2";
  Killed([&] {
    PartialFolder partial(scan);
    std::ofstream(partial.path() / "a") << "half";
    ::_exit(0);
  });
  ASSERT_EQ(Count(), 1);
  WriteFolderAtomically(scan, [](const fs::path&) {});
  EXPECT_EQ(Count(), 1);
  EXPECT_TRUE(fs::exists(scan));
}

}  // namespace
}  // namespace curvefusion
