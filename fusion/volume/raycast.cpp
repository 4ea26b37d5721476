#include "fusion/volume/raycast.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Chosen for speed; results do not depend on them.
constexpr int kBandRows = 16;  ///< image rows drawn by one thread at a time
constexpr int kBlocksPerChunk = 128;

// Pixel ranges, both ends inclusive.
struct PixelBox {
  int u_min, u_max, v_min, v_max;
};

// A block that may be seen, by its number in the list of surface blocks.
struct VisibleBlock {
  int surface_block;
  int order;  ///< of blocks on one ray the nearer has the smaller
  PixelBox pixels;
};

// The camera with lengths in voxels of the world.
struct VoxelCamera {
  const PinholeCamera& camera;
  RigidTransform T_camera_world;
  Vec3 center;  ///< in voxels
  double voxel_size;
  Vec3f first_ray;            ///< voxels per metre of depth along the ray of pixel (0, 0)
  Vec3f per_column, per_row;  ///< change of the ray from pixel to pixel

  VoxelCamera(const PinholeCamera& pinhole, const RigidTransform& T_world_camera, double size)
      : camera(pinhole),
        T_camera_world(T_world_camera.inverse()),
        center(T_world_camera.translation() / size),
        voxel_size(size) {
    const Mat3 axes = T_world_camera.linear() / size;
    first_ray = (axes * pinhole.Unproject(0, 0, 1)).cast<float>();
    per_column = (axes.col(0) / pinhole.fx).cast<float>();
    per_row = (axes.col(1) / pinhole.fy).cast<float>();
  }

  Vec3f Ray(int u, int v) const {
    return first_ray + static_cast<float>(u) * per_column + static_cast<float>(v) * per_row;
  }
};

// Pixels start to end, clipped to [0, size); empty (first > second) outside.
std::pair<int, int> ClippedPixels(double start, double end, int size) {
  constexpr double kRounding = 1e-3;  // pixels; chosen: far above what projection loses
  return {static_cast<int>(std::ceil(std::clamp(start - kRounding, 0.0, 1.0 * size))),
          static_cast<int>(std::floor(std::clamp(end + kRounding, -1.0, size - 1.0)))};
}

// The pixels whose rays may meet some cells of a block; empty if there are none.
std::optional<PixelBox> FindCoveredPixels(const VoxelCamera& view, const VoxelKey& key,
                                          const CellBox& box) {
  const PinholeCamera& camera = view.camera;
  const Vec3 cell_low(box.low[0], box.low[1], box.low[2]);
  const Vec3 cell_high(box.high[0], box.high[1], box.high[2]);
  const Vec3 first_voxel = kBlockSide * Vec3(key.x, key.y, key.z);
  const Vec3 center =
      view.T_camera_world * (view.voxel_size * (first_voxel + 0.5 * (cell_low + cell_high)));
  const Vec3 half =
      view.T_camera_world.linear().cwiseAbs() * (view.voxel_size * 0.5 * (cell_high - cell_low));
  const Vec3 low = center - half, high = center + half;
  if (high.z() <= 0) return std::nullopt;
  if (low.z() < PinholeCamera::kNearestBox) {
    return PixelBox{0, camera.width - 1, 0, camera.height - 1};
  }
  const Eigen::AlignedBox2d seen = camera.BoundsOfBox(low, high);
  const auto [u_min, u_max] = ClippedPixels(seen.min().x(), seen.max().x(), camera.width);
  const auto [v_min, v_max] = ClippedPixels(seen.min().y(), seen.max().y(), camera.height);
  if (u_min > u_max || v_min > v_max) return std::nullopt;
  return PixelBox{u_min, u_max, v_min, v_max};
}

// Along a ray the grid steps of block coordinates away from the camera's only add up, so their sum
// orders the blocks of every ray front to back.
int FrontToBackOrder(const VoxelKey& camera_block, const VoxelKey& key) {
  return std::abs(key.x - camera_block.x) + std::abs(key.y - camera_block.y) +
         std::abs(key.z - camera_block.z);
}

// The surface blocks in view, front to back.
std::vector<VisibleBlock> FindVisibleBlocks(const VoxelBlockGrid& grid,
                                            const std::vector<SurfaceBlock>& surface,
                                            const VoxelCamera& view) {
  const VoxelKey camera_block = VoxelOf(view.center, kBlockSide);
  const auto count = static_cast<int64_t>(surface.size());
  std::vector<std::vector<VisibleBlock>> of_chunk(count / kBlocksPerChunk + 1);
  ParallelFor(0, count, kBlocksPerChunk, [&](int64_t i) {
    const VoxelKey& key = grid.key(surface[i].block);
    const auto pixels = FindCoveredPixels(view, key, surface[i].box);
    if (!pixels) return;
    of_chunk[i / kBlocksPerChunk].push_back(
        {static_cast<int>(i), FrontToBackOrder(camera_block, key), *pixels});
  });
  std::vector<VisibleBlock> blocks;
  for (const auto& chunk : of_chunk) blocks.insert(blocks.end(), chunk.begin(), chunk.end());
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const VisibleBlock& a, const VisibleBlock& b) { return a.order < b.order; });
  return blocks;
}

// Value at p, in voxels from the block's first, inside a cell.
float Interpolate(const CellCorners& corners, const int cell[3], const Vec3f& p) {
  const float* c = corners.data() + cell[0] + kCornerSide * (cell[1] + kCornerSide * cell[2]);
  const float x = p.x() - static_cast<float>(cell[0]);
  const float y = p.y() - static_cast<float>(cell[1]);
  const float z = p.z() - static_cast<float>(cell[2]);
  constexpr int kY = kCornerSide, kZ = kCornerSide * kCornerSide;
  const float c00 = c[0] + x * (c[1] - c[0]);
  const float c10 = c[kY] + x * (c[kY + 1] - c[kY]);
  const float c01 = c[kZ] + x * (c[kZ + 1] - c[kZ]);
  const float c11 = c[kZ + kY] + x * (c[kZ + kY + 1] - c[kZ + kY]);
  const float c0 = c00 + y * (c10 - c00);
  return c0 + z * (c01 + y * (c11 - c01) - c0);
}

// A ray in the coordinates of a block: voxels from its first, parametrised by depth.
struct BlockRay {
  Vec3f origin;
  Vec3f direction;
  Vec3f At(float t) const { return origin + t * direction; }
};

struct RaySample {
  float t;
  float value;
};

// The crossing between a sample that is not negative and one that is not positive: the regula falsi
// with halved values of an end that stays (Illinois), because the interpolant along a ray is cubic.
float RefineCrossing(const CellCorners& corners, const BlockRay& ray, const int cell[3],
                     RaySample before, RaySample behind) {
  constexpr int kMaxIterations = 5;    // chosen: bounds the time of a pixel
  constexpr float kTolerance = 1e-4f;  // truncations; derived: below a thousandth of a voxel
  float t = before.t;
  for (int i = 0; i < kMaxIterations; ++i) {
    t = before.t +
        (behind.t - before.t) * before.value / std::max(before.value - behind.value, kTolerance);
    const float value = Interpolate(corners, cell, ray.At(t));
    if (std::abs(value) < kTolerance) break;
    if (value > 0) {
      before = {t, value};
      behind.value *= 0.5f;
    } else {
      behind = {t, value};
      before.value *= 0.5f;
    }
  }
  return t;
}

// Walks the cells of a block's box along a ray (Amanatides and Woo 1987) to the first crossing; 0 =
// none.
float CrossBlock(const CellCorners& corners, const SurfaceBlock& block, const BlockRay& ray) {
  float per_direction[3];
  float t_enter = 0, t_end = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    per_direction[axis] = 1 / ray.direction[axis];
    const float t0 =
        (static_cast<float>(block.box.low[axis]) - ray.origin[axis]) * per_direction[axis];
    const float t1 =
        (static_cast<float>(block.box.high[axis]) - ray.origin[axis]) * per_direction[axis];
    t_enter = std::max(t_enter, std::min(t0, t1));
    t_end = std::min(t_end, std::max(t0, t1));
  }
  if (!(t_enter < t_end)) return 0;
  const Vec3f start = ray.At(t_enter);
  int cell[3], step[3];
  float t_next[3];
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = std::clamp<int>(static_cast<int>(start[axis]), block.box.low[axis],
                                 block.box.high[axis] - 1);
    step[axis] = ray.direction[axis] > 0 ? 1 : -1;
    const float face = static_cast<float>(cell[axis] + (step[axis] > 0));
    t_next[axis] = (face - ray.origin[axis]) * per_direction[axis];
  }
  // A crossing on the very face between two cells of different blocks may round to just below zero
  // in both. Chosen: in truncations, far above what interpolation rounds.
  constexpr float kRounding = 1e-4f;
  bool is_known = false;  // the value at t_enter, of the cell before
  float value = 0;
  for (;;) {
    const int axis =
        t_next[0] < t_next[1] ? (t_next[0] < t_next[2] ? 0 : 2) : (t_next[1] < t_next[2] ? 1 : 2);
    const float t_exit = t_next[axis];
    const bool is_surface = block.cells[cell[1] + kBlockSide * cell[2]] >> cell[0] & 1;
    if (is_surface) {
      const float before = is_known ? value : Interpolate(corners, cell, ray.At(t_enter));
      value = Interpolate(corners, cell, ray.At(t_exit));
      if (before >= -kRounding && value <= 0 && before > value) {
        return RefineCrossing(corners, ray, cell, {t_enter, std::max(before, 0.0f)},
                              {t_exit, value});
      }
    }
    is_known = is_surface;
    cell[axis] += step[axis];
    if (cell[axis] < block.box.low[axis] || cell[axis] >= block.box.high[axis]) return 0;
    t_next[axis] += std::abs(per_direction[axis]);
    t_enter = t_exit;
  }
}

// Draws a block into those pixels that nothing nearer has covered.
void DrawBlock(const VoxelBlockGrid& grid, const VoxelCamera& view, const SurfaceBlock& block,
               const PixelBox& pixels, DepthImage& depth) {
  CellCorners corners;
  bool is_gathered = false;
  const VoxelKey& key = grid.key(block.block);
  BlockRay ray;
  ray.origin = (view.center - kBlockSide * Vec3(key.x, key.y, key.z)).cast<float>();
  for (int v = pixels.v_min; v <= pixels.v_max; ++v) {
    for (int u = pixels.u_min; u <= pixels.u_max; ++u) {
      if (depth(u, v) > 0) continue;
      if (!is_gathered) GatherCellCorners(grid, block.block, corners);
      is_gathered = true;
      ray.direction = view.Ray(u, v);
      for (int axis = 0; axis < 3; ++axis) {
        // Parallel to a face: nearly parallel does as well, and gives no 0 / 0.
        if (std::abs(ray.direction[axis]) < 1e-9f) ray.direction[axis] = 1e-9f;
      }
      depth(u, v) = CrossBlock(corners, block, ray);
    }
  }
}

}  // namespace

DepthImage RaycastBlocks(const VoxelBlockGrid& grid, const std::vector<SurfaceBlock>& surface,
                         double voxel_size, const PinholeCamera& camera,
                         const RigidTransform& T_world_camera) {
  const VoxelCamera view(camera, T_world_camera, voxel_size);
  const std::vector<VisibleBlock> blocks = FindVisibleBlocks(grid, surface, view);
  DepthImage depth(camera.width, camera.height, 0);
  ParallelChunks(0, camera.height, kBandRows, [&](int64_t first, int64_t last) {
    for (const VisibleBlock& block : blocks) {
      PixelBox pixels = block.pixels;
      pixels.v_min = std::max(pixels.v_min, static_cast<int>(first));
      pixels.v_max = std::min(pixels.v_max, static_cast<int>(last) - 1);
      if (pixels.v_min > pixels.v_max) continue;
      DrawBlock(grid, view, surface[block.surface_block], pixels, depth);
    }
  });
  return depth;
}

}  // namespace curvefusion
