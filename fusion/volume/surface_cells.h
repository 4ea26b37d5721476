#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fusion/volume/voxel_blocks.h"

namespace curvefusion {

/// The field at the 9^3 corners of a block's 8^3 cells: the cell of voxel (x, y, z) spans from it
/// to (x+1, y+1, z+1), the last of them in the next block. Corner (x, y, z) at index x + 9 y + 81
/// z; NaN where unobserved.
inline constexpr int kCornerSide = kBlockSide + 1;
using CellCorners = std::array<float, kCornerSide * kCornerSide * kCornerSide>;
void GatherCellCorners(const VoxelBlockGrid& grid, int block, CellCorners& corners);

/// Bit x of row y + 8 z: the eight corners of cell (x, y, z) are observed and of both signs.
using CellMask = std::array<uint8_t, kBlockSide * kBlockSide>;
/// Returns whether any cell is set. Asks for signs only: some 0.1 microseconds.
bool FindSurfaceCells(const VoxelBlockGrid& grid, int block, CellMask& cells);

/// Whether the block's cells can contain a surface, judged without looking at their voxels: false
/// means certainly not.
bool MayContainSurface(const VoxelBlockGrid& grid, int block);

/// A range of cells of a block along every axis: low inclusive, high exclusive.
struct CellBox {
  std::array<int8_t, 3> low = {0, 0, 0};
  std::array<int8_t, 3> high = {kBlockSide, kBlockSide, kBlockSide};
};

/// A block with surface cells, and the smallest box around them.
struct SurfaceBlock {
  int block;
  CellBox box;
  CellMask cells;
};

/// All blocks with surface cells, by number. Runs on one thread: the volume calls it under a lock,
/// which a parallel loop could make it wait for itself. Cost: about a microsecond a block.
std::vector<SurfaceBlock> FindSurfaceBlocks(const VoxelBlockGrid& grid);

}  // namespace curvefusion
