#include <fmt/format.h>
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "apps/commands/command.h"
#include "apps/failure.h"
#include "apps/interrupt.h"
#include "kernel/error.h"
#include "kernel/options.h"

namespace curvefusion {

namespace {

constexpr int kMegabyte = 1 << 20;

// CLI11 says of a mistyped command only that one is required.
void CheckCommandName(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  if (std::find(names.begin(), names.end(), argv[1]) != names.end()) return;
  throw Error(ErrorKind::kUsage,
              fmt::format("there is no command {}; did you mean {}? `curvefusion --help` lists all",
                          argv[1], NearestName(argv[1], names)));
}

int Parse(int argc, char** argv) {
  CLI::App app("CurveFusion: wire objects from RGB-D scans, as curve skeletons and tube meshes.");
  app.name("curvefusion");
  app.set_version_flag("--version", CURVEFUSION_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a mesh with defects (mesh --check), 2 usage, 3 bad input, 4 nothing\n"
      "thin found, 5 out of memory or disk, 75 another run writes to the same place, 130 "
      "interrupted.\n"
      "`curvefusion COMMAND --help` tells more and gives examples.");
  int exit_code = 0;
  AddReconstructCommand(app, exit_code);
  AddCheckCommand(app, exit_code);
  AddContractCommand(app, exit_code);
  AddMeshCommand(app, exit_code);
  AddGraphCommand(app, exit_code);
  AddConfigCommand(app, exit_code);
  AddSimulateCommand(app, exit_code);
  AddEvaluateCommand(app, exit_code);
  AddExperimentCommand(app, exit_code);
  CheckCommandName(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : ExitCode(ErrorKind::kUsage);
  }
  return exit_code;
}

int Run(int argc, char** argv) {
  try {
    return FlushedOutput(Parse(argc, argv));
  } catch (...) {
    return ReportFailure();
  }
}

// What a step frees the next one asks for again: memory that is kept need not be cleared anew by
// the system, page by page.
void KeepFreedMemory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 32 * kMegabyte);
  mallopt(M_TRIM_THRESHOLD, 128 * kMegabyte);
#endif
}

}  // namespace

}  // namespace curvefusion

int main(int argc, char** argv) {
  curvefusion::CatchInterrupts();
  curvefusion::IgnoreWriteSignals();
  curvefusion::KeepFreedMemory();
  return curvefusion::Run(argc, argv);
}
