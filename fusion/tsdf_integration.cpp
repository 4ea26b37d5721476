#include "fusion/tsdf_integration.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kTileSide = 4;  ///< pixels; a tile's rays are treated as one tube
constexpr int kTilePixels = kTileSide * kTileSide;
constexpr int kTileRowsPerChunk = 4;
constexpr int kBlocksPerChunk = 64;

DepthImage PadValidDepth(const DepthImage& depth, double max_depth) {
  DepthImage padded(depth.width() + 2, depth.height() + 2, 0);
  const float limit = static_cast<float>(max_depth);
  for (int v = 0; v < depth.height(); ++v) {
    const float* from = depth.row(v);
    float* to = padded.row(v + 1) + 1;
    // NaN compares false and so becomes 0, too.
    for (int u = 0; u < depth.width(); ++u) to[u] = from[u] > 0 && from[u] <= limit ? from[u] : 0;
  }
  return padded;
}

DepthImage TileMaxima(const DepthImage& padded) {
  const int width = padded.width() - 2, height = padded.height() - 2;
  DepthImage maxima((width + kTileSide - 1) / kTileSide, (height + kTileSide - 1) / kTileSide, 0);
  for (int v = 0; v < height; ++v) {
    const float* row = padded.row(v + 1) + 1;
    float* tiles = maxima.row(v / kTileSide);
    for (int u = 0; u < width; ++u) {
      tiles[u / kTileSide] = std::max(tiles[u / kTileSide], row[u]);
    }
  }
  return maxima;
}

DepthImage HalvedByMaximum(const DepthImage& fine) {
  DepthImage coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2, 0);
  for (int v = 0; v < fine.height(); ++v) {
    for (int u = 0; u < fine.width(); ++u) {
      coarse(u / 2, v / 2) = std::max(coarse(u / 2, v / 2), fine(u, v));
    }
  }
  return coarse;
}

}  // namespace

IntegrationFrame::IntegrationFrame(const DepthImage& depth, const PinholeCamera& camera,
                                   const RigidTransform& T_world_camera, double max_depth)
    : camera_(camera),
      T_world_camera_(T_world_camera),
      T_camera_world_(T_world_camera.inverse()),
      padded_(PadValidDepth(depth, max_depth)) {
  max_pyramid_.push_back(TileMaxima(padded_));
  while (max_pyramid_.back().size() > 1) {
    max_pyramid_.push_back(HalvedByMaximum(max_pyramid_.back()));
  }
}

float IntegrationFrame::MaxDepthWithin(double u_min, double v_min, double u_max,
                                       double v_max) const {
  if (u_max < -0.5 || v_max < -0.5 || u_min > camera_.width - 0.5 || v_min > camera_.height - 0.5) {
    return 0;
  }
  int u0 = static_cast<int>(std::clamp(u_min, 0.0, camera_.width - 1.0)) / kTileSide;
  int u1 = static_cast<int>(std::clamp(u_max + 0.5, 0.0, camera_.width - 1.0)) / kTileSide;
  int v0 = static_cast<int>(std::clamp(v_min, 0.0, camera_.height - 1.0)) / kTileSide;
  int v1 = static_cast<int>(std::clamp(v_max + 0.5, 0.0, camera_.height - 1.0)) / kTileSide;
  size_t level = 0;
  for (; level + 1 < max_pyramid_.size() && std::max(u1 - u0, v1 - v0) > 3; ++level) {
    u0 /= 2, u1 /= 2, v0 /= 2, v1 /= 2;
  }
  float maximum = 0;
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) maximum = std::max(maximum, max_pyramid_[level](u, v));
  }
  return maximum;
}

namespace {

// Finds the missing blocks along the tubes of some tiles, each reported about once.
class MissingBlockCollector {
 public:
  MissingBlockCollector(const IntegrationFrame& frame, const TsdfScale& scale,
                        const VoxelBlockGrid& grid, std::vector<VoxelKey>& missing)
      : frame_(frame),
        grid_(grid),
        truncation_(scale.truncation),
        origin_(frame.T_world_camera().translation() / scale.voxel_size),
        axes_(frame.T_world_camera().linear() / scale.voxel_size),
        missing_(missing) {
    const PinholeCamera& camera = frame.camera();
    spread_ = kTileSide / 2.0 *
              (axes_.col(0).cwiseAbs() / camera.fx + axes_.col(1).cwiseAbs() / camera.fy);
    recent_.fill({std::numeric_limits<int>::min(), 0, 0});
  }

  void AddTile(int tile_u, int tile_v) {
    std::array<float, kTilePixels> depths;
    int count = 0;
    const DepthImage& padded = frame_.padded_depth();
    const int u_end = std::min((tile_u + 1) * kTileSide, frame_.camera().width);
    const int v_end = std::min((tile_v + 1) * kTileSide, frame_.camera().height);
    for (int v = tile_v * kTileSide; v < v_end; ++v) {
      for (int u = tile_u * kTileSide; u < u_end; ++u) {
        if (padded(u + 1, v + 1) > 0) depths[count++] = padded(u + 1, v + 1);
      }
    }
    const Vec3 ray = axes_ * frame_.camera().Unproject((tile_u + 0.5) * kTileSide - 0.5,
                                                       (tile_v + 0.5) * kTileSide - 0.5, 1.0);
    AddDepths(ray, depths.data(), depths.data() + count);
  }

 private:
  // Depths within one truncation share a tube; across a discontinuity nothing is to be allocated.
  void AddDepths(const Vec3& ray, float* first, float* last) {
    while (first != last) {
      const float nearest = *std::min_element(first, last);
      float farthest = nearest;
      float* rest = std::partition(first, last, [&](float depth) {
        return depth <= nearest + static_cast<float>(truncation_);
      });
      for (; first != rest; ++first) farthest = std::max(farthest, *first);
      AddTube(ray, std::max(0.0, nearest - truncation_), farthest + truncation_);
    }
  }

  // The box of a short piece of the tube is little larger than the piece.
  void AddTube(const Vec3& ray, double z_near, double z_far) {
    constexpr double kPieceLength = kBlockSide / 4.0;
    const int pieces =
        std::max(1, static_cast<int>(std::ceil((z_far - z_near) * ray.norm() / kPieceLength)));
    const Vec3 margin = spread_ * z_far;
    Vec3 start = origin_ + z_near * ray;
    const Vec3 step = (z_far - z_near) / pieces * ray;
    for (int i = 0; i < pieces; ++i) {
      const Vec3 end = start + step;
      AddBox(start.cwiseMin(end) - margin, start.cwiseMax(end) + margin);
      start = end;
    }
  }

  // The blocks with a voxel inside a box given in voxels.
  void AddBox(const Vec3& low, const Vec3& high) {
    // A voxel at or above `low` is at least its ceiling; .999 instead of 1 keeps low itself.
    const auto first = [](double x) {
      return static_cast<int>(std::floor((x + 0.999) / kBlockSide));
    };
    const auto last = [](double x) { return static_cast<int>(std::floor(x / kBlockSide)); };
    const int x_end = last(high.x()), y_end = last(high.y()), z_end = last(high.z());
    for (int x = first(low.x()); x <= x_end; ++x) {
      for (int y = first(low.y()); y <= y_end; ++y) {
        for (int z = first(low.z()); z <= z_end; ++z) AddBlock({x, y, z});
      }
    }
  }

  void AddBlock(const VoxelKey& key) {
    VoxelKey& recent = recent_[(key.x * 73 + key.y * 19 + key.z) & (kRecentCount - 1)];
    if (recent == key) return;
    recent = key;
    if (grid_.Find(key) == VoxelBlockGrid::kNone) missing_.push_back(key);
  }

  static constexpr int kRecentCount = 512;

  const IntegrationFrame& frame_;
  const VoxelBlockGrid& grid_;
  double truncation_;
  Vec3 origin_;  ///< camera centre, in voxels
  Mat3 axes_;    ///< camera axes in the world, voxels per metre
  Vec3 spread_;  ///< half the box around a tile's footprint, voxels per metre of depth
  std::array<VoxelKey, kRecentCount> recent_;
  std::vector<VoxelKey>& missing_;
};

}  // namespace

std::vector<VoxelKey> FindMissingBlocks(const IntegrationFrame& frame, const TsdfScale& scale,
                                        const VoxelBlockGrid& grid) {
  const int tile_columns = (frame.camera().width + kTileSide - 1) / kTileSide;
  const int tile_rows = (frame.camera().height + kTileSide - 1) / kTileSide;
  std::vector<std::vector<VoxelKey>> of_chunk(tile_rows / kTileRowsPerChunk + 1);
  ParallelChunks(0, tile_rows, kTileRowsPerChunk, [&](int64_t first, int64_t last) {
    MissingBlockCollector collector(frame, scale, grid, of_chunk[first / kTileRowsPerChunk]);
    for (int64_t row = first; row < last; ++row) {
      for (int column = 0; column < tile_columns; ++column) {
        collector.AddTile(column, static_cast<int>(row));
      }
    }
  });
  std::vector<VoxelKey> missing;
  for (const auto& keys : of_chunk) missing.insert(missing.end(), keys.begin(), keys.end());
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  return missing;
}

namespace {

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
    if (low.z() < kNearestProjectable) {
      depth = frame_.MaxDepthWithin(0, 0, camera.width, camera.height);
    } else {
      // The least x is seen farthest left from near when negative, from afar when positive.
      const double left = low.x() / (low.x() < 0 ? low.z() : high.z());
      const double right = high.x() / (high.x() > 0 ? low.z() : high.z());
      const double top = low.y() / (low.y() < 0 ? low.z() : high.z());
      const double bottom = high.y() / (high.y() > 0 ? low.z() : high.z());
      depth = frame_.MaxDepthWithin(
          camera.fx * left + camera.cx - 0.5, camera.fy * top + camera.cy - 0.5,
          camera.fx * right + camera.cx + 0.5, camera.fy * bottom + camera.cy + 0.5);
    }
    return depth > 0 ? static_cast<double>(depth) : kNothing;
  }

  static constexpr double kNearestProjectable = 1e-3;

  const IntegrationFrame& frame_;
  const TsdfScale& scale_;
  Vec3 half_extent_;
};

// Integrates into one row of voxels at a time. All loops over a row have a fixed length and no
// branch, so that the compiler vectorises them.
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
      UpdateRow(start, block.tsdf.data() + row * kBlockSide,
                block.weight.data() + row * kBlockSide);
    }
    SummariseSigns(block);
  }

 private:
  void UpdateRow(const Vec3f& start, float* tsdf, uint16_t* weight) const {
    float distance[kBlockSide];
    MeasureRow(start, distance);
    for (int i = 0; i < kBlockSide; ++i) {
      const float old_weight = weight[i];
      const float observed = std::min(distance[i], 1.0f);
      const float mean = old_weight > 0 ? tsdf[i] : observed;
      const float new_mean = mean + (observed - mean) / (old_weight + 1);
      const float new_weight = std::min(old_weight + 1, max_weight_);
      const bool is_observed = distance[i] >= -1;
      tsdf[i] = is_observed ? new_mean : tsdf[i];
      weight[i] = static_cast<uint16_t>(static_cast<int>(is_observed ? new_weight : old_weight));
    }
  }

  // Distance of each voxel of a row before its measurement, in truncations; -2 without one.
  void MeasureRow(const Vec3f& start, float* distance) const {
    float z[kBlockSide], depth[kBlockSide];
    int u[kBlockSide], v[kBlockSide];
    for (int i = 0; i < kBlockSide; ++i) {
      const float step = static_cast<float>(i);
      z[i] = start.z() + step * step_x_.z();
      const float inverse_z = 1 / z[i];
      const float u_image = (start.x() + step * step_x_.x()) * inverse_z;
      const float v_image = (start.y() + step * step_x_.y()) * inverse_z;
      // The padding has no measurement; this order of arguments sends NaN there, too.
      u[i] = static_cast<int>(std::max(0.0f, std::min(u_image, u_max_)));
      v[i] = static_cast<int>(std::max(0.0f, std::min(v_image, v_max_)));
    }
    const float* pixels = depth_.data();
    const int stride = depth_.width();
    for (int i = 0; i < kBlockSide; ++i) depth[i] = pixels[v[i] * stride + u[i]];
    for (int i = 0; i < kBlockSide; ++i) {
      const bool is_measured = (depth[i] > 0) & (z[i] > 0);
      distance[i] = is_measured ? (depth[i] - z[i]) * per_truncation_ : -2.0f;
    }
  }

  static void SummariseSigns(VoxelBlock& block) {
    int inside = 0, outside = 0;
    for (int i = 0; i < kBlockVoxels; ++i) {
      inside |= block.tsdf[i] < 0;
      outside |= block.tsdf[i] >= 0;
    }
    block.has_inside = inside != 0;
    block.has_outside = outside != 0;
  }

  ProjectiveVoxelMap map_;
  Vec3f step_x_, step_y_, step_z_;
  const DepthImage& depth_;
  float u_max_, v_max_;
  float per_truncation_;
  float max_weight_;
};

}  // namespace

void UpdateBlocks(const IntegrationFrame& frame, const TsdfScale& scale, int max_weight,
                  VoxelBlockGrid& grid) {
  const BlockVisibility visibility(frame, scale);
  const BlockUpdater updater(frame, scale, max_weight);
  ParallelFor(0, grid.size(), kBlocksPerChunk, [&](int64_t i) {
    const int block = static_cast<int>(i);
    if (visibility.MayBeObserved(grid.key(block))) {
      updater.Update(grid.key(block), grid.block(block));
    }
  });
}

}  // namespace curvefusion
