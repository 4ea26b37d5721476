#include "kernel/voxel_grid.h"

#include <unordered_map>

namespace curvefusion {

ObservedPoints ResampleOnGrid(const ObservedPoints& points, double voxel_size) {
  std::unordered_map<VoxelKey, size_t, VoxelKeyHash> slot_of_voxel;
  ObservedPoints resampled;
  for (size_t i = 0; i < points.size(); ++i) {
    const float count = points.counts[i];
    const auto [it, is_new] =
        slot_of_voxel.try_emplace(VoxelOf(points.positions[i], voxel_size), resampled.size());
    if (is_new) resampled.Add(Vec3::Zero(), Vec3::Zero(), 0);
    resampled.positions[it->second] += count * points.positions[i];
    resampled.viewing_rays[it->second] += count * points.viewing_rays[i];
    resampled.counts[it->second] += count;
  }
  for (size_t i = 0; i < resampled.size(); ++i) {
    resampled.positions[i] /= resampled.counts[i];
    const double norm = resampled.viewing_rays[i].norm();
    if (norm > 0) resampled.viewing_rays[i] /= norm;
  }
  return resampled;
}

}  // namespace curvefusion
