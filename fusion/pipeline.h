#pragma once

#include <variant>

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/paper/paper_options.h"
#include "fusion/reconstruction.h"
#include "kernel/options.h"

namespace curvefusion {

/// The paper as it is written, or what a user gets by default.
enum class Profile { kPaper, kBest };

/// The options of one profile, which decide which method runs. Default-constructed they are the
/// paper's; ProfileOptions gives those of either.
using PipelineOptions = std::variant<PaperOptions, BestOptions>;

/// The options a profile starts from, before the config file and --set.
PipelineOptions ProfileOptions(Profile profile);

/// Visits every option of the profile, each stage in a section of its own.
void VisitOptions(PipelineOptions& options, OptionVisitor& visitor);

/// The options of VolumeFusion, which both profiles have.
const TsdfOptions& VolumeOptions(const PipelineOptions& options);

/// What becomes of the depth images of a sequence that is opened for this.
DepthUse DepthUseOf(const PipelineOptions& options);

/// The whole method of a profile. `sequence` must have poses (FindPoses makes them where they are
/// missing); the result is in its world frame. A plain PipelineObserver ignores all events. Throws
/// Error for input that cannot be read, and for a sequence without depth where DepthUseOf needs it.
Reconstruction Reconstruct(const Sequence& sequence, const PipelineOptions& options,
                           PipelineObserver& observer);

}  // namespace curvefusion
