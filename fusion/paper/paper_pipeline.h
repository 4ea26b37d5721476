#pragma once

#include "capture/sequence.h"
#include "fusion/paper/paper_options.h"
#include "fusion/reconstruction.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

/// The method of "CurveFusion: Reconstructing Thin Structures from RGBD Sequences" (Liu, Chen,
/// Ceylan, Theobalt, Wang, Mitra; ACM TOG 37(6), 2018) as it is written; docs/paper_profile.md goes
/// through it sentence by sentence. Throws Error for input that cannot be read.
Reconstruction ReconstructPaper(const Sequence& sequence, const PaperOptions& options,
                                PipelineObserver& observer);

/// The same where VolumeFusion is done already: `volume` holds the scene in the sequence's world
/// frame and may have seen more frames than the sequence has.
Reconstruction ReconstructPaperAgainst(const TsdfVolume& volume, const Sequence& sequence,
                                       const PaperOptions& options, PipelineObserver& observer);

}  // namespace curvefusion
