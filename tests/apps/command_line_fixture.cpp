#include "tests/apps/command_line_fixture.h"

#include <sys/wait.h>

#include <cstdlib>

namespace curvefusion {

Outcome CommandLine::RunShell(const std::string& command) const {
  const std::string prelude =
      "CURVEFUSION='" CURVEFUSION_PROGRAM "'; cd '" + folder_.path().string() + "' || exit; ";
  const int status = std::system((prelude + command).c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, Text("output.txt")};
}

}  // namespace curvefusion
