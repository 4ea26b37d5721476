#pragma once

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/reconstruction.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

/// The method that users get by default. Throws Error for input that cannot be read.
Reconstruction ReconstructBest(const Sequence& sequence, const BestOptions& options,
                               PipelineObserver& observer);

/// The same where the large surfaces are known already: `volume` holds them in the sequence's world
/// frame and may have seen more frames than the sequence has.
Reconstruction ReconstructBestAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                      const BestOptions& options, PipelineObserver& observer);

}  // namespace curvefusion
