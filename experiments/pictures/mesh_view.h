#pragma once

#include "experiments/pictures/orthographic_view.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// Draws a mesh as opaque grey surface lit from the viewer, both sides alike; the middle of
/// `bounds` (in the view's axes) in the middle of the picture, `scale` in pixels per metre. Linear
/// in the pixels of all triangles.
ColorImage DrawMesh(const TriangleMesh& mesh, const OrthographicView& view,
                    const Eigen::AlignedBox3d& bounds, int width, int height, double scale);

}  // namespace curvefusion
