#pragma once

#include "capture/sequence.h"
#include "fusion/reconstruction.h"

namespace curvefusion {

/// Gives the result the size that the poses of the input have: images alone do not tell it, and
/// adjusting curves and poses to them lets it drift by up to a percent. Scales curves, radii,
/// points and cameras about the middle of the cameras, which the tracker tells, by the factor that
/// fits these best to those of `given`. Nothing where there are no curves or the camera stands.
void HoldToScaleOf(const Sequence& given, Reconstruction& result);

/// Likewise so that depth images agree best (ScaleByDepth); a warning where they cannot tell.
void HoldToScaleOfDepth(Reconstruction& result);

}  // namespace curvefusion
