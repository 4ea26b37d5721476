#include "experiments/studies/reconstruction_run.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>

#include "capture/content/colour_findings.h"
#include "capture/sequence.h"
#include "experiments/metrics/evaluation_files.h"
#include "experiments/metrics/truth.h"
#include "fusion/trust.h"
#include "graph/io/graph_io.h"
#include "kernel/atomic_file.h"
#include "kernel/peak_memory.h"

namespace curvefusion {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kBundle = 30;  // frames of a bundle in the paper; its times are given per bundle

double Seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double CpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
}

}  // namespace

Cost CostOf(const std::function<void()>& work) {
  ResetPeakMemory();
  const auto start = Clock::now();
  const double cpu_start = CpuSeconds();
  work();
  return {std::chrono::duration<double>(Clock::now() - start).count(), CpuSeconds() - cpu_start,
          static_cast<double>(PeakMemory())};
}

void AddCost(const Cost& cost, int frames, Figures& figures) {
  figures["seconds"] = cost.seconds;
  figures["cpu_seconds"] = cost.cpu_seconds;
  figures["peak_memory_mb"] = cost.peak_memory / 1e6;
  if (frames == 0) return;
  figures["seconds_per_30_frames"] = cost.seconds * kBundle / frames;
  figures["cpu_seconds_per_30_frames"] = cost.cpu_seconds * kBundle / frames;
}

std::optional<std::filesystem::path> TruthOf(const std::filesystem::path& scan) {
  for (const std::filesystem::path& truth :
       {scan / "truth", std::filesystem::path(scan.string() + ".truth")}) {
    if (std::filesystem::is_directory(truth)) return truth;
  }
  return std::nullopt;
}

RunOutcome EvaluateAndKeep(const SkeletonGraph& skeleton, const RunInput& input) {
  const std::string config = ConfigToml(input.study_case.config);
  WriteStreamAtomically(input.folder / "config.toml",
                        [&](std::ostream& stream) { stream << config; });
  WriteSkeleton(input.folder / "skeleton.json", skeleton);
  const std::optional<std::filesystem::path> truth = TruthOf(input.scan);
  if (!truth) return {!skeleton.empty(), {{"length", skeleton.TotalLength()}}};
  const Evaluation evaluation = Evaluate(skeleton, nullptr, ReadTruth(*truth));
  WriteEvaluation(input.folder / "evaluation.json",
                  {CaseName(input.study_case), input.scan.filename().string()}, evaluation);
  return {!skeleton.empty(), EvaluationFigures(evaluation)};
}

void AddContractionCost(const std::vector<StageReport>& stages, const Cost& cost, int frames,
                        Figures& figures) {
  double contraction = 0;
  for (const StageReport& stage : stages) {
    if (stage.name == "contraction") contraction += stage.seconds;
  }
  if (cost.seconds <= 0 || frames == 0) return;
  figures["contraction_share"] = contraction / cost.seconds;
  figures["seconds_per_30_frames_without_contraction"] =
      (cost.seconds - contraction) * kBundle / frames;
}

RunOutcome ReconstructAndEvaluate(const RunInput& input) {
  return ReconstructAndEvaluateBy(
      [&](const Sequence& sequence, PipelineObserver& observer) {
        return Reconstruct(sequence, input.study_case.config.pipeline, observer);
      },
      {}, input);
}

RunOutcome ReconstructAndEvaluateBy(const ReconstructionMethod& method, const Cost& before,
                                    const RunInput& input) {
  Sequence sequence = OpenSequence(input.scan);
  UseFittedColourCamera(sequence);  // as the command does
  InterruptibleObserver observer(input.progress);
  Reconstruction result;
  const Cost own = CostOf([&] { result = method(sequence, observer); });
  const Cost cost = {before.seconds + own.seconds, before.cpu_seconds + own.cpu_seconds,
                     std::max(before.peak_memory, own.peak_memory)};
  RunOutcome outcome = EvaluateAndKeep(result.skeleton, input);
  AddCost(cost, sequence.frame_count(), outcome.figures);
  AddContractionCost(result.stages, cost, sequence.frame_count(), outcome.figures);
  outcome.figures["global_diameter_mm"] = 2 * result.radii.global_radius / kMillimetre;
  if (result.trust.is_judged()) outcome.figures["doubted"] = Doubts(result.trust).empty() ? 0 : 1;
  return outcome;
}

}  // namespace curvefusion
