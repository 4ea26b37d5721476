#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/progress_printer.h"
#include "fusion/pipeline.h"

namespace curvefusion {

/// What to keep of a run besides its result; empty paths = nothing.
struct StageOutputs {
  std::filesystem::path folder;  ///< NAME.ply or .csv for every intermediate result
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
  void OnTable(const std::string& name, const std::function<std::string()>& csv) override;
  void OnVolume(const TsdfVolume& volume) override;

 private:
  ProgressPrinter& printer_;
  StageOutputs outputs_;
};

}  // namespace curvefusion
