#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Root mean square distance of the estimated camera centres from the true ones after one rigid
/// alignment of all (Sturm et al. 2012: absolute trajectory error), metres. As many poses in both,
/// at least 3 that do not lie on a line.
double AbsoluteTrajectoryError(const std::vector<RigidTransform>& estimate,
                               const std::vector<RigidTransform>& truth);

/// How motions over some frames differ from the true ones, as root mean squares.
struct RelativePoseError {
  double translation = 0;  ///< metres
  double rotation = 0;     ///< radians
};

/// Over all pairs of poses that are `frames_apart` (Sturm et al. 2012: relative pose error). As
/// many poses in both, more than `frames_apart`.
RelativePoseError RelativePoseErrors(const std::vector<RigidTransform>& estimate,
                                     const std::vector<RigidTransform>& truth, int frames_apart);

}  // namespace curvefusion
