#pragma once

#include <optional>

#include "meshing/junction_union.h"

namespace curvefusion {

/// The union of two closed meshes without self-intersections that are in general position to each
/// other: what crosses is decided exactly, the places where it does are rounded. Nothing where they
/// are not in general position, or where rounding spoilt it. Near-linear in triangles and in pairs
/// that come near each other; some ten times as fast as with exact coordinates.
std::optional<UnionMesh> UniteDirectly(const UnionMesh& a, const UnionMesh& b);

}  // namespace curvefusion
