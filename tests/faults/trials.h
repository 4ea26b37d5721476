#pragma once

#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "tests/faults/program_run.h"

namespace curvefusion {

using Files = std::map<std::string, std::string>;  // bytes by path

/// A command that writes files. In its arguments, @ is the folder of inputs.
struct WritingCommand {
  std::string name;
  std::vector<std::string> arguments;
  bool replaces = true;  ///< runs where an earlier result lies
};

/// For GoogleTest, which would print its bytes.
inline void PrintTo(const WritingCommand& command, std::ostream* stream) {
  *stream << command.name;
}

/// All commands that write files.
std::vector<WritingCommand> WritingCommands();

/// One of them.
WritingCommand CommandNamed(const std::string& name);

/// What runs of a command leave in their folder when nothing disturbs them.
struct References {
  Files none;     ///< before any run
  Files earlier;  ///< of other inputs; empty where the command replaces nothing
  Files result;
};

/// Folders in which commands are tried, with small inputs for all of them.
class TrialFolder {
 public:
  TrialFolder();
  ~TrialFolder();
  TrialFolder(const TrialFolder&) = delete;
  TrialFolder& operator=(const TrialFolder&) = delete;

  const std::filesystem::path& path() const { return trial_; }           ///< where trials run
  std::filesystem::path inputs() const { return folder_ / "inputs"; }    ///< of the trials
  std::filesystem::path earlier() const { return folder_ / "earlier"; }  ///< of earlier results

  References MakeReferences(const WritingCommand& command) const;

  /// Empties the folder of trials, or puts these files there.
  void Prepare(const Files& files) const;

  /// Runs the command on what lies in the folder of trials.
  ProgramRun Run(const WritingCommand& command, const Disturbance& disturbance = {}) const;

  /// How long the command takes undisturbed, now: the machine may have other things to do. Leaves
  /// its result in the folder of trials.
  double Duration(const WritingCommand& command) const;

  /// What lies in the folder of trials.
  Files Found() const { return FilesBelow(trial_); }

 private:
  void WriteInputs(const std::string& name, double size) const;
  ProgramRun RunOn(const std::string& inputs, const WritingCommand& command,
                   const Disturbance& disturbance) const;

  std::filesystem::path folder_;
  std::filesystem::path trial_;
};

/// What is wrong with the outcome of a run in which something failed, nothing where it is right:
/// exit code 0 and the result, or exit code 5 and what lay there before.
std::string FaultOf(const ProgramRun& run, const Files& found, const Files& before,
                    const References& references);

/// What is wrong with what a killed run left: each file must be of an earlier run, or complete.
/// Temporary files may be left; the next run removes them.
std::string KillFaultOf(const Files& found, const References& references);

/// What is wrong with the outcome of an interrupted run, nothing where it is right: exit code 130
/// and what lay there before, or exit code 0 and the result where the signal came too late.
std::string InterruptFaultOf(const ProgramRun& run, const Files& found, const Files& before,
                             const References& references);

/// The first difference in words, "none" where there is none.
std::string Difference(const Files& found, const Files& expected);

/// Whether everything is to be tried, as `./run faults` asks, or some of it, as in `ctest`.
bool TriesEverything();

}  // namespace curvefusion
