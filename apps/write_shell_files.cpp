// Writes the manual page and what bash, zsh and fish complete, in this order, to the files named.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/command_line.h"
#include "apps/shell_files.h"

namespace {

bool Write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream stream(path);
  stream << text << std::flush;
  return stream.good();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app;
  int exit_code = 0;
  curvefusion::AddCommandLine(app, exit_code);
  const bool written = argc == 5 && Write(argv[1], curvefusion::ManualPage(app)) &&
                       Write(argv[2], curvefusion::BashCompletion(app)) &&
                       Write(argv[3], curvefusion::ZshCompletion(app)) &&
                       Write(argv[4], curvefusion::FishCompletion(app));
  if (!written) std::fputs("usage: curvefusion_shell_files MAN BASH ZSH FISH\n", stderr);
  return written ? 0 : 1;
}
