#pragma once

#include <functional>
#include <optional>

#include "capture/sequence.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

/// VolumeFusion of every `stride`-th frame of a sequence, CurveFusion 4.1: the model of the large
/// surfaces, within a box where one is given. `on_frame` is called after each one. Throws
/// Error(kBadInput) for an image that cannot be read.
TsdfVolume FuseVolume(const Sequence& sequence, const TsdfOptions& options, int stride,
                      const std::function<void()>& on_frame,
                      const std::optional<Eigen::AlignedBox3d>& box = {});

}  // namespace curvefusion
