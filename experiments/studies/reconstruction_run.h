#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "experiments/studies/study.h"
#include "fusion/pipeline.h"

namespace curvefusion {

/// What a piece of work cost. Memory is of the whole process, and so are CPU seconds: with more
/// than one job at a time they hold what the others spent.
struct Cost {
  double seconds = 0;
  double cpu_seconds = 0;  ///< user and system, of all threads
  double peak_memory = 0;  ///< bytes
};
Cost CostOf(const std::function<void()>& work);

/// Adds `seconds`, `cpu_seconds`, both per 30 frames (the paper's bundle), and `peak_memory_mb`.
void AddCost(const Cost& cost, int frames, Figures& figures);

/// Adds `contraction_share`, of all seconds, and `seconds_per_30_frames_without_contraction`, as
/// the paper's Table 1 counts.
void AddContractionCost(const std::vector<StageReport>& stages, const Cost& cost, int frames,
                        Figures& figures);

/// Passes the progress of a reconstruction on, so that it ends once the user interrupts.
class InterruptibleObserver : public PipelineObserver {
 public:
  explicit InterruptibleObserver(const Progress& progress) : progress_(progress) {}
  void OnProgress(const std::string& stage, int64_t done, int64_t total) override {
    progress_(stage, done, total);
  }

 private:
  const Progress& progress_;
};

/// Where the truth of a scan lies: SCAN/truth of a simulated one, or SCAN.truth beside it. None
/// where there is neither.
std::optional<std::filesystem::path> TruthOf(const std::filesystem::path& scan);

/// Keeps a result (config.toml, skeleton.json, evaluation.json) and gives all figures of `evaluate`
/// without a mesh; of a scan without truth its length alone.
RunOutcome EvaluateAndKeep(const SkeletonGraph& skeleton, const RunInput& input);

/// The whole method on the case's scan: EvaluateAndKeep and what it cost.
RunOutcome ReconstructAndEvaluate(const RunInput& input);

/// Reconstruct, or what takes its place.
using ReconstructionMethod = std::function<Reconstruction(const Sequence&, PipelineObserver&)>;

/// The same by another method, for which so much was spent elsewhere beforehand.
RunOutcome ReconstructAndEvaluateBy(const ReconstructionMethod& method, const Cost& before,
                                    const RunInput& input);

}  // namespace curvefusion
