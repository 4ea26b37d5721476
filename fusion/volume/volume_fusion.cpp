#include "fusion/volume/volume_fusion.h"

#include <vector>

#include "capture/frame_stream.h"

namespace curvefusion {

TsdfVolume FuseVolume(const Sequence& sequence, const TsdfOptions& options, int stride,
                      const std::function<void()>& on_frame,
                      const std::optional<Eigen::AlignedBox3d>& box) {
  TsdfVolume volume(options, box);
  std::vector<int> frames;
  for (int i = 0; i < sequence.frame_count(); i += stride) frames.push_back(i);
  ForEachFrame(sequence, frames, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    volume.Integrate(frame.depth, sequence.depth_camera,
                     sequence.frames[frame.index].T_world_camera);
    on_frame();
  });
  return volume;
}

}  // namespace curvefusion
