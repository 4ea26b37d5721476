#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Pairs expected points with found ones one to one, as many as are nearer than `max_distance` to
/// each other, and of those pairings the one with the least sum of distances (Hungarian). Entry i
/// is the partner of expected[i], or -1.
std::vector<int> MatchPoints(const std::vector<Vec3>& expected, const std::vector<Vec3>& found,
                             double max_distance);

}  // namespace curvefusion
