#include "kernel/voxel_grid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

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

Buckets GroupCells(std::vector<VoxelKey> cells) {
  Buckets buckets;
  buckets.members = SortCells(cells);
  for (size_t k = 0; k < cells.size(); ++k) {
    if (k == 0 || cells[k] != cells[k - 1]) buckets.first.push_back(static_cast<int>(k));
  }
  buckets.first.push_back(static_cast<int>(cells.size()));
  return buckets;
}

// The means of points of one cell.
class CellMean {
 public:
  void Add(const Vec3& position, const Vec3& ray, float count) {
    position_ += count * position;
    ray_ += count * ray;
    count_ += count;
  }

  void Write(int64_t i, ObservedPoints& points) const {
    points.positions[i] = position_ / count_;
    const double norm = ray_.norm();
    points.viewing_rays[i] = norm > 0 ? Vec3(ray_ / norm) : ray_;
    points.counts[i] = count_;
  }

 private:
  Vec3 position_ = Vec3::Zero();
  Vec3 ray_ = Vec3::Zero();
  float count_ = 0;
};

// One point for each cell, in the order of their first members; `add` adds a member to a CellMean.
template <class AddMember>
ObservedPoints MeansOfCells(const Buckets& cells, const AddMember& add) {
  const std::vector<int> order = OrderByFirstMember(cells);
  ObservedPoints means;
  means.Resize(order.size());
  ParallelFor(0, static_cast<int64_t>(order.size()), kCellsPerChunk, [&](int64_t i) {
    CellMean mean;
    for (const int member : cells[order[i]]) add(member, mean);
    mean.Write(i, means);
  });
  return means;
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
  return GroupCells(std::move(cells));
}

ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size) {
  return MeansOfCells(GroupByCell(points.positions, voxel_size), [&](int member, CellMean& mean) {
    mean.Add(points.positions[member], points.viewing_rays[member], points.counts[member]);
  });
}

ObservedPoints ResampleOnGrid(const std::vector<ObservedPoints>& clouds,
                              const std::vector<RigidTransform>& motions, double voxel_size) {
  assert(clouds.size() == motions.size());
  std::vector<size_t> first = {0};
  for (const ObservedPoints& cloud : clouds) first.push_back(first.back() + cloud.size());
  std::vector<VoxelKey> cells(first.back());
  ParallelFor(0, static_cast<int64_t>(clouds.size()), 1, [&](int64_t c) {
    for (size_t i = 0; i < clouds[c].size(); ++i)
      cells[first[c] + i] = VoxelOf(motions[c] * clouds[c].positions[i], voxel_size);
  });
  return MeansOfCells(GroupCells(std::move(cells)), [&](int member, CellMean& mean) {
    const auto next = std::ranges::upper_bound(first, static_cast<size_t>(member));
    const size_t c = static_cast<size_t>(next - first.begin()) - 1;
    const size_t i = static_cast<size_t>(member) - first[c];
    mean.Add(motions[c] * clouds[c].positions[i],
             (motions[c].linear() * clouds[c].viewing_rays[i]).normalized(), clouds[c].counts[i]);
  });
}

}  // namespace curvefusion
