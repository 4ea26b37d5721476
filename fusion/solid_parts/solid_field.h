#pragma once

#include "fusion/solid_parts/box_volume.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The closed surface of the solid behind an open surface that was extracted from `volume`: what
/// lies at most `thickness` metres behind it, and what no frame saw as free and the surface would
/// enclose if its holes were closed (winding number above 1/2), but not behind a surface of the room,
/// on which it stands. Closed, oriented, 2-manifold;
/// hollows and pieces of less than `min_volume` (m^3) are filled and dropped. Cost: linear in the
/// voxels of the surface's box.
TriangleMesh SolidBehind(const TriangleMesh& surface, const TriangleMesh& room,
                         const BoxVolume& volume, double thickness, double min_volume);

}  // namespace curvefusion
