#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/progress_printer.h"
#include "fusion/pipeline.h"

namespace curvefusion {

/// What to keep of a run besides its result; empty paths = nothing.
struct StageOutputs {
  std::filesystem::path folder;  ///< NAME.ply for every intermediate point set and graph
  std::filesystem::path volume;  ///< mesh of the volume, in a format of WriteMesh
};

/// What the command does after the stages of Reconstruct: pictures, tubes, files.
inline constexpr const char* kWritingStage = "tubes and files";

/// Shows progress, ends the run once the user interrupts, and saves what was asked for.
class RunObserver : public PipelineObserver {
 public:
  /// Makes the folder for stages. Throws Error(kResource) where that is impossible, Error(kUsage)
  /// where the volume's file is of no mesh format.
  RunObserver(ProgressPrinter& printer, StageOutputs outputs);

  void OnPlan(const std::vector<PlannedStage>& stages) override;
  void OnProgress(const std::string& stage, int64_t done, int64_t total) override;
  void OnPoints(const std::string& name, const ObservedPoints& points) override;
  void OnGraph(const std::string& name, const SkeletonGraph& graph) override;
  void OnEvidence(const std::string& name, const SkeletonGraph& candidates,
                  const std::vector<StretchEvidence>& evidence) override;
  void OnVolume(const TsdfVolume& volume) override;

 private:
  ProgressPrinter& printer_;
  StageOutputs outputs_;
};

}  // namespace curvefusion
