#include "experiments/baselines/volumetric_fusion.h"

#include <algorithm>
#include <utility>

#include "fusion/tracking/track_sequence.h"
#include "fusion/volume/volume_fusion.h"

namespace curvefusion {

TsdfVolume FusedVolume(const Sequence& sequence, const TsdfOptions& options,
                       const Progress& progress, int stride) {
  int frames = 0;
  return FuseVolume(sequence, options, stride, [&] {
    frames += stride;
    progress("volume", std::min(frames, sequence.frame_count()), sequence.frame_count());
  });
}

TriangleMesh VolumeFusionSurface(const Sequence& sequence, const TsdfOptions& options,
                                 const Progress& progress) {
  return FusedVolume(sequence, options, progress).ExtractMesh();
}

KinectFusionResult FuseAsKinectFusion(const Sequence& sequence, const TsdfOptions& options,
                                      const Progress& progress) {
  KinectFusionResult result;
  if (sequence.frames.empty()) return result;
  TrackingOptions tracking;
  tracking.use_color = false;
  result.tracked =
      TrackFrames(sequence, sequence.frames.front().T_world_camera, tracking, progress).sequence;
  result.surface = VolumeFusionSurface(result.tracked, options, progress);
  return result;
}

}  // namespace curvefusion
