#pragma once

#include "kernel/camera.h"
#include "kernel/image.h"
#include "kernel/options.h"

namespace curvefusion {

/// Removal of thin parts from a depth rendering, CurveFusion 4.1.
struct DepthOpeningOptions {
  /// Metres, 0 to 0.5: surfaces are eroded and dilated by so much, measured across the line of
  /// sight; what is narrower than twice that goes (CurveFusion 4.1).
  double radius = 0.02;
  /// Metres, 0.001 to 0.5: a step of depth between neighbouring pixels above that is a
  /// discontinuity unless the surface is as steep beside it (the paper gives no value; three
  /// voxels of the paper profile).
  double discontinuity = 0.015;
  /// Metres, 0 to 0.1: what was seen through so far behind its surface is none; 0 = not asked. A
  /// wire is thinner, a box thicker.
  double solid_depth = 0;
};
void VisitOptions(DepthOpeningOptions& options, OptionVisitor& visitor);

/// The rendering (metres, 0 = nothing) without its parts narrower than twice the radius: these
/// become 0, all other pixels stay as they are.
///
/// Surfaces are eroded from the depth discontinuities on whose near side they lie, and then dilated
/// back. The far side is no edge, the surface goes on behind: between two wires nothing of the wall
/// is lost. Neither is the border of the image. Where nothing was rendered there is free space
/// beyond reach or a gap in the scan; it counts as far, so that wires before it go, and gaps do no
/// harm to surfaces because dilation restores them. What `solidity` (SolidityBehind; empty = all
/// solid) says was seen through does not outlast erosion either: a grille may look like a surface
/// from one side. Distances are Euclidean in pixels, taken to
/// metres by each pixel's depth, and run within one surface only, never across a discontinuity.
/// Throws Error(kBadInput) for a rendering of another size than the camera's.
/// Cost: linear in pixels.
DepthImage OpenDepth(const DepthImage& rendering, const PinholeCamera& camera,
                     const DepthImage& solidity, const DepthOpeningOptions& options);

}  // namespace curvefusion
