#include "apps/command_line.h"

#include <CLI/CLI.hpp>

#include "apps/commands/command.h"

namespace curvefusion {

void AddCommandLine(CLI::App& app, int& exit_code) {
  app.description(
      "CurveFusion: wire objects from RGB-D scans, as curve skeletons and tube meshes.");
  app.name("curvefusion");
  app.set_version_flag("--version", CURVEFUSION_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 done, 1 a defect or failed runs (mesh --check, experiment, sweep), 2 usage,\n"
      "3 bad input, 4 nothing thin found, 5 out of memory, threads or disk, 75 another run writes\n"
      "to the same place, 130 interrupted.\n"
      "`curvefusion help COMMAND` tells more and gives examples.");
  AddReconstructCommand(app, exit_code);
  AddLiveCommand(app, exit_code);
  AddTrackCommand(app, exit_code);
  AddCheckCommand(app, exit_code);
  AddUnpackCommand(app, exit_code);
  AddContractCommand(app, exit_code);
  AddMeshCommand(app, exit_code);
  AddGraphCommand(app, exit_code);
  AddConfigCommand(app, exit_code);
  AddSimulateCommand(app, exit_code);
  AddEvaluateCommand(app, exit_code);
  AddExperimentCommand(app, exit_code);
  AddSweepCommand(app, exit_code);
}

}  // namespace curvefusion
