#pragma once

/// RGB-D sequences: OpenSequence lists the frames of a folder or of a recording in one file, images
/// are decoded when they are asked for. FindPoses gives a sequence without poses those of the
/// tracker.

#include "capture/sequence.h"
#include "fusion/tracking/tracked_poses.h"
