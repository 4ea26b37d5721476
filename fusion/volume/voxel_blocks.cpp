#include "fusion/volume/voxel_blocks.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "fusion/volume/voxel_lanes.h"

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

// One bit for each of eight lanes that are set.
uint8_t BitsOf(const Int4& low, const Int4& high) {
  constexpr Int4 kLow = {1, 2, 4, 8}, kHigh = {16, 32, 64, 128};  // derived: a lane's bit
  Int4 bits = (low & kLow) | (high & kHigh);
  bits |= __builtin_shuffle(bits, Int4{2, 3, 0, 1});
  return static_cast<uint8_t>(bits[0] | bits[1]);
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
  has_signs_.push_back(0);
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
         sizeof(uint8_t) + sizeof(std::array<int, 8>) + 2 * sizeof(Slot);
}

size_t VoxelBlockGrid::memory_bytes() const {
  return keys_.capacity() * sizeof(VoxelKey) + blocks_.capacity() * sizeof(void*) +
         signs_.capacity() * sizeof(BlockSigns) + has_signs_.capacity() +
         neighbours_.capacity() * sizeof(std::array<int, 8>) + slots_.capacity() * sizeof(Slot) +
         blocks_.size() * sizeof(VoxelBlock);
}

void VoxelBlockGrid::SetSigns(int block, const BlockSigns& signs) {
  signs_[block] = signs;
  constexpr BlockSigns::Rows kEmpty = {};  // derived: no voxel of a sign
  has_signs_[block] = static_cast<uint8_t>((signs.inside == kEmpty ? 0 : kHasInside) |
                                           (signs.outside == kEmpty ? 0 : kHasOutside));
}

BlockSigns FindSigns(const VoxelBlock& block) {
  BlockSigns signs;
  for (int row = 0; row < kBlockSide * kBlockSide; ++row) {
    Float4 low, high;
    std::memcpy(&low, block.tsdf.data() + row * kBlockSide, sizeof(low));
    std::memcpy(&high, block.tsdf.data() + row * kBlockSide + kVoxelLanes, sizeof(high));
    signs.inside[row] = BitsOf(low < 0, high < 0);
    signs.outside[row] = BitsOf(low >= 0, high >= 0);
  }
  return signs;
}

}  // namespace curvefusion
