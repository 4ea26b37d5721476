#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/voxel_grid.h"

namespace curvefusion {

/// Voxels along the side of a block and in a block. Chosen: a power of two, as blocks are found by
/// shifts, and 3 KiB a block.
inline constexpr int kBlockSide = 8;
inline constexpr int kBlockVoxels = kBlockSide * kBlockSide * kBlockSide;

/// The key of the block that holds a voxel.
constexpr VoxelKey BlockOf(const VoxelKey& voxel) {
  static_assert(kBlockSide == 1 << 3);
  return {voxel.x >> 3, voxel.y >> 3, voxel.z >> 3};
}

/// The index of a voxel in its block.
constexpr int IndexInBlock(const VoxelKey& voxel) {
  constexpr int kMask = kBlockSide - 1;
  return (voxel.x & kMask) + kBlockSide * ((voxel.y & kMask) + kBlockSide * (voxel.z & kMask));
}

/// The signed distances of 8^3 voxels; voxel (x, y, z) of the block lies at index x + 8 y + 64 z.
struct VoxelBlock {
  /// Mean distance in truncations, [-1, 1], positive in front of surfaces; NaN where never
  /// observed, so that whatever is interpolated from an unobserved voxel is NaN as well.
  std::array<float, kBlockVoxels> tsdf;
  std::array<uint16_t, kBlockVoxels> weight;  ///< observations in the mean
};

/// Which signs the voxels of a block have: bit x of row y + 8 z.
struct BlockSigns {
  using Rows = std::array<uint8_t, kBlockSide * kBlockSide>;
  Rows inside = {};   ///< observed and negative
  Rows outside = {};  ///< observed and not negative
};
BlockSigns FindSigns(const VoxelBlock& block);

/// Blocks at any place of an unbounded grid, found by key through an open-addressing hash table and
/// numbered in order of insertion. Voxel (x, y, z) of the block with key k is the sample of the
/// field at (8 k + (x, y, z)) * voxel_size.
class VoxelBlockGrid {
 public:
  static constexpr int kNone = -1;  ///< derived: no block's number
  /// Keys beyond +-kMaxKey along an axis cannot be stored. Derived: three of them are packed into
  /// 64 bits, 21 each.
  static constexpr int kMaxKey = (1 << 20) - 1;

  VoxelBlockGrid();

  int size() const { return static_cast<int>(keys_.size()); }
  /// Number of the block with this key, or kNone.
  int Find(const VoxelKey& key) const;
  /// Adds a block of unobserved voxels whose key must not be there yet; returns its number.
  int Insert(const VoxelKey& key);

  const VoxelKey& key(int block) const { return keys_[block]; }
  VoxelBlock& block(int block) { return *blocks_[block]; }
  const VoxelBlock& block(int block) const { return *blocks_[block]; }

  /// To be set by whoever changes a block's voxels; kept apart from them because every block's are
  /// asked for at each raycast.
  void SetSigns(int block, const BlockSigns& signs);
  const BlockSigns& signs(int block) const { return signs_[block]; }
  /// Whether any voxel is negative, and whether any is not.
  bool HasInside(int block) const { return has_signs_[block] & kHasInside; }
  bool HasOutside(int block) const { return has_signs_[block] & kHasOutside; }

  /// The blocks at key + (i & 1, i >> 1 & 1, i >> 2 & 1) for i = 0 .. 7, or kNone. Entry 0 is the
  /// block itself.
  const std::array<int, 8>& UpperNeighbours(int block) const { return neighbours_[block]; }

  size_t memory_bytes() const;
  /// Memory one more block takes, about.
  static size_t BytesPerBlock();

 private:
  static constexpr uint8_t kHasInside = 1, kHasOutside = 2;  // derived: a bit each

  struct Slot {
    uint64_t packed_key = 0;
    int block = kNone;
  };

  size_t SlotOf(uint64_t packed_key) const;
  void Rehash(size_t slot_count);
  void LinkNeighbours(int block);

  std::vector<VoxelKey> keys_;
  std::vector<std::unique_ptr<VoxelBlock>> blocks_;
  std::vector<BlockSigns> signs_;
  std::vector<uint8_t> has_signs_;  ///< of each block: kHasInside, kHasOutside
  std::vector<std::array<int, 8>> neighbours_;
  std::vector<Slot> slots_;  ///< a power of two, at most half full
  int slot_shift_ = 0;       ///< the hash's upper bits that index slots_
};

}  // namespace curvefusion
