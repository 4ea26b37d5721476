#pragma once

#include "kernel/polyline.h"

namespace curvefusion {

/// A curve from `a`, leaving in the direction `leaving`, to `b`, arriving in the direction
/// `arriving` (cubic Hermite; directions of any positive length). a and b are its ends bit for bit.
Polyline HermiteBridge(const Vec3& a, const Vec3& leaving, const Vec3& b, const Vec3& arriving);

}  // namespace curvefusion
