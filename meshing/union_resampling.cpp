#include "meshing/union_resampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "kernel/marching_cubes_cases.h"

namespace curvefusion {

namespace {

using Index3 = std::array<int, 3>;

// In cells: the grid begins so far before the box of the solids, not at a multiple of a half, so
// that what is built on round numbers does not lie in its planes.
constexpr double kMargin = 1.377;
// In cells: how near a vertex may come to a point of the grid. Nearer ones would give slivers, and
// on the point itself several would coincide.
constexpr double kLeastPart = 0.05;
// In cells: shorter gaps along an axis are closed. Of those that are hardly wider than a cell the
// grid would make sieves.
constexpr double kMinGap = 1.5;
constexpr int kMaxIndex = (1 << 20) - 1;  // three of them and an axis fit into a key

uint64_t KeyOf(const Index3& p, int axis = 0) {
  uint64_t key = static_cast<uint64_t>(axis);
  for (const int i : p) key = (key << 20) | static_cast<uint64_t>(i);
  return key;
}

Index3 PointOf(uint64_t key) {
  const auto part = [key](int shift) { return static_cast<int>((key >> shift) & kMaxIndex); };
  return {part(40), part(20), part(0)};
}

Index3 CornerAt(const Index3& cell, int corner) {
  return {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2 & 1)};
}

class Marcher {
 public:
  Marcher(const std::vector<TriangleMesh>& solids, const CubicGrid& grid)
      : grid_(grid), dexels_(DexelsOf(solids, grid)) {}

  TriangleMesh Run() {
    FindVertices();
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    for (const uint64_t cell : cells_) March(PointOf(cell));
    return std::move(mesh_);
  }

 private:
  static std::array<Dexels, 3> DexelsOf(const std::vector<TriangleMesh>& solids,
                                        const CubicGrid& grid) {
    return {Dexels(solids, grid, 0, kMinGap), Dexels(solids, grid, 1, kMinGap),
            Dexels(solids, grid, 2, kMinGap)};
  }

  const Dexels::Span* SpanAt(int axis, const Index3& p) const {
    return dexels_[axis].SpanAt(p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]);
  }

  // Lines along one axis at least say so: they agree but for gaps that some of them close.
  bool IsInside(const Index3& p) const { return SpanAt(2, p) || SpanAt(1, p) || SpanAt(0, p); }

  void FindVertices() {
    for (const int axis : {2, 1, 0}) {
      for (const Dexels::Line& line : dexels_[axis].lines()) {
        for (const Dexels::Span& span : line.spans) AddVerticesAlong(axis, line, span);
      }
    }
  }

  void AddVerticesAlong(int axis, const Dexels::Line& line, const Dexels::Span& span) {
    for (int k = static_cast<int>(std::ceil(span.from)); k < span.to; ++k) {
      Index3 p;
      p[axis] = k;
      p[(axis + 1) % 3] = line.u;
      p[(axis + 2) % 3] = line.v;
      const bool is_done = (axis < 2 && SpanAt(2, p)) || (axis < 1 && SpanAt(1, p));
      if (!is_done) AddVerticesAround(p);
    }
  }

  void AddVerticesAround(const Index3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Index3 neighbour = p;
        neighbour[axis] += step;
        if (!IsInside(neighbour)) AddVertex(p, axis, step);
      }
    }
  }

  // The place where the edge from an inside point to its outside neighbour leaves the union.
  void AddVertex(const Index3& p, int axis, int step) {
    const Dexels::Span* span = SpanAt(axis, p);
    double part = 0.5;  // where lines along another axis have closed a gap
    if (span) part = step > 0 ? span->to - p[axis] : p[axis] - span->from;
    Vec3 place(p[0], p[1], p[2]);
    place[axis] += step * std::clamp(part, kLeastPart, 1 - kLeastPart);
    Index3 low = p;
    if (step < 0) --low[axis];
    vertex_at_[KeyOf(low, axis)] = static_cast<int>(mesh_.vertices.size());
    mesh_.vertices.push_back((grid_.origin + grid_.spacing * place).cast<float>());
    for (int around = 0; around < 4; ++around) {
      Index3 cell = low;
      cell[(axis + 1) % 3] -= around & 1;
      cell[(axis + 2) % 3] -= around >> 1;
      cells_.push_back(KeyOf(cell));
    }
  }

  void March(const Index3& cell) {
    int inside = 0;
    for (int corner = 0; corner < 8; ++corner) inside |= IsInside(CornerAt(cell, corner)) << corner;
    const MarchingCubesCase& crossed = kMarchingCubesCases[inside];
    for (int i = 0; i < crossed.edge_count; i += 3) {
      mesh_.triangles.push_back({VertexOn(cell, crossed.edges[i]),
                                 VertexOn(cell, crossed.edges[i + 1]),
                                 VertexOn(cell, crossed.edges[i + 2])});
    }
  }

  int VertexOn(const Index3& cell, int edge) const {
    return vertex_at_.at(KeyOf(CornerAt(cell, edge % 8), edge / 8));
  }

  CubicGrid grid_;
  std::array<Dexels, 3> dexels_;
  TriangleMesh mesh_;
  std::unordered_map<uint64_t, int> vertex_at_;  // by the edge of the grid
  std::vector<uint64_t> cells_;
};

}  // namespace

TriangleMesh ResampleUnion(const std::vector<TriangleMesh>& solids, double spacing) {
  Eigen::AlignedBox3d box;
  for (const TriangleMesh& solid : solids) {
    for (const Vec3f& v : solid.vertices) box.extend(v.cast<double>());
  }
  if (box.isEmpty()) return {};
  spacing = std::max(spacing, box.sizes().maxCoeff() / (kMaxIndex - 4));
  return Marcher(solids, {box.min() - Vec3::Constant(kMargin * spacing), spacing}).Run();
}

}  // namespace curvefusion
