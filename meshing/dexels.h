#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/triangle_mesh.h"

namespace curvefusion {

/// The points origin + spacing * (i, j, k).
struct CubicGrid {
  Vec3 origin = Vec3::Zero();
  double spacing = 1;
};

/// Where the lines of a grid along one axis are inside of at least one of several solids (dexels;
/// van Hook 1986). Lines are named by their indices along the next two axes, in cyclic order.
class Dexels {
 public:
  /// In cells along the line.
  struct Span {
    double from = 0;
    double to = 0;
  };
  struct Line {
    int u = 0;
    int v = 0;
    std::vector<Span> spans;  ///< disjoint, ascending
  };

  /// Closed meshes, outward normals, that may overlap. Gaps shorter than `min_gap` cells are
  /// closed. Indices must stay below 2^31. Cost: what the triangles cover of the grid, sorted.
  Dexels(const std::vector<TriangleMesh>& solids, const CubicGrid& grid, int axis, double min_gap);

  /// Those that meet a solid, sorted.
  const std::vector<Line>& lines() const { return lines_; }

  /// The span of line (u, v) that holds w; nothing where that is outside of all solids.
  const Span* SpanAt(int u, int v, int w) const;

 private:
  std::vector<Line> lines_;
  std::unordered_map<uint64_t, int> index_;
};

}  // namespace curvefusion
