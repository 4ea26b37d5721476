#pragma once

#include "graph/skeleton_graph.h"
#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// The curves of a skeleton as wide as a colour image shows them: depth may not show them, and what
/// is behind them is not seen.
class CurvesInFront {
 public:
  CurvesInFront(const SkeletonGraph& skeleton, const PinholeCamera& camera,
                const RigidTransform& T_camera_world);

  /// Whether one is nearer than a depth (metres) at a pixel of the image.
  bool AreNearer(int u, int v, double depth) const {
    const float nearest = nearest_(u, v);
    return nearest > 0 && nearest < depth;
  }

 private:
  Image<float> nearest_;  // metres; 0 = no curve
};

}  // namespace curvefusion
