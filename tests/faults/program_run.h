#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace curvefusion {

/// How a run of the program is disturbed.
struct Disturbance {
  std::string kind;      ///< what fault_shim.cpp lets fail: "write" or "allocation"; empty: nothing
  long first = 0;        ///< number of the first operation that fails; 0: they are only counted
  long count = 1;        ///< how many fail from there on; 0: as long as room is missing
  long least_bytes = 0;  ///< smaller allocations are not counted and do not fail
  int error = 0;         ///< what a failing write says
  double signal_after =
      -1;          ///< seconds after the start at which the run gets a signal; none below 0
  int signal = 9;  ///< which; SIGKILL
};

/// What became of a run.
struct ProgramRun {
  int exit_code = -1;  ///< -1 where a signal ended it
  int signal = 0;      ///< that ended it
  double seconds = 0;
  double after_signal = 0;      ///< seconds from the signal to the end
  double cpu_after_signal = 0;  ///< processor seconds of all threads in this time
  double peak_bytes = 0;        ///< of memory
  long operations = 0;          ///< of the disturbance's kind
  std::string failed;           ///< number and name of the first that failed; empty: none did
  std::string output;           ///< both streams
};

/// Runs `curvefusion ARGUMENTS` inside `folder`; one that takes 300 s longer than to its signal is
/// killed.
ProgramRun RunProgram(const std::filesystem::path& folder,
                      const std::vector<std::string>& arguments,
                      const Disturbance& disturbance = {});

/// Whether operations can be made to fail here: not where sanitizers replace the allocator.
bool CanInjectFaults();

/// The bytes of every file below a folder by its path; folders end with a slash and hold nothing.
/// What differs from run to run is left out: times and memory in report.json, all of 3MF files
/// that are whole.
std::map<std::string, std::string> FilesBelow(const std::filesystem::path& folder);

}  // namespace curvefusion
