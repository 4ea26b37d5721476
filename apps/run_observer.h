#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/progress_printer.h"
#include "fusion/pipeline.h"

namespace curvefusion {

/// What to keep of a run besides its result; empty paths = nothing.
struct StageOutputs {
  std::filesystem::path folder;  ///< NAME.ply for every intermediate point set and graph
  std::filesystem::path volume;  ///< PLY mesh of the volume
};

/// Shows progress, ends the run once the user interrupts, and saves what was asked for.
class RunObserver : public PipelineObserver {
 public:
  /// Makes the folder for stages. Throws Error(kResource) where that is impossible.
  RunObserver(ProgressPrinter& printer, StageOutputs outputs);

  void OnProgress(const std::string& stage, int64_t done, int64_t total) override;
  void OnPoints(const std::string& name, const ObservedPoints& points) override;
  void OnGraph(const std::string& name, const SkeletonGraph& graph) override;
  void OnVolume(const TsdfVolume& volume) override;

 private:
  ProgressPrinter& printer_;
  StageOutputs outputs_;
};

}  // namespace curvefusion
