#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/paper/paper_options.h"
#include "graph/skeleton_graph.h"
#include "kernel/camera.h"
#include "kernel/image.h"
#include "kernel/progress.h"

namespace curvefusion {

/// How likely each pixel of a view is to show the object, 0 to 1 (Tabb 2013: a silhouette
/// probability map).
struct SilhouetteMap {
  PinholeCamera camera;
  RigidTransform T_world_camera = RigidTransform::Identity();
  Image<float> probability;
};

/// A camera that looks at a point from so far; `away` is the unit direction from the point to it.
RigidTransform PoseTowards(const Vec3& center, const Vec3& away, double distance);

/// So many cameras at a distance all around a point, in directions of a Fibonacci lattice, looking
/// at it.
std::vector<RigidTransform> PosesAround(const Vec3& center, double distance, int count);

/// What a studio would give: 1 where the ray through a pixel's centre meets a true tube, otherwise
/// 0. The truth must have radii.
std::vector<SilhouetteMap> TrueSilhouettes(const SkeletonGraph& truth, const PinholeCamera& camera,
                                           const std::vector<RigidTransform>& T_world_camera);

/// What a user has of a handheld scan: for the colour of each pixel how likely it is wire, both
/// being as likely beforehand, from colour histograms of the whole scan. Wire is where the paper's
/// segmentation finds depth of something thin, background is all else. Poses are the sequence's.
/// Nothing where no depth is thin. Throws Error(kBadInput) for an image that cannot be read.
std::vector<SilhouetteMap> ColourSilhouettes(const Sequence& sequence,
                                             const std::vector<int>& frames,
                                             const PaperOptions& options, const Progress& progress);

}  // namespace curvefusion
