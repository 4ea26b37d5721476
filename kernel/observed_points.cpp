#include "kernel/observed_points.h"

#include <fmt/format.h>

#include "kernel/error.h"

namespace curvefusion {

void RequireFinitePositions(const ObservedPoints& points) {
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points.positions[i];
    if (p.allFinite()) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("point {} of {} is ({}, {}, {}): remove points without a position", i,
                            points.size(), p.x(), p.y(), p.z()));
  }
}

}  // namespace curvefusion
