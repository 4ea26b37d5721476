#include "fusion/volume/space_behind.h"

#include <cassert>
#include <limits>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int64_t kRowsPerChunk = 16;  // chosen for speed, changes no result

// The field at a voxel; neighbouring pixels mostly fall into the same block, which is remembered.
class FieldLookup {
 public:
  explicit FieldLookup(const VoxelBlockGrid& grid) : grid_(grid) {}

  float At(const VoxelKey& voxel) {
    const VoxelKey key = BlockOf(voxel);
    if (!(key == key_) || !is_set_) {
      key_ = key;
      block_ = grid_.Find(key);
      is_set_ = true;
    }
    if (block_ == VoxelBlockGrid::kNone) return std::numeric_limits<float>::quiet_NaN();
    return grid_.block(block_).tsdf[IndexInBlock(voxel)];
  }

 private:
  const VoxelBlockGrid& grid_;
  VoxelKey key_;
  int block_ = VoxelBlockGrid::kNone;
  bool is_set_ = false;
};

}  // namespace

DepthImage SolidityBehind(const VoxelBlockGrid& grid, const TsdfScale& scale,
                          const DepthImage& rendering, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera, double distance) {
  assert(rendering.width() == camera.width && rendering.height() == camera.height);
  DepthImage solidity(camera.width, camera.height, std::numeric_limits<float>::quiet_NaN());
  const Vec3 half_voxel = Vec3::Constant(0.5 * scale.voxel_size);
  const auto per_truncation = static_cast<float>(-scale.truncation / distance);
  ParallelChunks(0, camera.height, kRowsPerChunk, [&](int64_t first, int64_t last) {
    FieldLookup field(grid);
    for (int v = static_cast<int>(first); v < last; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        if (!(rendering(u, v) > 0)) continue;
        const Vec3 p_world = T_world_camera * camera.Unproject(u, v, rendering(u, v) + distance);
        solidity(u, v) = per_truncation * field.At(VoxelOf(p_world + half_voxel, scale.voxel_size));
      }
    }
  });
  return solidity;
}

}  // namespace curvefusion
