#include "kernel/voxel_grid.h"

#include <bit>

namespace curvefusion {

namespace {

constexpr size_t kFirstSlotCount = 1024;

}  // namespace

VoxelNumbers::VoxelNumbers() { Rehash(kFirstSlotCount); }

size_t VoxelNumbers::SlotOf(const VoxelKey& key) const {
  const size_t mask = slots_.size() - 1;
  // Fibonacci hashing of the coordinates mixed by odd factors.
  const uint64_t mixed = static_cast<uint32_t>(key.x) * 0x9E3779B97F4A7C15ull +
                         static_cast<uint32_t>(key.y) * 0xC2B2AE3D27D4EB4Full +
                         static_cast<uint32_t>(key.z) * 0x165667B19E3779F9ull;
  size_t slot = (mixed ^ (mixed >> 29)) * 0x9E3779B97F4A7C15ull >> slot_shift_;
  while (slots_[slot] != kNone && !(keys_[slots_[slot]] == key)) slot = (slot + 1) & mask;
  return slot;
}

void VoxelNumbers::Rehash(size_t slot_count) {
  slots_.assign(slot_count, kNone);
  slot_shift_ = 64 - std::countr_zero(slot_count);
  for (int i = 0; i < size(); ++i) slots_[SlotOf(keys_[i])] = i;
}

int VoxelNumbers::Number(const VoxelKey& key) {
  const size_t slot = SlotOf(key);
  if (slots_[slot] != kNone) return slots_[slot];
  const int number = size();
  slots_[slot] = number;
  keys_.push_back(key);
  if (2 * keys_.size() > slots_.size()) Rehash(2 * slots_.size());
  return number;
}

ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size) {
  VoxelNumbers voxels;
  ObservedPoints resampled;
  for (size_t i = 0; i < points.size(); ++i) {
    const float count = points.counts[i];
    const auto voxel = static_cast<size_t>(voxels.Number(VoxelOf(points.positions[i], voxel_size)));
    if (voxel == resampled.size()) resampled.Add(Vec3::Zero(), Vec3::Zero(), 0);
    resampled.positions[voxel] += count * points.positions[i];
    resampled.viewing_rays[voxel] += count * points.viewing_rays[i];
    resampled.counts[voxel] += count;
  }
  for (size_t i = 0; i < resampled.size(); ++i) {
    resampled.positions[i] /= resampled.counts[i];
    const double norm = resampled.viewing_rays[i].norm();
    if (norm > 0) resampled.viewing_rays[i] /= norm;
  }
  return resampled;
}

}  // namespace curvefusion
