#pragma once

#include <cmath>
#include <cstdint>

#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Integer cell of a regular grid.
struct VoxelKey {
  int x = 0;
  int y = 0;
  int z = 0;
  bool operator==(const VoxelKey&) const = default;
  auto operator<=>(const VoxelKey&) const = default;
};

struct VoxelKeyHash {
  size_t operator()(const VoxelKey& key) const {
    return static_cast<size_t>(static_cast<uint32_t>(key.x) * 73856093u ^
                               static_cast<uint32_t>(key.y) * 19349669u ^
                               static_cast<uint32_t>(key.z) * 83492791u);
  }
};

/// The cell of side `voxel_size` that contains p.
inline VoxelKey VoxelOf(const Vec3& p, double voxel_size) {
  return {static_cast<int>(std::floor(p.x() / voxel_size)),
          static_cast<int>(std::floor(p.y() / voxel_size)),
          static_cast<int>(std::floor(p.z() / voxel_size))};
}

/// One point per occupied cell: the means of positions and rays weighted by counts (rays made unit
/// again), the sum of counts. Ordered by first occurrence, so the result depends on input order
/// only.
ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size);

}  // namespace curvefusion
