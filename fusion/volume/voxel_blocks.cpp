#include "fusion/volume/voxel_blocks.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace curvefusion {

namespace {

constexpr size_t kFirstSlotCount = 1024;  // chosen: a power of two, doubled when half full
constexpr float kUnobserved = std::numeric_limits<float>::quiet_NaN();

uint64_t Pack(const VoxelKey& key) {
  constexpr int64_t kOffset = VoxelBlockGrid::kMaxKey + 1;  // no key is negative then
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
  signs_.emplace_back();
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
  return sizeof(VoxelBlock) + sizeof(VoxelKey) + sizeof(void*) + sizeof(BlockSigns) +
         sizeof(std::array<int, 8>) + 2 * sizeof(Slot);
}

size_t VoxelBlockGrid::memory_bytes() const {
  return keys_.capacity() * sizeof(VoxelKey) + blocks_.capacity() * sizeof(void*) +
         signs_.capacity() * sizeof(BlockSigns) +
         neighbours_.capacity() * sizeof(std::array<int, 8>) + slots_.capacity() * sizeof(Slot) +
         blocks_.size() * sizeof(VoxelBlock);
}

BlockSigns FindSigns(const VoxelBlock& block) {
  int inside = 0, outside = 0;
  for (const float tsdf : block.tsdf) {
    inside |= tsdf < 0;
    outside |= tsdf >= 0;
  }
  return {inside != 0, outside != 0};
}

}  // namespace curvefusion
