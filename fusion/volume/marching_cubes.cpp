#include "fusion/volume/marching_cubes.h"

#include <bit>
#include <cstdint>
#include <vector>

#include "fusion/volume/surface_cells.h"
#include "kernel/marching_cubes_cases.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int CornerIndex(int corner) {
  return (corner & 1) + kCornerSide * ((corner >> 1 & 1) + kCornerSide * (corner >> 2 & 1));
}

// The cut edges that start at a block's own voxels, as a bit set: edge of voxel i along an axis is
// bit 3 i + axis. Their vertices are numbered in bit order from first_vertex.
struct CutEdges {
  std::array<uint64_t, 3 * kBlockVoxels / 64> bits{};
  int first_vertex = 0;

  void Set(int edge) { bits[edge / 64] |= uint64_t{1} << edge % 64; }
  int Count() const {
    int count = 0;
    for (const uint64_t word : bits) count += std::popcount(word);
    return count;
  }
  int VertexOf(int edge) const {
    int vertex = first_vertex;
    for (int word = 0; word < edge / 64; ++word) vertex += std::popcount(bits[word]);
    return vertex + std::popcount(bits[edge / 64] & ((uint64_t{1} << edge % 64) - 1));
  }
};

class MarchingCubesMesher {
 public:
  MarchingCubesMesher(const VoxelBlockGrid& grid, double voxel_size)
      : grid_(grid), voxel_size_(voxel_size), cut_edges_(grid.size()) {}

  TriangleMesh Mesh() {
    PlaceVertices();
    ConnectTriangles();
    DropUnusedVertices();
    return std::move(mesh_);
  }

 private:
  static constexpr int kBlocksPerChunk = 32;  // chosen for speed, changes no result

  // Calls body(x, y, z, index of the first corner) for the cells or voxels of a block.
  template <class Body>
  static void ForEachVoxel(const Body& body) {
    for (int z = 0; z < kBlockSide; ++z) {
      for (int y = 0; y < kBlockSide; ++y) {
        for (int x = 0; x < kBlockSide; ++x) {
          body(x, y, z, x + kCornerSide * (y + kCornerSide * z));
        }
      }
    }
  }

  // A vertex on every edge between observed voxels of different sign.
  void PlaceVertices() {
    ParallelFor(0, grid_.size(), kBlocksPerChunk, [&](int64_t block) {
      if (MayContainSurface(grid_, static_cast<int>(block))) FindCutEdges(static_cast<int>(block));
    });
    int vertices = 0;
    for (CutEdges& edges : cut_edges_) {
      edges.first_vertex = vertices;
      vertices += edges.Count();
    }
    mesh_.vertices.resize(vertices);
    ParallelFor(0, grid_.size(), kBlocksPerChunk,
                [&](int64_t block) { InterpolateVertices(static_cast<int>(block)); });
  }

  void FindCutEdges(int block) {
    CellCorners corners;
    GatherCellCorners(grid_, block, corners);
    ForEachVoxel([&](int x, int y, int z, int index) {
      const float value = corners[index];
      for (int axis = 0; axis < 3; ++axis) {
        const float next = corners[index + CornerIndex(1 << axis)];
        const bool is_cut = (value < 0 && next >= 0) || (value >= 0 && next < 0);
        if (is_cut) cut_edges_[block].Set(3 * (x + 8 * y + 64 * z) + axis);
      }
    });
  }

  void InterpolateVertices(int block) {
    const CutEdges& edges = cut_edges_[block];
    if (edges.Count() == 0) return;
    CellCorners corners;
    GatherCellCorners(grid_, block, corners);
    const VoxelKey& key = grid_.key(block);
    int vertex = edges.first_vertex;
    ForEachVoxel([&](int x, int y, int z, int index) {
      for (int axis = 0; axis < 3; ++axis) {
        const int edge = 3 * (x + 8 * y + 64 * z) + axis;
        if ((edges.bits[edge / 64] >> edge % 64 & 1) == 0) continue;
        const double from = corners[index], to = corners[index + CornerIndex(1 << axis)];
        Vec3 p(x + kBlockSide * key.x, y + kBlockSide * key.y, z + kBlockSide * key.z);
        p[axis] += from / (from - to);
        mesh_.vertices[vertex++] = (voxel_size_ * p).cast<float>();
      }
    });
  }

  void ConnectTriangles() {
    const int chunks = (grid_.size() + kBlocksPerChunk - 1) / kBlocksPerChunk;
    std::vector<std::vector<std::array<int, 3>>> of_chunk(chunks);
    ParallelChunks(0, grid_.size(), kBlocksPerChunk, [&](int64_t first, int64_t last) {
      for (int64_t block = first; block < last; ++block) {
        ConnectBlock(static_cast<int>(block), of_chunk[first / kBlocksPerChunk]);
      }
    });
    for (const auto& triangles : of_chunk) {
      mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
    }
  }

  void ConnectBlock(int block, std::vector<std::array<int, 3>>& triangles) const {
    if (!MayContainSurface(grid_, block)) return;
    CellMask cells;
    if (!FindSurfaceCells(grid_, block, cells)) return;
    CellCorners corners;
    GatherCellCorners(grid_, block, corners);
    ForEachVoxel([&](int x, int y, int z, int index) {
      if ((cells[y + kBlockSide * z] >> x & 1) == 0) return;
      int negative = 0;
      for (int corner = 0; corner < 8; ++corner) {
        negative |= (corners[index + CornerIndex(corner)] < 0) << corner;
      }
      const MarchingCubesCase& cell = kMarchingCubesCases[negative];
      for (int i = 0; i < cell.edge_count; i += 3) {
        triangles.push_back({VertexOf(block, x, y, z, cell.edges[i]),
                             VertexOf(block, x, y, z, cell.edges[i + 1]),
                             VertexOf(block, x, y, z, cell.edges[i + 2])});
      }
    });
  }

  // The vertex on an edge of cell (x, y, z), which may start in a neighbouring block.
  int VertexOf(int block, int x, int y, int z, int edge) const {
    const int axis = edge / 8;
    x += edge & 1, y += edge >> 1 & 1, z += edge >> 2 & 1;
    const int neighbour =
        grid_.UpperNeighbours(block)[x / kBlockSide + 2 * (y / kBlockSide) + 4 * (z / kBlockSide)];
    return cut_edges_[neighbour].VertexOf(3 * IndexInBlock({x, y, z}) + axis);
  }

  // An edge is cut without being part of the surface where none of its cells is observed.
  void DropUnusedVertices() {
    std::vector<int> kept(mesh_.vertices.size(), -1);
    for (const auto& triangle : mesh_.triangles) {
      for (const int vertex : triangle) kept[vertex] = 0;
    }
    int count = 0;
    for (size_t vertex = 0; vertex < kept.size(); ++vertex) {
      if (kept[vertex] < 0) continue;
      mesh_.vertices[count] = mesh_.vertices[vertex];
      kept[vertex] = count++;
    }
    mesh_.vertices.resize(count);
    for (auto& triangle : mesh_.triangles) {
      for (int& vertex : triangle) vertex = kept[vertex];
    }
  }

  const VoxelBlockGrid& grid_;
  double voxel_size_;
  std::vector<CutEdges> cut_edges_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh MarchingCubes(const VoxelBlockGrid& grid, double voxel_size) {
  return MarchingCubesMesher(grid, voxel_size).Mesh();
}

}  // namespace curvefusion
