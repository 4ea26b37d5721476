#pragma once

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// Calls body(u, v, p_world) for the pixels of a rendering that show a surface.
template <class Body>
void ForEachRenderedPoint(const DepthImage& rendering, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera, const Body& body) {
  for (int v = 0; v < rendering.height(); ++v)
    for (int u = 0; u < rendering.width(); ++u)
      if (rendering(u, v) > 0)
        body(u, v, Vec3(T_world_camera * camera.Unproject(u, v, rendering(u, v))));
}

}  // namespace curvefusion
