#include "fusion/voxel_blocks.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace curvefusion {

namespace {

constexpr size_t kFirstSlotCount = 1024;
constexpr float kUnobserved = std::numeric_limits<float>::quiet_NaN();

uint64_t Pack(const VoxelKey& key) {
  constexpr int64_t kOffset = 1 << 20;
  return static_cast<uint64_t>(key.x + kOffset) << 42 |
         static_cast<uint64_t>(key.y + kOffset) << 21 | static_cast<uint64_t>(key.z + kOffset);
}

VoxelKey Shifted(const VoxelKey& key, int corner, int sign) {
  return {key.x + sign * (corner & 1), key.y + sign * (corner >> 1 & 1),
          key.z + sign * (corner >> 2 & 1)};
}

}  // namespace

VoxelBlockGrid::VoxelBlockGrid() { Rehash(kFirstSlotCount); }

size_t VoxelBlockGrid::SlotOf(uint64_t packed_key) const {
  const size_t mask = slots_.size() - 1;
  size_t slot = (packed_key * 0x9E3779B97F4A7C15ull) >> slot_shift_;  // Fibonacci hashing
  while (slots_[slot].block != kNone && slots_[slot].packed_key != packed_key) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

void VoxelBlockGrid::Rehash(size_t slot_count) {
  slots_.assign(slot_count, Slot());
  slot_shift_ = 64 - std::countr_zero(slot_count);
  for (int i = 0; i < size(); ++i) {
    const uint64_t packed_key = Pack(keys_[i]);
    slots_[SlotOf(packed_key)] = {packed_key, i};
  }
}

int VoxelBlockGrid::Find(const VoxelKey& key) const { return slots_[SlotOf(Pack(key))].block; }

int VoxelBlockGrid::Insert(const VoxelKey& key) {
  assert(Find(key) == kNone);
  assert(std::max({std::abs(key.x), std::abs(key.y), std::abs(key.z)}) <= kMaxKey);
  if (2 * (keys_.size() + 1) > slots_.size()) Rehash(2 * slots_.size());
  auto block = std::make_unique<VoxelBlock>();
  block->tsdf.fill(kUnobserved);
  const int number = size();
  const uint64_t packed_key = Pack(key);
  slots_[SlotOf(packed_key)] = {packed_key, number};
  keys_.push_back(key);
  blocks_.push_back(std::move(block));
  neighbours_.emplace_back();
  LinkNeighbours(number);
  return number;
}

void VoxelBlockGrid::LinkNeighbours(int block) {
  neighbours_[block][0] = block;
  for (int corner = 1; corner < 8; ++corner) {
    neighbours_[block][corner] = Find(Shifted(keys_[block], corner, 1));
    const int lower = Find(Shifted(keys_[block], corner, -1));
    if (lower != kNone) neighbours_[lower][corner] = block;
  }
}

size_t VoxelBlockGrid::BytesPerBlock() {
  // Two slots each, because the table is at most half full.
  return sizeof(VoxelBlock) + sizeof(VoxelKey) + sizeof(void*) + sizeof(std::array<int, 8>) +
         2 * sizeof(Slot);
}

size_t VoxelBlockGrid::memory_bytes() const {
  return keys_.capacity() * sizeof(VoxelKey) + blocks_.capacity() * sizeof(void*) +
         neighbours_.capacity() * sizeof(std::array<int, 8>) + slots_.capacity() * sizeof(Slot) +
         blocks_.size() * sizeof(VoxelBlock);
}

void GatherCellCorners(const VoxelBlockGrid& grid, int block, CellCorners& corners) {
  static constexpr auto kNothing = [] {
    std::array<float, kBlockVoxels> values{};
    values.fill(kUnobserved);
    return values;
  }();
  std::array<const float*, 8> sources;
  for (int i = 0; i < 8; ++i) {
    const int neighbour = grid.UpperNeighbours(block)[i];
    sources[i] =
        (neighbour == VoxelBlockGrid::kNone ? kNothing : grid.block(neighbour).tsdf).data();
  }
  float* row = corners.data();
  for (int z = 0; z < kCornerSide; ++z) {
    for (int y = 0; y < kCornerSide; ++y, row += kCornerSide) {
      const int source = 2 * (y / kBlockSide) + 4 * (z / kBlockSide);
      const int offset = kBlockSide * (y % kBlockSide) + 64 * (z % kBlockSide);
      std::copy_n(sources[source] + offset, kBlockSide, row);
      row[kBlockSide] = sources[source + 1][offset];
    }
  }
}

bool FindSurfaceCells(const CellCorners& corners, CellMask& cells) {
  // One bit per corner of a row: the eight cells of a row are then decided together.
  std::array<uint16_t, kCornerSide * kCornerSide> inside, outside;
  for (size_t row = 0; row < inside.size(); ++row) {
    const float* values = corners.data() + row * kCornerSide;
    unsigned negative = 0, positive = 0;
    for (int x = 0; x < kCornerSide; ++x) {
      negative |= static_cast<unsigned>(values[x] < 0) << x;
      positive |= static_cast<unsigned>(values[x] >= 0) << x;
    }
    inside[row] = static_cast<uint16_t>(negative);
    outside[row] = static_cast<uint16_t>(positive);
  }
  unsigned found = 0;
  for (int z = 0; z < kBlockSide; ++z) {
    for (int y = 0; y < kBlockSide; ++y) {
      unsigned any_inside = 0, any_outside = 0, observed = ~0u;
      for (const int row : {y + kCornerSide * z, y + 1 + kCornerSide * z, y + kCornerSide * (z + 1),
                            y + 1 + kCornerSide * (z + 1)}) {
        any_inside |= inside[row];
        any_outside |= outside[row];
        observed &= inside[row] | outside[row];
      }
      const unsigned cell = (any_inside | any_inside >> 1) & (any_outside | any_outside >> 1) &
                            observed & observed >> 1;
      cells[y + kBlockSide * z] = static_cast<uint8_t>(cell);
      found |= cell & 0xff;
    }
  }
  return found != 0;
}

bool MayContainSurface(const VoxelBlockGrid& grid, int block) {
  bool has_inside = false, has_outside = false;
  for (const int neighbour : grid.UpperNeighbours(block)) {
    if (neighbour == VoxelBlockGrid::kNone) continue;
    has_inside |= grid.block(neighbour).has_inside;
    has_outside |= grid.block(neighbour).has_outside;
  }
  return has_inside && has_outside;
}

}  // namespace curvefusion
