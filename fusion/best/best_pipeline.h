#pragma once

#include "capture/sequence.h"
#include "fusion/best/best_options.h"
#include "fusion/best/bundle_segmentation.h"
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

/// The part of ReconstructBest that looks at single bundles, for these alone: the volume of all
/// frames, what is learned of them, and the segmentation. Does not need any result for other
/// bundles, and finds the same in each as ReconstructBest does. Throws as that, and what the sink
/// throws.
void SegmentBest(const Sequence& sequence, const BestOptions& options, BundleRange range,
                 const BundleSink& sink, PipelineObserver& observer);

/// The rest of ReconstructBest: the same result, bit for bit, from what SegmentBest found in all
/// bundles of the sequence with the same options. The volume is fused again, for the observer
/// alone, where `fuse_volume` says so. Throws as ReconstructBest, and what the source throws.
Reconstruction ReconstructBestFrom(const BundleSource& shards, const Sequence& sequence,
                                   const BestOptions& options, PipelineObserver& observer,
                                   bool fuse_volume);

}  // namespace curvefusion
