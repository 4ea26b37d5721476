#pragma once

/// The whole method: Reconstruct turns a sequence into curves with radii, and says how far they can
/// be trusted. With <curvefusion/sequence.h> and <curvefusion/check.h>:
///
///     Sequence sequence = OpenSequence("scan", PoseUse::kIfGiven);
///     UseFittedColourCamera(sequence);  // only where colour lies beside depth
///     FindPoses(sequence, NoProgress);  // tracks the camera where poses are missing
///     PipelineObserver observer;
///     Reconstruction result = Reconstruct(sequence, ProfileOptions(Profile::kBest), observer);

#include "fusion/pipeline.h"
