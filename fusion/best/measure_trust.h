#pragma once

#include "capture/sequence.h"
#include "fusion/reconstruction.h"

namespace curvefusion {

/// Adds shares and poses to result.trust, which holds what the adjustment to colours told. `given`
/// has the poses of the input.
Trust MeasureTrust(const Sequence& given, const Reconstruction& result);

}  // namespace curvefusion
