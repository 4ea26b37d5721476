#pragma once

#include <cstdint>

#include "kernel/geometry.h"

namespace curvefusion {

// An order of points in which neighbours in space are mostly near each other: the Morton order of
// their coordinates as they are stored, mapped to whole numbers of the same order. It needs no
// bounding box, so where a point comes depends on that point alone. The two zeros are one.
// Connor and Kumar, Fast construction of k-nearest neighbor graphs for point clouds, 2010.

/// The first 63 bits by which points are ordered: where they differ, they decide. Finite
/// coordinates.
uint64_t MortonCode(const Vec3& p);

/// Whether a point comes before another: a strict total order. Finite coordinates.
bool ComesBefore(const Vec3& a, const Vec3& b);

}  // namespace curvefusion
