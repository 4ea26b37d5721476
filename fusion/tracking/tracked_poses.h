#pragma once

#include <optional>
#include <string>

#include "capture/sequence.h"
#include "capture/trajectory.h"
#include "fusion/tracking/track_sequence.h"
#include "kernel/progress.h"

namespace curvefusion {

/// The pose that the folder of a sequence gives to its first frame; the identity where it gives
/// none.
RigidTransform GivenStart(const Sequence& images);

/// The poses of the frames with their stamps.
Trajectory PosesOf(const Sequence& sequence);

/// Why tracked poses cannot be believed: depth images of frames apart disagree. Empty where they
/// agree, or where that cannot be told. About .1 s.
std::string DoubtOfPoses(const Sequence& tracked);

/// The sequence with the poses that its depth and colour images tell, from the first given one on:
/// what stands behind the wires then lies still, and has the size that depth says. Nothing where
/// a frame could not be placed, or depth disagrees with what was found. Exceptions of `progress`
/// pass through, and those for images that cannot be read.
std::optional<Sequence> HeldToItsSurfaces(const Sequence& given, const Progress& progress);

/// What a reconstruction needs of the poses of a sequence: those that it has must fit its depth;
/// where it has none, they are tracked from the one that its folder gives to the first frame. The
/// sequence then holds the frames that could be placed. Returns how tracking went, where it was
/// done. Throws Error(kBadInput) where poses cannot be believed. Exceptions of `progress` pass
/// through.
std::optional<TrackingResult> FindPoses(Sequence& sequence, const Progress& progress);

}  // namespace curvefusion
