#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/file_contents.h"
#include "tests/temporary_path.h"

namespace curvefusion {

/// What a run of the program gave.
struct Outcome {
  int exit_code = 0;
  std::string output;  // both streams
};

/// Runs the program in a folder of its own.
class CommandLine : public testing::Test {
 protected:
  // Runs `curvefusion ARGUMENTS` inside folder_.
  Outcome Run(const std::string& arguments) const {
    return RunShell("\"$CURVEFUSION\" " + arguments + " >output.txt 2>&1");
  }

  // The same, with SIGINT sent as soon as the folder `awaited` is there (or after 20 s).
  Outcome RunAndInterrupt(const std::string& arguments, const std::string& awaited) const {
    return RunShell("\"$CURVEFUSION\" " + arguments + " >output.txt 2>&1 & i=0; while [ ! -d " +
                    awaited +
                    " ] && [ $i -lt 2000 ]; do i=$((i+1)); sleep 0.01; done; "
                    "kill -INT $!; wait $!");
  }

  // Runs a command of the shell, for which $CURVEFUSION is the program.
  Outcome RunShell(const std::string& command) const;

  // A scan of the wire cube without noise into the folder `scan`.
  Outcome SimulateCube(int frames) const {
    return Run("simulate cubeframe -o scan --sensor ideal --poses true --frame-rate 10 --quiet " +
               ("--frames " + std::to_string(frames)));
  }

  std::string Text(const std::string& name) const { return FileText(folder_ / name); }

  // Files below a folder whose name ends so.
  int CountFiles(const std::string& folder, const std::string& name_part) const {
    int count = 0;
    if (!std::filesystem::exists(folder_ / folder)) return 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / folder)) {
      count += entry.path().filename().string().find(name_part) != std::string::npos ? 1 : 0;
    }
    return count;
  }

  const TemporaryFolder folder_{"command_line"};
};

}  // namespace curvefusion
