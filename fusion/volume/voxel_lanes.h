#pragma once

#include <cstdint>

namespace curvefusion {

/// Four voxels of a row at once: the compiler maps these types to the SIMD registers there are.
/// Derived: the floats in 16 bytes.
inline constexpr int kVoxelLanes = 4;
typedef float Float4 __attribute__((vector_size(16)));
typedef int32_t Int4 __attribute__((vector_size(16)));

}  // namespace curvefusion
