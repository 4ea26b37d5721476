#pragma once

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"
#include "kernel/progress.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// FuseVolume, whose progress is told as that of the stage "volume".
TsdfVolume FusedVolume(const Sequence& sequence, const TsdfOptions& options,
                       const Progress& progress, int stride = 1);

/// VolumeFusion (Curless and Levoy 1996): the marching-cubes surface of a TSDF of all depth images.
/// Given: depth and the sequence's poses. Throws Error(kBadInput) for an image that cannot be read.
TriangleMesh VolumeFusionSurface(const Sequence& sequence, const TsdfOptions& options,
                                 const Progress& progress);

/// What KinectFusion makes of a sequence.
struct KinectFusionResult {
  TriangleMesh surface;
  Sequence tracked;  ///< the frames that could be placed, with their poses
};

/// KinectFusion (Newcombe et al. 2011): frame-to-model point-to-plane ICP on depth alone, then
/// VolumeFusion of the frames that could be placed. Given: depth, and the first frame's pose, so
/// that the result lies in the world of the truth. Unlike the published system it tracks against a
/// volume of its own, of 10 mm voxels (CameraTracker); the surface comes from `options`. Errors
/// as VolumeFusionSurface.
KinectFusionResult FuseAsKinectFusion(const Sequence& sequence, const TsdfOptions& options,
                                      const Progress& progress);

}  // namespace curvefusion
