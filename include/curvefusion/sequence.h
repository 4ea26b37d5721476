#pragma once

/// @file
/// RGB-D sequences: pairs of a depth and a colour image (frames), the cameras' intrinsics and,
/// where they are known, their poses. Link `curvefusion::fusion`, or `curvefusion::capture` for
/// OpenSequence and the images alone.
///
///     Sequence sequence = OpenSequence("scan", PoseUse::kIfGiven);  // a folder or a recording
///     FindPoses(sequence, NoProgress);
///     const DepthImage depth = LoadDepth(sequence, 0);  // float, metres; 0 = no measurement
///     const ColorImage color = LoadColor(sequence, 0);  // 8 bits of red, green and blue
///     const RigidTransform& T_world_camera = sequence.frames[0].T_world_camera;
///
/// A pose `T_world_camera` maps points of the depth camera's frame (x right, y down, z forwards,
/// metres) to the world. OpenSequence reads lists, poses and headers; images are decoded, and their
/// lens distortion is undone, when they are asked for. By default it wants poses and depth; PoseUse
/// and DepthUse say what else will do. Layouts: docs/formats_input.md.
///
/// FindPoses does what `curvefusion reconstruct` does before all else: where there are no poses it
/// tracks the camera (the paper uses ORB-SLAM for that) and keeps the frames that it could place;
/// where there are some it looks whether depth images agree under them. It throws Error where they
/// do not. Errors: `<curvefusion/error.h>`.

#include "capture/sequence.h"
#include "fusion/tracking/tracked_poses.h"
