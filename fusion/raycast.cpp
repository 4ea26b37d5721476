#include "fusion/raycast.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kBandRows = 16;  ///< image rows drawn by one thread at a time
constexpr int kBlocksPerChunk = 128;

// A block with surface cells and the pixels it may cover.
struct SurfaceBlock {
  int block;
  int order;  ///< of blocks on one ray the nearer has the smaller
  int u_min, u_max, v_min, v_max;
  CellMask cells;
};

// The camera with lengths in voxels of the world.
struct VoxelCamera {
  const PinholeCamera& camera;
  RigidTransform T_camera_world;
  Vec3 center;  ///< in voxels
  Mat3 axes;    ///< voxels per metre of depth
  double voxel_size;

  VoxelCamera(const PinholeCamera& pinhole, const RigidTransform& T_world_camera, double size)
      : camera(pinhole),
        T_camera_world(T_world_camera.inverse()),
        center(T_world_camera.translation() / size),
        axes(T_world_camera.linear() / size),
        voxel_size(size) {}

  // Voxels travelled per metre of depth along the ray of a pixel.
  Vec3 Ray(int u, int v) const { return axes * camera.Unproject(u, v, 1.0); }
};

// Sets the pixels whose rays may meet the cells of a block; false if there are none.
bool FindCoveredPixels(const VoxelCamera& view, const VoxelKey& key, SurfaceBlock& found) {
  constexpr double kNearestProjectable = 1e-3;
  constexpr double kRounding = 1e-3;  // pixels; far above what projection loses
  const PinholeCamera& camera = view.camera;
  const Vec3 corner = view.voxel_size * kBlockSide * Vec3(key.x, key.y, key.z);
  const Vec3 center_camera =
      view.T_camera_world * (corner + Vec3::Constant(view.voxel_size * kBlockSide / 2.0));
  const Vec3 half =
      view.T_camera_world.linear().cwiseAbs() * Vec3::Constant(view.voxel_size * kBlockSide / 2.0);
  const Vec3 low = center_camera - half, high = center_camera + half;
  if (high.z() <= 0) return false;
  found.u_min = found.v_min = 0;
  found.u_max = camera.width - 1;
  found.v_max = camera.height - 1;
  if (low.z() < kNearestProjectable) return true;
  const auto clamp = [](double pixel, int end) {
    return static_cast<int>(std::clamp(pixel, -1.0, static_cast<double>(end)));
  };
  const double left = low.x() / (low.x() < 0 ? low.z() : high.z());
  const double right = high.x() / (high.x() > 0 ? low.z() : high.z());
  const double top = low.y() / (low.y() < 0 ? low.z() : high.z());
  const double bottom = high.y() / (high.y() > 0 ? low.z() : high.z());
  const int width = camera.width, height = camera.height;
  found.u_min = std::max(0, clamp(std::ceil(camera.fx * left + camera.cx - kRounding), width));
  found.v_min = std::max(0, clamp(std::ceil(camera.fy * top + camera.cy - kRounding), height));
  found.u_max =
      std::min(width - 1, clamp(std::floor(camera.fx * right + camera.cx + kRounding), width));
  found.v_max =
      std::min(height - 1, clamp(std::floor(camera.fy * bottom + camera.cy + kRounding), height));
  return found.u_min <= found.u_max && found.v_min <= found.v_max;
}

// Along a ray the grid steps of block coordinates away from the camera's only add up, so their sum
// orders the blocks of every ray front to back.
int FrontToBackOrder(const VoxelKey& camera_block, const VoxelKey& key) {
  return std::abs(key.x - camera_block.x) + std::abs(key.y - camera_block.y) +
         std::abs(key.z - camera_block.z);
}

// The blocks with surface cells in view, front to back.
std::vector<SurfaceBlock> FindSurfaceBlocks(const VoxelBlockGrid& grid, const VoxelCamera& view) {
  const VoxelKey camera_block = VoxelOf(view.center, kBlockSide);
  std::vector<std::vector<SurfaceBlock>> of_chunk(grid.size() / kBlocksPerChunk + 1);
  ParallelChunks(0, grid.size(), kBlocksPerChunk, [&](int64_t first, int64_t last) {
    CellCorners corners;
    SurfaceBlock found;
    for (int block = static_cast<int>(first); block < last; ++block) {
      if (!MayContainSurface(grid, block) || !FindCoveredPixels(view, grid.key(block), found)) {
        continue;
      }
      GatherCellCorners(grid, block, corners);
      if (!FindSurfaceCells(corners, found.cells)) continue;
      found.block = block;
      found.order = FrontToBackOrder(camera_block, grid.key(block));
      of_chunk[first / kBlocksPerChunk].push_back(found);
    }
  });
  std::vector<SurfaceBlock> blocks;
  for (const auto& chunk : of_chunk) blocks.insert(blocks.end(), chunk.begin(), chunk.end());
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const SurfaceBlock& a, const SurfaceBlock& b) { return a.order < b.order; });
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

// Depth of the crossing from positive to negative between t_enter and t_exit inside a cell; 0 =
// none.
float CrossCell(const CellCorners& corners, const BlockRay& ray, const int cell[3], float t_enter,
                float t_exit) {
  // A crossing on the very face between two cells may round to just below zero in both.
  constexpr float kRounding = 1e-4f;
  float before = Interpolate(corners, cell, ray.At(t_enter));
  float behind = Interpolate(corners, cell, ray.At(t_exit));
  if (before < -kRounding || behind > 0) return 0;
  before = std::max(before, 0.0f);
  // Regula falsi on the cubic along the ray; one correction leaves far less than depth noise.
  const float t = before > 0 ? t_enter + (t_exit - t_enter) * before / (before - behind) : t_enter;
  const float value = Interpolate(corners, cell, ray.At(t));
  if (value > 0 && value > behind) return t + (t_exit - t) * value / (value - behind);
  if (value < 0 && before > value) return t_enter + (t - t_enter) * before / (before - value);
  return t;
}

// Walks the cells of a block along a ray (Amanatides and Woo 1987) to the first crossing; 0 = none.
float CrossBlock(const CellCorners& corners, const CellMask& cells, const BlockRay& ray) {
  constexpr float kSide = kBlockSide;
  float per_direction[3], t_low[3], t_high[3];
  float t_enter = 0, t_end = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    per_direction[axis] = 1 / ray.direction[axis];
    const float t0 = -ray.origin[axis] * per_direction[axis];
    const float t1 = (kSide - ray.origin[axis]) * per_direction[axis];
    t_low[axis] = std::min(t0, t1);
    t_high[axis] = std::max(t0, t1);
    t_enter = std::max(t_enter, t_low[axis]);
    t_end = std::min(t_end, t_high[axis]);
  }
  if (!(t_enter < t_end)) return 0;
  const Vec3f start = ray.At(t_enter);
  int cell[3], step[3];
  float t_next[3], t_step[3];
  for (int axis = 0; axis < 3; ++axis) {
    cell[axis] = std::clamp(static_cast<int>(start[axis]), 0, kBlockSide - 1);
    step[axis] = ray.direction[axis] > 0 ? 1 : -1;
    t_step[axis] = std::abs(per_direction[axis]);
    const float face = static_cast<float>(cell[axis] + (step[axis] > 0));
    t_next[axis] = (face - ray.origin[axis]) * per_direction[axis];
  }
  for (;;) {
    const int axis =
        t_next[0] < t_next[1] ? (t_next[0] < t_next[2] ? 0 : 2) : (t_next[1] < t_next[2] ? 1 : 2);
    const float t_exit = t_next[axis];
    if (cells[cell[1] + kBlockSide * cell[2]] >> cell[0] & 1) {
      const float t = CrossCell(corners, ray, cell, t_enter, t_exit);
      if (t > 0) return t;
    }
    cell[axis] += step[axis];
    if (cell[axis] < 0 || cell[axis] >= kBlockSide) return 0;
    t_next[axis] += t_step[axis];
    t_enter = t_exit;
  }
}

// Draws the part of a block in rows [v_first, v_last] into pixels nothing nearer has covered.
void DrawBlock(const VoxelBlockGrid& grid, const VoxelCamera& view, const SurfaceBlock& block,
               int v_first, int v_last, DepthImage& depth) {
  CellCorners corners;
  bool is_gathered = false;
  const VoxelKey& key = grid.key(block.block);
  BlockRay ray;
  ray.origin = (view.center - kBlockSide * Vec3(key.x, key.y, key.z)).cast<float>();
  for (int v = std::max(v_first, block.v_min); v <= std::min(v_last, block.v_max); ++v) {
    for (int u = block.u_min; u <= block.u_max; ++u) {
      if (depth(u, v) > 0) continue;
      if (!is_gathered) GatherCellCorners(grid, block.block, corners);
      is_gathered = true;
      ray.direction = view.Ray(u, v).cast<float>();
      for (int axis = 0; axis < 3; ++axis) {
        // Parallel to a face: as good as parallel, and no 0 / 0.
        if (std::abs(ray.direction[axis]) < 1e-9f) ray.direction[axis] = 1e-9f;
      }
      depth(u, v) = CrossBlock(corners, block.cells, ray);
    }
  }
}

}  // namespace

DepthImage RaycastBlocks(const VoxelBlockGrid& grid, double voxel_size, const PinholeCamera& camera,
                         const RigidTransform& T_world_camera) {
  const VoxelCamera view(camera, T_world_camera, voxel_size);
  const std::vector<SurfaceBlock> blocks = FindSurfaceBlocks(grid, view);
  DepthImage depth(camera.width, camera.height, 0);
  ParallelChunks(0, camera.height, kBandRows, [&](int64_t first, int64_t last) {
    const int v_first = static_cast<int>(first), v_last = static_cast<int>(last) - 1;
    for (const SurfaceBlock& block : blocks) {
      if (block.v_min > v_last || block.v_max < v_first) continue;
      DrawBlock(grid, view, block, v_first, v_last, depth);
    }
  });
  return depth;
}

}  // namespace curvefusion
