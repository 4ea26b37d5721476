#pragma once

#include <optional>
#include <vector>

#include "kernel/polyline.h"

namespace curvefusion {

/// A place on a polyline: on the segment from point `segment` to the next, at a parameter in
/// [0, 1].
struct PolylinePlace {
  size_t segment = 0;
  double parameter = 0;
};

/// Whether two polylines can be followed from front to back at the same time, neither ever turning
/// back, without being farther apart than `distance` (limit included): whether their Fréchet
/// distance is at most that, decided exactly on the stored coordinates. If so, the first place of b
/// that can be reached with each point of a: these places ascend, and lie within the distance up to
/// rounding. No segment may have length zero. O(n + m + k) in points and in pairs of a point and a
/// segment within the distance that can be reached so. Alt and Godau, Computing the Fréchet
/// distance between two polygonal curves, 1995.
std::optional<std::vector<PolylinePlace>> MatchInOrder(const Polyline& a, const Polyline& b,
                                                       double distance);

}  // namespace curvefusion
