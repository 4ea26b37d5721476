#include "meshing/junction_resampling.h"

#include <algorithm>

#include "meshing/junction_core.h"
#include "meshing/union_resampling.h"

namespace curvefusion {

namespace {

// In radii. A tube has a dozen corners on such a grid, and loses 2 % of its section.
constexpr double kSpacing = 0.5;
// The rim of a flat end loses a cell, which must not reach the end of the collar. Shorter segments
// than some radii, as of curves with noise, are left to chance.
constexpr double kLeastSpacing = 0.15;

}  // namespace

std::optional<UnionMesh> ResampleJunction(const Junction& junction) {
  return ReplaceCore(junction, [&](const std::vector<TriangleMesh>& stubs, double overlap) {
    const double spacing = std::min(kSpacing * junction.radius, overlap);
    return ResampleUnion(stubs, std::max(spacing, kLeastSpacing * junction.radius));
  });
}

}  // namespace curvefusion
