#include "experiments/baselines/volumetric_fusion.h"

#include <utility>

#include "fusion/tracking/track_sequence.h"
#include "fusion/volume/volume_fusion.h"

namespace curvefusion {

TriangleMesh VolumeFusionSurface(const Sequence& sequence, const TsdfOptions& options,
                                 const Progress& progress) {
  int frames = 0;
  const TsdfVolume volume = FuseVolume(
      sequence, options, 1, [&] { progress("volume", ++frames, sequence.frame_count()); });
  return volume.ExtractMesh();
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
