#pragma once

#include <vector>

#include "capture/sequence.h"
#include "fusion/paper/surface_removal.h"
#include "kernel/geometry.h"
#include "kernel/options.h"

namespace curvefusion {

/// "We detect curve edges in each RGB frame": Canny (1986); the paper names neither the detector
/// nor thresholds, these are the kit's.
struct CurveEdgeOptions {
  double low_threshold = 40;    ///< grey levels of the gradient at which an edge goes on, 0 to 2000
  double high_threshold = 100;  ///< at which it begins
};
void VisitOptions(CurveEdgeOptions& options, OptionVisitor& visitor);

/// The pixels on colour edges of all frames of a bundle, lifted by "the corresponding raw depth
/// measurements": the depth image is projected into the colour image, the nearest depth where
/// several meet, and every edge pixel with a depth becomes a point in the first frame's depth
/// camera. CurveFusion 4.1 "Removing 'ghost' points". Throws Error(kBadInput) for an image that
/// cannot be read.
std::vector<Vec3> LiftColourEdges(const Sequence& sequence, const BundleFrames& frames,
                                  const CurveEdgeOptions& options);

/// The depth image as the colour camera would have taken it: the nearest depth of each of its
/// pixels, metres along its axis, 0 = none.
DepthImage RegisteredDepth(const DepthImage& depth, const Sequence& sequence);

}  // namespace curvefusion
