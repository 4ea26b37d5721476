#include "experiments/sweeps/snakemake_run.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "experiments/simulation/scan_settings.h"
#include "experiments/studies/provenance.h"
#include "experiments/sweeps/cell_measurement.h"
#include "kernel/cancellation.h"
#include "kernel/error.h"
#include "kernel/free_space.h"

namespace curvefusion {

namespace {

// Counting looks at every cell.
constexpr std::chrono::milliseconds kTick(50);
constexpr int kTicksPerCount = 100;

// Chosen: each job waits in a process of its own on this machine.
constexpr int kSlurmJobs = 64;

bool IsOnPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string_view rest = path == nullptr ? "" : path;
  while (!rest.empty()) {
    const std::string folder(rest.substr(0, rest.find(':')));
    rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
    if (::access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

int MachineMemoryMb() {
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return static_cast<int>(pages * static_cast<double>(sysconf(_SC_PAGE_SIZE)) / 1e6);
}

std::vector<std::string> Arguments(const SweepPlan& plan, const SweepRunOptions& options) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  const int jobs = options.jobs > 0 ? options.jobs : options.slurm ? kSlurmJobs : cores;
  std::vector<std::string> arguments = {
      "snakemake", "cells", "--directory", plan.folder.string(), "--snakefile",
      (plan.folder / "Snakefile").string(), "--cores",
      std::to_string(options.slurm ? jobs * plan.threads : jobs), "--keep-going",
      // Its own locks and marks of incomplete files would outlive a killed run; ours do not.
      "--nolock", "--ignore-incomplete", "--drop-metadata", "--rerun-triggers", "mtime",
      "--scheduler", "greedy", "--config", "program=" + options.program.string()};
  if (options.slurm) {
    arguments.push_back(
        "submit=srun --quiet --ntasks=1 --job-name=curvefusion --cpus-per-task={threads} "
        "--mem={resources.mem_mb}");
  } else {
    arguments.insert(arguments.end(), {"--resources", fmt::format("mem_mb={}", MachineMemoryMb())});
  }
  // Cells tell themselves what is wrong with them.
  arguments.insert(arguments.end(), {"--quiet", "all"});
  return arguments;
}

int64_t CountFinished(const SweepPlan& plan) {
  return std::count_if(plan.cells.begin(), plan.cells.end(),
                       [&](const SweepCell& cell) { return !FinishedResult(plan, cell).empty(); });
}

// Ends with this process, however that ends.
pid_t Start(const std::vector<std::string>& arguments) {
  std::vector<char*> raw;
  for (const std::string& argument : arguments) raw.push_back(const_cast<char*>(argument.c_str()));
  raw.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() == parent) ::execvp(raw[0], raw.data());
  ::_exit(127);
}

void RequireSnakemake(bool slurm) {
  if (!IsOnPath("snakemake")) {
    throw Error(ErrorKind::kResource,
                "snakemake runs the cells of a sweep and cannot be found; on Debian: apt-get "
                "install snakemake");
  }
  if (slurm && !IsOnPath("srun")) {
    throw Error(ErrorKind::kResource,
                "--slurm needs srun, which cannot be found; on Debian: apt-get install "
                "slurm-client, or leave --slurm out to use this machine alone");
  }
}

// Every cell would refuse to be measured.
void RequireThisMethod(const SweepPlan& plan) {
  if (plan.method == MethodVersion()) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{0}: was planned by another version of this program; plan it again with "
                          "`curvefusion sweep plan {0}/study.toml -o NEW --cache {0}`, which keeps "
                          "its scans, and its results to compare with",
                          plan.folder.string()));
}

// What missing cells and scans will take on the disk at most.
std::uintmax_t BytesToCome(const SweepPlan& plan) {
  std::uintmax_t bytes = 0;
  std::set<std::string> scans;
  for (const SweepCell& cell : plan.cells) {
    if (!FinishedResult(plan, cell).empty()) continue;
    bytes += kCellBytes;
    if (!scans.insert(cell.scan).second || !FinishedScan(plan, cell.scan).empty()) continue;
    bytes += ScanBytes(ReadScanSettings(plan.folder / "scans" / (cell.scan + ".json")));
  }
  return bytes;
}

}  // namespace

void MeasureSweep(const SweepPlan& plan, const SweepRunOptions& options, const Progress& progress) {
  RequireThisMethod(plan);
  RequireSnakemake(options.slurm);
  RequireFreeSpace(StoreOf(plan), BytesToCome(plan));
  const pid_t child = Start(Arguments(plan, options));
  if (child < 0) {
    throw Error(ErrorKind::kResource,
                "snakemake cannot be started (" + std::generic_category().message(errno) + ")");
  }
  for (int tick = 0; ::waitpid(child, nullptr, WNOHANG) == 0; ++tick) {
    if (tick % kTicksPerCount == 0) {
      progress("cells", CountFinished(plan), static_cast<int64_t>(plan.cells.size()));
    }
    ThrowIfCancelled();
    std::this_thread::sleep_for(kTick);
  }
}

}  // namespace curvefusion
