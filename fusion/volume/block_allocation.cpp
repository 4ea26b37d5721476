#include "fusion/volume/block_allocation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kTileSide = 4;  ///< pixels; chosen: a tile's rays are treated as one tube
constexpr int kTilePixels = kTileSide * kTileSide;
/// Fewer measurements of similar depth in a tile are flying pixels or a wire, not the large
/// surfaces the volume is for; in a noisy scan their blocks would outnumber all others.
/// Chosen: a quarter of a tile.
constexpr int kMinTileMeasurements = 4;
constexpr int kTileRowsPerChunk = 4;  ///< chosen for speed, changes no result

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
      const bool is_surface = rest - first >= kMinTileMeasurements;
      for (; first != rest; ++first) farthest = std::max(farthest, *first);
      if (is_surface) AddTube(ray, std::max(0.0, nearest - truncation_), farthest + truncation_);
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

  static constexpr int kRecentCount = 512;  ///< chosen: 6 KiB; a power of two, for the mask

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

}  // namespace curvefusion
