#pragma once

#include <filesystem>
#include <string>

#include "experiments/sweeps/sweep_plan.h"
#include "kernel/progress.h"

namespace curvefusion {

/// Where the cells of a sweep are measured.
struct SweepRunOptions {
  int jobs = 0;        ///< cores of this machine, or jobs in Slurm's queue; 0 = all cores, or 64
  bool slurm = false;  ///< every scan and cell is a job of Slurm (srun)
  std::filesystem::path program;  ///< this one, as other machines find it, too
};

/// Lets Snakemake make the scans and measure the cells that the sweep lacks, and waits for it. What
/// could not be measured is tried once more, and does not keep the rest from being measured: ask
/// StatusOf afterwards. `progress` counts cells. Snakemake ends with this process. Throws
/// Error(kBadInput) for a plan of another version of the method; Error(kResource), before anything
/// is begun, where Snakemake, or srun with `slurm`, cannot be found or the disk is too small;
/// Error(kInterrupted).
void MeasureSweep(const SweepPlan& plan, const SweepRunOptions& options, const Progress& progress);

}  // namespace curvefusion
