#pragma once

#include "apps/progress_printer.h"
#include "kernel/progress.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace curvefusion {

// Each command adds itself to the command line; parsing a line that names it runs it and sets the
// exit code. Errors leave as exceptions: main tells the user and turns them into exit codes.
void AddReconstructCommand(CLI::App& app, int& exit_code);
void AddLiveCommand(CLI::App& app, int& exit_code);
void AddTrackCommand(CLI::App& app, int& exit_code);
void AddCheckCommand(CLI::App& app, int& exit_code);
void AddUnpackCommand(CLI::App& app, int& exit_code);
void AddContractCommand(CLI::App& app, int& exit_code);
void AddGraphCommand(CLI::App& app, int& exit_code);
void AddMeshCommand(CLI::App& app, int& exit_code);
void AddConfigCommand(CLI::App& app, int& exit_code);
void AddSimulateCommand(CLI::App& app, int& exit_code);
void AddEvaluateCommand(CLI::App& app, int& exit_code);
void AddExperimentCommand(CLI::App& app, int& exit_code);
void AddSweepCommand(CLI::App& app, int& exit_code);

/// Exit code of a run that worked but found nothing thin.
inline constexpr int kNothingThin = 4;

/// Exit code of `mesh --check` for a mesh with a defect (also of internal errors).
inline constexpr int kDefectFound = 1;

/// What every command that takes time has.
struct RunOptions {
  int threads = 0;  ///< 0 = all cores
  bool quiet = false;
};
void AddRunOptions(CLI::App& command, RunOptions& options);

/// For options with a number that must be positive; says so where there is a unit behind it.
CLI::Validator PositiveNumber();

/// Limits every parallel loop of the program from now on. There is no way back: when a limit ends,
/// TBB starts threads, and ends the program where there is no memory for them.
void LimitThreads(const RunOptions& options);

/// Progress that is shown by `printer` and ends the step once the user interrupts.
Progress InterruptibleProgress(ProgressPrinter& printer);

}  // namespace curvefusion
