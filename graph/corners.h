#pragma once

#include <cstddef>
#include <optional>

#include "kernel/polyline.h"

namespace curvefusion {

/// The vertex at which a curve turns most, where that is by more than `min_turn` (radians) from the
/// 10 mm before it to the 10 mm after it: two wires that meet, drawn as one, rather than a bent
/// rod, which turns by 10 mm over the radius of its bend.
std::optional<size_t> SharpestCorner(const Polyline& points, double min_turn);

}  // namespace curvefusion
