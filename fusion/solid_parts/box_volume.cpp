#include "fusion/solid_parts/box_volume.h"

#include <limits>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/volume/integration_frame.h"
#include "fusion/volume/marching_cubes.h"
#include "fusion/volume/tsdf_integration.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

namespace {

constexpr int kStride = 2;  // as the best profile's volume

}  // namespace

BoxVolume::BoxVolume(const Eigen::AlignedBox3d& box, double voxel_size)
    : box_(box), scale_{voxel_size, TsdfOptions().truncation_voxels * voxel_size} {}

void BoxVolume::Integrate(const DepthImage& depth, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera) {
  const IntegrationFrame frame(depth, camera, T_world_camera, TsdfOptions().max_depth);
  const double side = kBlockSide * scale_.voxel_size;
  for (const VoxelKey& key : FindMissingBlocks(frame, scale_, grid_)) {
    const Vec3 low = side * Vec3(key.x, key.y, key.z);
    if (box_.intersects(Eigen::AlignedBox3d(low, low + Vec3::Constant(side)))) grid_.Insert(key);
  }
  UpdateBlocks(frame, scale_, TsdfOptions().max_weight, grid_);
}

TriangleMesh BoxVolume::ExtractMesh() const { return MarchingCubes(grid_, scale_.voxel_size); }

double BoxVolume::DistanceAt(const VoxelKey& voxel) const {
  const int block = grid_.Find({voxel.x >> 3, voxel.y >> 3, voxel.z >> 3});
  if (block == VoxelBlockGrid::kNone) return std::numeric_limits<double>::quiet_NaN();
  const int index = (voxel.x & 7) + 8 * (voxel.y & 7) + 64 * (voxel.z & 7);
  return scale_.truncation * static_cast<double>(grid_.block(block).tsdf[index]);
}

BoxVolume FuseBox(const Sequence& sequence, const Eigen::AlignedBox3d& box, double voxel_size,
                  const Progress& progress) {
  BoxVolume volume(box, voxel_size);
  std::vector<int> frames;
  for (int i = 0; i < sequence.frame_count(); i += kStride) frames.push_back(i);
  int64_t done = 0;
  ForEachFrame(sequence, frames, {.depth = true, .color = false}, [&](const DecodedFrame& frame) {
    volume.Integrate(frame.depth, sequence.depth_camera,
                     sequence.frames[frame.index].T_world_camera);
    progress("solid parts", ++done, static_cast<int64_t>(frames.size()));
  });
  return volume;
}

}  // namespace curvefusion
