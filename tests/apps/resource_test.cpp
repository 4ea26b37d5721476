// Places, files and resources that are not as they should be: the program ends with the right exit
// code and a message, and leaves nothing half-written.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "kernel/partial_name.h"
#include "kernel/run_lock.h"
#include "tests/apps/command_line_fixture.h"

namespace curvefusion {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

// Ends soon with exit code 4: the object has less than 10 m of curve.
constexpr const char* kNothing = " --quiet --set ridge_skeleton.min_component=10";

class Resources : public CommandLine {
 protected:
  // The program after some shell commands, which may set limits; their failure skips nothing.
  Outcome RunAfter(const std::string& before, const std::string& arguments) const {
    return RunShell(before + "exec \"$CURVEFUSION\" " + arguments + " >output.txt 2>&1");
  }

  // Whether another user than root can be had who can run the program.
  bool HasOtherUser() const {
    return ::geteuid() == 0 && RunShell(kAsNobody + "--version >output.txt 2>&1").exit_code == 0;
  }

  const std::string kAsNobody = "setpriv --reuid=65534 --clear-groups \"$CURVEFUSION\" ";
};

TEST_F(Resources, ASecondRunInOnePlaceIs75) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  fs::create_directory(folder_ / "out");
  const RunLock out(folder_ / "out" / "curvefusion.lock", "out");
  const RunLock scan(folder_ / "new.lock", "new");
  const std::string holder = "process " + std::to_string(::getpid()) + " on ";
  for (const char* arguments : {"reconstruct scan -o out", "experiment objects --quick -o out",
                                "simulate cage --frames 1 -o new/"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 75) << arguments << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(holder)) << arguments;
  }
}

TEST_F(Resources, WhatAKilledRunHasLeftIsCleaned) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  const Outcome killed = RunShell(
      "\"$CURVEFUSION\" reconstruct scan -o out >output.txt 2>&1 & i=0; while [ ! -f "
      "out/curvefusion.lock ] && [ $i -lt 2000 ]; do i=$((i+1)); sleep 0.01; done; "
      "kill -KILL $!; wait $!");
  ASSERT_EQ(killed.exit_code, 128 + SIGKILL);
  const pid_t child = ::fork();
  if (child == 0) {
    std::ofstream(PartialFilePath(folder_ / "out" / "mesh.ply")) << "half";
    ::_exit(0);
  }
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  ASSERT_EQ(CountFiles("out", ""), 2);
  EXPECT_EQ(Run(std::string("reconstruct scan -o out") + kNothing).exit_code, 4);
  EXPECT_EQ(CountFiles("out", ""), 3);  // report.json, report.html and config.toml
  EXPECT_EQ(CountFiles("out", "report.json"), 1);
}

TEST_F(Resources, OutputThatCannotBeWrittenIsFive) {
  const Outcome full = RunShell("\"$CURVEFUSION\" config >/dev/full 2>output.txt");
  EXPECT_EQ(full.exit_code, 5);
  EXPECT_THAT(full.output, HasSubstr("No space left on device"));
  const Outcome limited = RunAfter("ulimit -f 4; ", "simulate cage --frames 1 -o new");
  EXPECT_EQ(limited.exit_code, 5) << limited.output;
  EXPECT_THAT(limited.output, HasSubstr("new/"));
  EXPECT_THAT(limited.output, HasSubstr("File too large"));
  EXPECT_EQ(CountFiles(".", "new"), 0);
}

TEST_F(Resources, AReaderThatHasGoneAwayIsNoError) {
  const Outcome outcome = RunShell(
      "{ { sleep 0.3; \"$CURVEFUSION\" config; echo $? >code; } 2>output.txt | true; }; cat code");
  EXPECT_EQ(outcome.output, "");
  EXPECT_THAT(Text("code"), AnyOf("0\n", "141\n"));
}

TEST_F(Resources, TooLittleDiskIsToldBeforeTheWork) {
  fs::create_directory(folder_ / "small");
  if (::geteuid() != 0 ||
      RunShell("mount -t tmpfs -o size=64k none small 2>output.txt").exit_code != 0) {
    GTEST_SKIP() << "no disk can be mounted";
  }
  EXPECT_EQ(SimulateCube(3).exit_code, 0);
  for (const char* arguments :
       {"simulate cage --frames 2 -o small/scan", "reconstruct scan -o small/out"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 5) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("MB are free"));
  }
  EXPECT_EQ(CountFiles("small", ""), 0);
  EXPECT_EQ(RunShell("umount small").exit_code, 0);
}

TEST_F(Resources, PipesDevicesAndFoldersAreRefusedAsInput) {
  ASSERT_EQ(SimulateCube(2).exit_code, 0);
  RunShell(
      "mkfifo p p.json p.obj; cp -r scan scan2; rm scan2/intrinsics.json; "
      "ln -s ../p scan2/intrinsics.json; for f in scan/rgb/*; do rm $f; mkfifo $f; done");
  for (const char* arguments :
       {"contract p -o a.json", "contract /dev/zero -o a.json", "graph p.json",
        "mesh p.json -o a.ply", "mesh --check p.obj", "config --config p", "config --config scan",
        "evaluate p.json --truth p.json", "check scan", "check scan2", "reconstruct scan -o out",
        "simulate p.json --frames 1 -o new", "mesh --check scan/depth.txt/x.obj"}) {
    const Outcome outcome =
        RunShell("timeout 20 \"$CURVEFUSION\" " + std::string(arguments) + " >output.txt 2>&1");
    EXPECT_EQ(outcome.exit_code, 3) << arguments << "\n" << outcome.output;
    EXPECT_THAT(outcome.output,
                AnyOf(HasSubstr("is a pipe or a device, not a regular file"),
                      HasSubstr("is a folder, not a file"), HasSubstr("is not there")))
        << arguments;
  }
}

TEST_F(Resources, DevicesAndFoldersAreRefusedAsOutput) {
  std::ofstream(folder_ / "c.xyz") << "0 0 0\n";
  for (const char* arguments : {"contract c.xyz -o .", "contract c.xyz -o /dev/null"}) {
    const Outcome outcome = Run(arguments);
    EXPECT_EQ(outcome.exit_code, 5) << arguments;
    EXPECT_THAT(outcome.output, HasSubstr("name a file to write")) << arguments;
  }
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Resources, AFileGivenAsFolderIsToldFromAMissingOne) {
  std::ofstream(folder_ / "file") << "";
  const Outcome file = Run("check file");
  EXPECT_EQ(file.exit_code, 3);
  EXPECT_THAT(file.output, HasSubstr("file: is a file; name the folder"));
  EXPECT_THAT(Run("check none").output, HasSubstr("there is no such folder"));
}

TEST_F(Resources, WhatMayNotBeReadIsBadInput) {
  if (!HasOtherUser()) GTEST_SKIP() << "needs a user who may not read everything";
  ASSERT_EQ(SimulateCube(2).exit_code, 0);
  for (const char* what : {"scan", "scan/rgb", "scan/intrinsics.json", "scan/trajectory.txt"}) {
    fs::permissions(folder_ / what, fs::perms::none);
    const Outcome outcome = RunShell(kAsNobody + "check scan >output.txt 2>&1");
    fs::permissions(folder_ / what, fs::perms::all);
    EXPECT_EQ(outcome.exit_code, 3) << what << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("cannot be read (Permission denied)")) << what;
  }
  const Outcome outcome = RunShell(kAsNobody + "reconstruct scan -o out >output.txt 2>&1");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.output;  // the folder is root's
}

TEST_F(Resources, NamesNeedNotBeUtf8) {
  ASSERT_EQ(SimulateCube(3).exit_code, 0);
  fs::rename(folder_ / "scan", folder_ / "sc\xff\xfe");
  const Outcome outcome = RunShell(
      "\"$CURVEFUSION\" reconstruct sc* -o \"$(printf "
      "'o\\377t')\"" +
      std::string(kNothing) + " >output.txt 2>&1");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.output;
  const auto report = nlohmann::json::parse(Text("o\xfft/report.json"));
  EXPECT_EQ(report.at("sequence").at("folder"), "sc\uFFFD\uFFFD");
}

// Sanitizers reserve terabytes, and look for leaks in a process of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_F(Resources, TooFewThreadsAreFive) {
  if (!HasOtherUser()) GTEST_SKIP() << "root has no limit of threads";
  ASSERT_EQ(SimulateCube(8).exit_code, 0);
  const Outcome outcome = RunShell(
      "setpriv --reuid=65533 --clear-groups bash -c \"ulimit -u 1; exec '$CURVEFUSION' "
      "check scan\" >output.txt 2>&1");
  EXPECT_EQ(outcome.exit_code, 5) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("no more threads can be started"));
}

// Below some limit on address space the system cannot load the program's libraries, or these fail
// to set themselves up before main begins: no program can answer that. Limits count from there.
TEST_F(Resources, TooLittleMemoryIsFive) {
  ASSERT_EQ(SimulateCube(8).exit_code, 0);
  const auto run_within = [&](int megabytes, const std::string& arguments) {
    return RunAfter(fmt::format("ulimit -v {}; ", megabytes * 1024), arguments);
  };
  int least = 100;
  while (run_within(least, "--version").exit_code != 0) {
    least += 8;
    ASSERT_LT(least, 1000);
  }
  int refused = 0;
  for (const int more : {8, 16, 24, 32, 40, 56, 72, 88}) {
    const Outcome outcome = run_within(least + more, "reconstruct scan -o out");
    EXPECT_THAT(outcome.exit_code, AnyOf(0, 4, 5)) << least << " + " << more << outcome.output;
    if (outcome.exit_code == 5) {
      ++refused;
      // Threads take address space as well.
      EXPECT_THAT(outcome.output, AnyOf(HasSubstr("out of memory"), HasSubstr("no more threads")));
    }
    EXPECT_EQ(CountFiles("out", "partial") + CountFiles("out", "lock"), 0);
  }
  EXPECT_GT(refused, 0);
}
#endif

}  // namespace
}  // namespace curvefusion
