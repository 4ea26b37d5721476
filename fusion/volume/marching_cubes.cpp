#include "fusion/volume/marching_cubes.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "fusion/volume/surface_cells.h"
#include "kernel/parallel.h"

namespace curvefusion {

namespace {

// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 8 axis + c runs along an axis
// from corner c, whose bit of that axis is 0.
constexpr int kEdgeIds = 24;
constexpr int kMaxCaseEdges = 15;

constexpr int EdgeBetween(int corner_a, int corner_b) {
  const int axis = std::countr_zero(static_cast<unsigned>(corner_a ^ corner_b));
  return 8 * axis + (corner_a & corner_b);
}

// Whether one face of the cell holds both edges.
constexpr bool ShareFace(int edge_a, int edge_b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == edge_a / 8 || axis == edge_b / 8) continue;
    if ((edge_a >> axis & 1) == (edge_b >> axis & 1)) return true;
  }
  return false;
}

// Triangles of one sign pattern as triples of edges.
struct CellCase {
  int8_t edge_count = 0;
  std::array<int8_t, kMaxCaseEdges> edges{};

  constexpr void AddTriangle(int a, int b, int c) {
    for (const int edge : {a, b, c}) edges[edge_count++] = static_cast<int8_t>(edge);
  }
};

// The surface cuts each face of the cell in segments, directed so that seen from outside the cell
// they run from where a walk around the face enters a stretch of negative corners to where it
// leaves it. Every cut edge is so left on one of its faces and reached on the other: the segments
// form closed loops.
constexpr std::array<int, kEdgeIds> FaceSegments(int negative) {
  std::array<int, kEdgeIds> next{};
  next.fill(-1);
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2, b = (axis + 1) % 3, c = (axis + 2) % 3, side = face % 2;
    std::array<int, 4> ring = {0, 1 << b, 1 << b | 1 << c, 1 << c};  // counter-clockwise from +axis
    if (side == 0) std::swap(ring[1], ring[3]);
    for (int& corner : ring) corner |= side << axis;
    for (int i = 0; i < 4; ++i) {
      const int before = ring[(i + 3) % 4];
      if ((negative >> before & 1) != 0 || (negative >> ring[i] & 1) == 0) continue;
      int last = i;
      while (negative >> ring[(last + 1) % 4] & 1) ++last;
      next[EdgeBetween(before, ring[i])] = EdgeBetween(ring[last % 4], ring[(last + 1) % 4]);
    }
  }
  return next;
}

// Cuts ears off a loop. A diagonal within a face of the cell could coincide with one of the
// neighbouring cell and break the manifold; no loop forces one.
constexpr void Triangulate(std::array<int, 12> loop, int length, CellCase& triangles) {
  for (; length > 3; --length) {
    int ear = 0;
    while (ShareFace(loop[(ear + length - 1) % length], loop[(ear + 1) % length])) ++ear;
    triangles.AddTriangle(loop[(ear + length - 1) % length], loop[ear], loop[(ear + 1) % length]);
    for (int i = ear; i + 1 < length; ++i) loop[i] = loop[i + 1];
  }
  triangles.AddTriangle(loop[0], loop[1], loop[2]);
}

constexpr CellCase BuildCase(int negative) {
  CellCase triangles;
  std::array<int, kEdgeIds> next = FaceSegments(negative);
  for (int start = 0; start < kEdgeIds; ++start) {
    std::array<int, 12> loop{};
    int length = 0;
    for (int edge = start; next[edge] >= 0;) {
      loop[length++] = edge;
      const int following = next[edge];
      next[edge] = -1;
      edge = following;
    }
    if (length > 0) Triangulate(loop, length, triangles);
  }
  return triangles;
}

// Indexed by the bits of the negative corners.
constexpr std::array<CellCase, 256> kCellCases = [] {
  std::array<CellCase, 256> cases;
  for (int negative = 0; negative < 256; ++negative) cases[negative] = BuildCase(negative);
  return cases;
}();

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
  static constexpr int kBlocksPerChunk = 32;

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
    CellCorners corners;
    CellMask cells;
    GatherCellCorners(grid_, block, corners);
    if (!FindSurfaceCells(corners, cells)) return;
    ForEachVoxel([&](int x, int y, int z, int index) {
      if ((cells[y + kBlockSide * z] >> x & 1) == 0) return;
      int negative = 0;
      for (int corner = 0; corner < 8; ++corner) {
        negative |= (corners[index + CornerIndex(corner)] < 0) << corner;
      }
      const CellCase& cell = kCellCases[negative];
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
    const int voxel = x % kBlockSide + 8 * (y % kBlockSide) + 64 * (z % kBlockSide);
    return cut_edges_[neighbour].VertexOf(3 * voxel + axis);
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
