#include "kernel/voxel_grid.h"

#include <bit>

#include "kernel/cell_order.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr size_t kFirstSlotCount = 1024;
constexpr int64_t kPointsPerChunk = 4096;
constexpr int64_t kCellsPerChunk = 1024;

// The buckets in the order of their first members.
std::vector<int> OrderByFirstMember(const Buckets& buckets) {
  constexpr int kNone = -1;
  std::vector<int> bucket_of_first(buckets.members.size(), kNone);
  for (int b = 0; b < buckets.size(); ++b) bucket_of_first[buckets[b].front()] = b;
  std::erase(bucket_of_first, kNone);
  return bucket_of_first;
}

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

Buckets GroupByCell(const std::vector<Vec3>& places, double voxel_size) {
  std::vector<VoxelKey> cells(places.size());
  ParallelFor(0, static_cast<int64_t>(places.size()), kPointsPerChunk,
              [&](int64_t i) { cells[i] = VoxelOf(places[i], voxel_size); });
  Buckets buckets;
  buckets.members = SortCells(cells);
  for (size_t k = 0; k < places.size(); ++k) {
    if (k == 0 || cells[k] != cells[k - 1]) buckets.first.push_back(static_cast<int>(k));
  }
  buckets.first.push_back(static_cast<int>(places.size()));
  return buckets;
}

ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size) {
  const Buckets cells = GroupByCell(points.positions, voxel_size);
  const std::vector<int> order = OrderByFirstMember(cells);
  ObservedPoints resampled;
  resampled.Resize(order.size());
  ParallelFor(0, static_cast<int64_t>(order.size()), kCellsPerChunk, [&](int64_t i) {
    Vec3 position = Vec3::Zero();
    Vec3 ray = Vec3::Zero();
    float sum = 0;
    for (const int point : cells[order[i]]) {
      const float count = points.counts[point];
      position += count * points.positions[point];
      ray += count * points.viewing_rays[point];
      sum += count;
    }
    resampled.positions[i] = position / sum;
    const double norm = ray.norm();
    resampled.viewing_rays[i] = norm > 0 ? Vec3(ray / norm) : ray;
    resampled.counts[i] = sum;
  });
  return resampled;
}

}  // namespace curvefusion
