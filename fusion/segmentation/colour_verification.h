#pragma once

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// Gradients in grey levels; chosen: CurveFusion 4.1 detects edges and gives no values.
struct CannyThresholds {
  double low = 40;    ///< at which an edge goes on
  double high = 100;  ///< at which it begins
};

/// Colour edges (Canny on the channel with the strongest gradient), 1 on an edge. Candidates are
/// verified with them, CurveFusion 4.1.
MaskImage ColourEdges(const ColorImage& color, const CannyThresholds& thresholds = {});

/// 1 at every pixel of `mask` (a mask of the depth image) whose point projects within tolerance_px
/// of a colour edge.
MaskImage MaskPixelsOnEdges(const MaskImage& mask, const DepthImage& depth, const MaskImage& edges,
                            const PinholeCamera& depth_camera, const PinholeCamera& color_camera,
                            const RigidTransform& T_color_depth, double tolerance_px);

}  // namespace curvefusion
