#pragma once

#include "fusion/volume/tsdf_volume.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// What bounds a solid.
struct SolidBounds {
  TriangleMesh surface;  ///< as it was seen, open, towards the free side
  TriangleMesh room;     ///< what it stands on, towards the solid
  TriangleMesh contact;  ///< where it does so, hidden, towards the solid
};

/// The closed surface of the solid behind a surface that was extracted from `volume`: what lies at
/// most `thickness` metres behind it, and what no frame saw as free and the surface with its
/// contact faces would enclose if its holes were closed (winding number above 1/2). Nothing lies
/// behind room or contact. Gaps that no frame saw and that are narrower than four voxels are
/// closed, hollows and pieces of less than `min_volume` (m^3) filled and dropped. Closed, oriented,
/// 2-manifold. Cost: linear in the voxels of the surface's box.
TriangleMesh SolidBehind(const SolidBounds& bounds, const TsdfVolume& volume, double thickness,
                         double min_volume);

}  // namespace curvefusion
