#include "fusion/volume/surface_cells.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace curvefusion {

void GatherCellCorners(const VoxelBlockGrid& grid, int block, CellCorners& corners) {
  // Derived: a block of voxels never observed, as VoxelBlock has them.
  static constexpr auto kNothing = [] {
    std::array<float, kBlockVoxels> values{};
    values.fill(std::numeric_limits<float>::quiet_NaN());
    return values;
  }();
  std::array<const float*, 8> sources;
  for (int i = 0; i < 8; ++i) {
    const int neighbour = grid.UpperNeighbours(block)[i];
    sources[i] =
        (neighbour == VoxelBlockGrid::kNone ? kNothing : grid.block(neighbour).tsdf).data();
  }
  float* row = corners.data();
  for (int z = 0; z < kCornerSide; ++z) {
    for (int y = 0; y < kCornerSide; ++y, row += kCornerSide) {
      const int source = 2 * (y / kBlockSide) + 4 * (z / kBlockSide);
      const int offset = kBlockSide * (y % kBlockSide) + 64 * (z % kBlockSide);
      std::memcpy(row, sources[source] + offset, kBlockSide * sizeof(float));
      row[kBlockSide] = sources[source + 1][offset];
    }
  }
}

bool FindSurfaceCells(const VoxelBlockGrid& grid, int block, CellMask& cells) {
  static constexpr BlockSigns kNothing;  // derived: of a block never observed
  std::array<const BlockSigns*, 8> sources;
  for (int i = 0; i < 8; ++i) {
    const int neighbour = grid.UpperNeighbours(block)[i];
    sources[i] = neighbour == VoxelBlockGrid::kNone ? &kNothing : &grid.signs(neighbour);
  }
  // One bit per corner of a row: the eight cells of a row are then decided together.
  std::array<uint16_t, kCornerSide * kCornerSide> inside, outside;
  for (int z = 0; z < kCornerSide; ++z) {
    for (int y = 0; y < kCornerSide; ++y) {
      const int source = 2 * (y / kBlockSide) + 4 * (z / kBlockSide);
      const int row = y % kBlockSide + kBlockSide * (z % kBlockSide);
      const BlockSigns& near = *sources[source];
      const BlockSigns& far = *sources[source + 1];
      inside[y + kCornerSide * z] =
          static_cast<uint16_t>(near.inside[row] | (far.inside[row] & 1) << kBlockSide);
      outside[y + kCornerSide * z] =
          static_cast<uint16_t>(near.outside[row] | (far.outside[row] & 1) << kBlockSide);
    }
  }
  unsigned found = 0;
  for (int z = 0; z < kBlockSide; ++z) {
    for (int y = 0; y < kBlockSide; ++y) {
      unsigned any_inside = 0, any_outside = 0, observed = ~0u;
      for (const int row : {y + kCornerSide * z, y + 1 + kCornerSide * z, y + kCornerSide * (z + 1),
                            y + 1 + kCornerSide * (z + 1)}) {
        any_inside |= inside[row];
        any_outside |= outside[row];
        observed &= inside[row] | outside[row];
      }
      const unsigned cell = (any_inside | any_inside >> 1) & (any_outside | any_outside >> 1) &
                            observed & observed >> 1;
      cells[y + kBlockSide * z] = static_cast<uint8_t>(cell);
      found |= cell & 0xff;
    }
  }
  return found != 0;
}

bool MayContainSurface(const VoxelBlockGrid& grid, int block) {
  bool has_inside = false, has_outside = false;
  for (const int neighbour : grid.UpperNeighbours(block)) {
    if (neighbour == VoxelBlockGrid::kNone) continue;
    has_inside |= grid.HasInside(neighbour);
    has_outside |= grid.HasOutside(neighbour);
  }
  return has_inside && has_outside;
}

namespace {

// The smallest box around the set cells, of which there is at least one.
CellBox BoundingBox(const CellMask& cells) {
  CellBox box;
  box.low.fill(kBlockSide);
  box.high.fill(0);
  unsigned columns = 0;
  for (int row = 0; row < kBlockSide * kBlockSide; ++row) {
    if (cells[row] == 0) continue;
    columns |= cells[row];
    const auto y = static_cast<int8_t>(row % kBlockSide);
    const auto z = static_cast<int8_t>(row / kBlockSide);
    box.low[1] = std::min(box.low[1], y);
    box.low[2] = std::min(box.low[2], z);
    box.high[1] = std::max<int8_t>(box.high[1], y + 1);
    box.high[2] = std::max<int8_t>(box.high[2], z + 1);
  }
  box.low[0] = static_cast<int8_t>(std::countr_zero(columns));
  box.high[0] = static_cast<int8_t>(std::bit_width(columns));
  return box;
}

}  // namespace

std::vector<SurfaceBlock> FindSurfaceBlocks(const VoxelBlockGrid& grid) {
  std::vector<SurfaceBlock> blocks;
  SurfaceBlock found;
  for (found.block = 0; found.block < grid.size(); ++found.block) {
    if (!MayContainSurface(grid, found.block)) continue;
    if (!FindSurfaceCells(grid, found.block, found.cells)) continue;
    found.box = BoundingBox(found.cells);
    blocks.push_back(found);
  }
  return blocks;
}

}  // namespace curvefusion
