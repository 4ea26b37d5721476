#include "fusion/volume/tsdf_integration.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>

#include "fusion/volume/voxel_lanes.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kBlocksPerChunk = 64;  // chosen for speed, changes no result

// The affine map from a block's voxels to what projection needs: u = x / z, v = y / z in pixels of
// the padded image plus one half, so that truncation rounds, and z the depth in metres.
struct ProjectiveVoxelMap {
  Mat3 voxel_to_image;  ///< columns: one voxel along x, y and z
  Vec3 origin;          ///< voxel (0, 0, 0) of the world

  ProjectiveVoxelMap(const IntegrationFrame& frame, double voxel_size) {
    const PinholeCamera& camera = frame.camera();
    Mat3 projection;
    projection << camera.fx, 0, camera.cx + 1.5, 0, camera.fy, camera.cy + 1.5, 0, 0, 1;
    voxel_to_image = projection * frame.T_camera_world().linear() * voxel_size;
    origin = projection * frame.T_camera_world().translation();
  }
};

// What of a block may be seen: tests the box that the block's voxels fill along the camera's axes.
class BlockVisibility {
 public:
  BlockVisibility(const IntegrationFrame& frame, const TsdfScale& scale)
      : frame_(frame),
        scale_(scale),
        half_extent_(frame.T_camera_world().linear().cwiseAbs() *
                     Vec3::Constant((kBlockSide - 1) / 2.0 * scale.voxel_size)) {}

  // Whether a voxel of the block may lie in front of a measurement or just behind it.
  bool MayBeObserved(const VoxelKey& key) const {
    const Vec3 voxel(key.x * kBlockSide, key.y * kBlockSide, key.z * kBlockSide);
    const Vec3 center = frame_.T_camera_world() *
                        (scale_.voxel_size * (voxel + Vec3::Constant((kBlockSide - 1) / 2.0)));
    const Vec3 low = center - half_extent_, high = center + half_extent_;
    if (high.z() <= 0) return false;
    return MaxDepthBehind(low, high) + scale_.truncation >= low.z();
  }

 private:
  // The greatest depth over the box's image, or minus infinity without a measurement there.
  double MaxDepthBehind(const Vec3& low, const Vec3& high) const {
    constexpr double kNothing = -std::numeric_limits<double>::infinity();
    const PinholeCamera& camera = frame_.camera();
    float depth;
    if (low.z() < PinholeCamera::kNearestBox) {
      depth = frame_.MaxDepthWithin(0, 0, camera.width, camera.height);
    } else {
      const Eigen::AlignedBox2d seen = camera.BoundsOfBox(low, high);
      depth = frame_.MaxDepthWithin(seen.min().x() - 0.5, seen.min().y() - 0.5,
                                    seen.max().x() + 0.5, seen.max().y() + 0.5);
    }
    return depth > 0 ? static_cast<double>(depth) : kNothing;
  }

  const IntegrationFrame& frame_;
  const TsdfScale& scale_;
  Vec3 half_extent_;
};

typedef int64_t Long2 __attribute__((vector_size(16)));
typedef uint16_t Count4 __attribute__((vector_size(8)));

class BlockUpdater {
 public:
  BlockUpdater(const IntegrationFrame& frame, const TsdfScale& scale, int max_weight)
      : map_(frame, scale.voxel_size),
        step_x_(map_.voxel_to_image.col(0).cast<float>()),
        step_y_(map_.voxel_to_image.col(1).cast<float>()),
        step_z_(map_.voxel_to_image.col(2).cast<float>()),
        depth_(frame.padded_depth()),
        u_max_(static_cast<float>(depth_.width() - 1)),
        v_max_(static_cast<float>(depth_.height() - 1)),
        per_truncation_(static_cast<float>(1 / scale.truncation)),
        max_weight_(static_cast<float>(max_weight)) {}

  void Update(const VoxelKey& key, VoxelBlock& block) const {
    const Vec3 first_voxel(key.x * kBlockSide, key.y * kBlockSide, key.z * kBlockSide);
    const Vec3f origin = (map_.origin + map_.voxel_to_image * first_voxel).cast<float>();
    for (int row = 0; row < kBlockSide * kBlockSide; ++row) {
      const Vec3f start = origin + static_cast<float>(row % kBlockSide) * step_y_ +
                          static_cast<float>(row / kBlockSide) * step_z_;
      for (int x = 0; x < kBlockSide; x += kVoxelLanes) {
        UpdateVoxels(start + static_cast<float>(x) * step_x_,
                     block.tsdf.data() + row * kBlockSide + x,
                     block.weight.data() + row * kBlockSide + x);
      }
    }
  }

 private:
  void UpdateVoxels(const Vec3f& start, float* tsdf, uint16_t* weight) const {
    constexpr Float4 kSteps = {0, 1, 2, 3};  // derived: the lanes' numbers
    const Float4 z = start.z() + kSteps * step_x_.z();
    const Float4 inverse_z = 1 / z;
    Float4 u = (start.x() + kSteps * step_x_.x()) * inverse_z;
    Float4 v = (start.y() + kSteps * step_x_.y()) * inverse_z;
    // Outside the image, NaN included, the padding answers that there is no measurement.
    u = u < u_max_ ? u : Float4{} + u_max_;
    v = v < v_max_ ? v : Float4{} + v_max_;
    u = u > 0 ? u : Float4{};
    v = v > 0 ? v : Float4{};
    const Int4 pixel =
        __builtin_convertvector(v, Int4) * depth_.width() + __builtin_convertvector(u, Int4);
    const float* pixels = depth_.data();
    const Float4 depth = {pixels[pixel[0]], pixels[pixel[1]], pixels[pixel[2]], pixels[pixel[3]]};
    const Float4 distance = (depth - z) * per_truncation_;
    const Int4 is_observed = (depth > 0) & (z > 0) & (distance >= -1);
    const Long2 any = reinterpret_cast<Long2>(is_observed);
    if ((any[0] | any[1]) != 0) AddDistances(distance, is_observed, tsdf, weight);
  }

  void AddDistances(const Float4& distance, const Int4& is_observed, float* tsdf,
                    uint16_t* weight) const {
    Float4 mean;
    Count4 count_16;
    std::memcpy(&mean, tsdf, sizeof(mean));
    std::memcpy(&count_16, weight, sizeof(count_16));
    const Float4 count = __builtin_convertvector(count_16, Float4);
    const Float4 observed = distance < 1 ? distance : Float4{} + 1;
    const Float4 old_mean = count > 0 ? mean : observed;  // NaN before the first observation
    const Float4 new_mean = old_mean + (observed - old_mean) / (count + 1);
    const Float4 new_count = count < max_weight_ ? count + 1 : count;
    mean = is_observed ? new_mean : mean;
    const Float4 kept_count = is_observed ? new_count : count;
    count_16 = __builtin_convertvector(__builtin_convertvector(kept_count, Int4), Count4);
    std::memcpy(tsdf, &mean, sizeof(mean));
    std::memcpy(weight, &count_16, sizeof(count_16));
  }

  ProjectiveVoxelMap map_;
  Vec3f step_x_, step_y_, step_z_;
  const DepthImage& depth_;
  float u_max_, v_max_;
  float per_truncation_;
  float max_weight_;
};

// Fetching the next block while one is updated saves a tenth of the time: a frame visits more
// blocks than the caches hold.
void Prefetch(const VoxelBlock& block) {
  constexpr size_t kCacheLine = 64;  // bytes; chosen: those of most processors
  const char* bytes = reinterpret_cast<const char*>(&block);
  for (size_t i = 0; i < sizeof(VoxelBlock); i += kCacheLine) __builtin_prefetch(bytes + i);
}

}  // namespace

void UpdateBlocks(const IntegrationFrame& frame, const TsdfScale& scale, int max_weight,
                  VoxelBlockGrid& grid) {
  const BlockVisibility visibility(frame, scale);
  const BlockUpdater updater(frame, scale, max_weight);
  ParallelChunks(0, grid.size(), kBlocksPerChunk, [&](int64_t first, int64_t last) {
    std::array<int, kBlocksPerChunk> blocks;
    int count = 0;
    for (int block = static_cast<int>(first); block < last; ++block) {
      if (visibility.MayBeObserved(grid.key(block))) blocks[count++] = block;
    }
    for (int i = 0; i < count; ++i) {
      if (i + 1 < count) Prefetch(grid.block(blocks[i + 1]));
      updater.Update(grid.key(blocks[i]), grid.block(blocks[i]));
      grid.SetSigns(blocks[i], FindSigns(grid.block(blocks[i])));
    }
  });
}

}  // namespace curvefusion
