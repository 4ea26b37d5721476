#pragma once

#include <chrono>
#include <vector>

#include "apps/progress_printer.h"
#include "apps/result_folder.h"
#include "apps/run_observer.h"
#include "capture/sequence.h"
#include "experiments/config.h"
#include "fusion/shards/shard_file.h"

namespace curvefusion {

/// How a sequence becomes a folder of results.
struct ResultRun {
  const Config& config;
  bool fit_colour_camera = true;  ///< where colour edges lie far from depth edges
  StageOutputs stages;
  bool quiet = false;
  std::chrono::steady_clock::time_point start;  ///< of the command, for its report
  bool hybrid = false;                          ///< write hybrid.ply and .stl as well
  std::vector<Shard> shards = {};               ///< all of it (OpenShards), where it was split
};

/// Finds what the sequence lacks (poses, the colour camera), reconstructs it and writes all files
/// of the result; then tells on standard output what was found. Returns the exit code of the
/// command: kNothingThin where nothing was found. Throws Error where the sequence cannot be used or
/// a file not be written; where the curves have no sound mesh, once all other files are there.
int ReconstructInto(const ResultFolder& output, Sequence sequence, const ResultRun& run,
                    ProgressPrinter& printer);

}  // namespace curvefusion
