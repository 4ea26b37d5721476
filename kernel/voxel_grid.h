#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/buckets.h"
#include "kernel/geometry.h"
#include "kernel/observed_points.h"

namespace curvefusion {

/// Integer cell of a regular grid.
struct VoxelKey {
  int x = 0;
  int y = 0;
  int z = 0;
  bool operator==(const VoxelKey&) const = default;
  auto operator<=>(const VoxelKey&) const = default;  // NOLINT(modernize-use-nullptr)
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

/// The sum of what a map of voxels holds of a voxel and of the 26 around it; its values have +=.
template <class Map>
typename Map::mapped_type SumAround(const Map& values, const VoxelKey& key) {
  typename Map::mapped_type sum;
  for (int i = 0; i < 27; ++i) {
    const auto it = values.find({key.x + i % 3 - 1, key.y + i / 3 % 3 - 1, key.z + i / 9 - 1});
    if (it != values.end()) sum += it->second;
  }
  return sum;
}

/// Numbers cells in the order in which they are first asked for: an open-addressing hash table.
class VoxelNumbers {
 public:
  static constexpr int kNone = -1;

  VoxelNumbers();

  int size() const { return static_cast<int>(keys_.size()); }
  /// The cell's number, or kNone.
  int Find(const VoxelKey& key) const { return slots_[SlotOf(key)]; }
  /// The cell's number, which is size() before the call where the cell is new.
  int Number(const VoxelKey& key);
  const VoxelKey& key(int number) const { return keys_[number]; }

 private:
  // The slot that holds the cell, or the empty one where it belongs.
  size_t SlotOf(const VoxelKey& key) const;
  void Rehash(size_t slot_count);

  std::vector<VoxelKey> keys_;
  std::vector<int> slots_;  ///< a power of two, at most half full
  int slot_shift_ = 0;      ///< the hash's upper bits that index slots_
};

/// The places in each occupied cell of side `voxel_size`, a bucket a cell, in ascending order of
/// the cells' x, then y, then z. Linear.
Buckets GroupByCell(const std::vector<Vec3>& places, double voxel_size);

/// One point per occupied cell: the means of positions and rays weighted by counts (rays made unit
/// again), the sum of counts. Ordered by first occurrence, so the result depends on input order
/// only.
ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size);

/// The same, bit for bit, of all these clouds, one behind the other and each moved first, without a
/// copy of them.
ObservedPoints ResampleOnGrid(const std::vector<ObservedPoints>& clouds,
                              const std::vector<RigidTransform>& motions, double voxel_size);

}  // namespace curvefusion
