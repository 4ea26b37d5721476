#include "fusion/pipeline.h"

#include "fusion/best/best_pipeline.h"
#include "fusion/paper/paper_pipeline.h"
#include "kernel/error.h"

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

DepthUse DepthUseOf(const PipelineOptions& options) {
  const auto* best = std::get_if<BestOptions>(&options);
  if (best == nullptr) return DepthUse::kNeeded;
  if (best->depth.use == DepthRole::kAuto) return DepthUse::kIfGiven;
  return best->depth.use == DepthRole::kNone ? DepthUse::kIgnored : DepthUse::kNeeded;
}

Reconstruction Reconstruct(const Sequence& sequence, const PipelineOptions& options,
                           PipelineObserver& observer) {
  if (!sequence.has_depth && DepthUseOf(options) == DepthUse::kNeeded) {
    throw Error(
        ErrorKind::kBadInput,
        sequence.folder.string() +
            ": has no depth images, from which curves are to be made; take the best profile "
            "with depth.use = \"auto\" or \"none\"");
  }
  const Sequence images = KeepingImages(sequence);
  const auto* paper = std::get_if<PaperOptions>(&options);
  Reconstruction result = paper != nullptr
                              ? ReconstructPaper(images, *paper, observer)
                              : ReconstructBest(images, std::get<BestOptions>(options), observer);
  result.sequence.decoded = sequence.decoded;
  return result;
}

}  // namespace curvefusion
