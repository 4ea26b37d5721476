#pragma once

#include <optional>
#include <string>
#include <vector>

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

/// The sequence with the poses of these frames, ascending, held to surfaces, from the first of them
/// as given on: each moves as given since the one before, unless what stands behind the wires tells
/// otherwise (CameraTracker::TrackNear). Other frames stay as given. Exceptions of `progress` pass
/// through, and those for images that cannot be read. Costs 30 ms a frame.
Sequence HeldToItsSurfaces(const Sequence& given, const std::vector<int>& frames,
                           const Progress& progress);

/// What a reconstruction needs of the poses of a sequence: those that it has must fit its depth;
/// where it has none, they are tracked from the one that its folder gives to the first frame. The
/// sequence then holds the frames that could be placed. Returns how tracking went, where it was
/// done. Throws Error(kBadInput) where poses cannot be believed. Exceptions of `progress` pass
/// through.
std::optional<TrackingResult> FindPoses(Sequence& sequence, const Progress& progress);

}  // namespace curvefusion
