#include "kernel/voxel_grid.h"

#include <bit>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr size_t kFirstSlotCount = 1024;
// Cells are shared out among so many tables, to be filled at the same time.
constexpr int kShares = 8;
constexpr int64_t kPointsPerChunk = 4096;

std::vector<uint8_t> SharesOfPoints(const ObservedPoints& points, double voxel_size) {
  std::vector<uint8_t> shares(points.size());
  ParallelFor(0, static_cast<int64_t>(points.size()), kPointsPerChunk, [&](int64_t i) {
    const size_t hash = VoxelKeyHash()(VoxelOf(points.positions[i], voxel_size));
    shares[i] = static_cast<uint8_t>(hash % kShares);
  });
  return shares;
}

// The occupied cells of one share.
struct GridShare {
  ObservedPoints points;
  std::vector<size_t> firsts;  // the first point of each cell
};

GridShare ResampleShare(const ObservedPoints& points, double voxel_size,
                        const std::vector<uint8_t>& share_of_point, uint8_t share) {
  VoxelNumbers voxels;
  GridShare resampled;
  ObservedPoints& sums = resampled.points;
  for (size_t i = 0; i < points.size(); ++i) {
    if (share_of_point[i] != share) continue;
    const float count = points.counts[i];
    const auto voxel = static_cast<size_t>(voxels.Number(VoxelOf(points.positions[i], voxel_size)));
    if (voxel == sums.size()) {
      sums.Add(Vec3::Zero(), Vec3::Zero(), 0);
      resampled.firsts.push_back(i);
    }
    sums.positions[voxel] += count * points.positions[i];
    sums.viewing_rays[voxel] += count * points.viewing_rays[i];
    sums.counts[voxel] += count;
  }
  for (size_t i = 0; i < sums.size(); ++i) {
    sums.positions[i] /= sums.counts[i];
    const double norm = sums.viewing_rays[i].norm();
    if (norm > 0) sums.viewing_rays[i] /= norm;
  }
  return resampled;
}

// The cells of all shares in the order of their first points.
ObservedPoints InOrder(const std::vector<GridShare>& shares,
                       const std::vector<uint8_t>& share_of_point) {
  size_t cells = 0;
  for (const GridShare& share : shares) cells += share.firsts.size();
  ObservedPoints ordered;
  ordered.Reserve(cells);
  std::vector<size_t> next(shares.size(), 0);
  for (size_t i = 0; i < share_of_point.size(); ++i) {
    const GridShare& share = shares[share_of_point[i]];
    size_t& cell = next[share_of_point[i]];
    if (cell == share.firsts.size() || share.firsts[cell] != i) continue;
    ordered.Add(share.points.positions[cell], share.points.viewing_rays[cell],
                share.points.counts[cell]);
    ++cell;
  }
  return ordered;
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

ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size) {
  const std::vector<uint8_t> share_of_point = SharesOfPoints(points, voxel_size);
  std::vector<GridShare> shares(kShares);
  ParallelFor(0, kShares, 1, [&](int64_t share) {
    shares[share] = ResampleShare(points, voxel_size, share_of_point, static_cast<uint8_t>(share));
  });
  return InOrder(shares, share_of_point);
}

}  // namespace curvefusion
