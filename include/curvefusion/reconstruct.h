#pragma once

/// @file
/// The whole method: Reconstruct turns a sequence into the skeleton, a graph of curves on the
/// wires' axes with radii, and says how far it may be trusted. Link `curvefusion::fusion`.
///
///     #include <curvefusion/check.h>
///     #include <curvefusion/reconstruct.h>
///     #include <curvefusion/sequence.h>
///     #include <curvefusion/skeleton_io.h>
///
///     Sequence sequence = OpenSequence("scan", PoseUse::kIfGiven);
///     UseFittedColourCamera(sequence);  // changes it only where colour lies beside depth
///     FindPoses(sequence, NoProgress);  // tracks the camera only where there are no poses
///     PipelineObserver observer;        // ignores all events; derive from it to hear of them
///     const Reconstruction result =
///         Reconstruct(sequence, ProfileOptions(Profile::kBest), observer);
///     if (!result.skeleton.empty()) WriteSkeleton("skeleton.json", result.skeleton);
///
/// Profile::kPaper is the published method, Profile::kBest what `curvefusion reconstruct` does by
/// default (docs/overview.md); settings from a file: `<curvefusion/config.h>`.
///
/// The result, in metres and in the world frame of the sequence's poses:
/// - `skeleton`: the curves, as in the paper's "skeleton with a radius function"; empty where
///   nothing thin was found, which is no error;
/// - `uncertain`: curves that are probably no wires (best profile only);
/// - `sequence`: the sequence with its poses as corrected;
/// - `trust`, `warnings`: how far to believe it. Doubts(result.trust) gives sentences, none where
///   nothing speaks against the result.
///
/// Throws Error (`<curvefusion/error.h>`) where the sequence cannot be used. Takes some 2.5 s for
/// 30 frames of 640 x 480 on two cores, and uses all cores; results do not depend on their number.

#include "fusion/pipeline.h"
