#pragma once

#include <vector>

#include "experiments/metrics/explained_share.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// How far a result is looked for from where it lies. Chosen: beyond the greatest absolute
/// trajectory error of the simulator's pose sources, 26 mm (ptam over 1500 frames,
/// docs/simulator.md). Poses of a scan lie in the truth's frame but for their drift: starts farther
/// away, as turns of a symmetric object, would be wrong.
inline constexpr double kSearchReach = 30 * kMillimetre;

/// Motions of the result, within kSearchReach and some degrees of identity, from which aligning it
/// promises most: a few that are no neighbours of each other, found by how much of some hundred
/// points of the truth they explain to 20 mm. About 400 such looks.
std::vector<RigidTransform> AlignmentStarts(const ExplainingPoints& result,
                                            const std::vector<Vec3>& truth);

}  // namespace curvefusion
