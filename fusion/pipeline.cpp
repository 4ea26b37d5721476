#include "fusion/pipeline.h"

#include "fusion/best/best_pipeline.h"
#include "fusion/paper/paper_pipeline.h"

namespace curvefusion {

PipelineOptions ProfileOptions(Profile profile) {
  if (profile == Profile::kPaper) return PaperOptions();
  return DefaultBestOptions();
}

void VisitOptions(PipelineOptions& options, OptionVisitor& visitor) {
  std::visit([&](auto& of_profile) { VisitOptions(of_profile, visitor); }, options);
}

const TsdfOptions& VolumeOptions(const PipelineOptions& options) {
  return std::visit([](const auto& of_profile) -> const TsdfOptions& { return of_profile.volume; },
                    options);
}

Reconstruction Reconstruct(const Sequence& sequence, const PipelineOptions& options,
                           PipelineObserver& observer) {
  if (const auto* paper = std::get_if<PaperOptions>(&options)) {
    return ReconstructPaper(sequence, *paper, observer);
  }
  return ReconstructBest(sequence, std::get<BestOptions>(options), observer);
}

Reconstruction ReconstructAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                  const PipelineOptions& options, PipelineObserver& observer) {
  if (const auto* paper = std::get_if<PaperOptions>(&options)) {
    return ReconstructPaperAgainst(volume, sequence, *paper, observer);
  }
  return ReconstructBestAgainst(volume, sequence, std::get<BestOptions>(options), observer);
}

}  // namespace curvefusion
