#include "meshing/dexels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

namespace curvefusion {

namespace {

// A line enters (+1) or leaves (-1) a solid.
struct Crossing {
  uint64_t line;
  double depth;
  int step;
};

uint64_t KeyOf(int u, int v) {
  return (static_cast<uint64_t>(static_cast<uint32_t>(u)) << 32) | static_cast<uint32_t>(v);
}

// A corner as seen along the lines.
struct Corner {
  double u, v, depth;
};

// Where an edge meets a row of lines (v = constant).
struct RowCrossing {
  double u = 0;
  double depth = 0;
  bool downwards = false;  // as the triangle's boundary runs
};

// The same numbers for both triangles of the edge, so that no line slips through between them.
RowCrossing CrossRow(const Corner& from, const Corner& to, double row) {
  const bool downwards = from.v > to.v;
  const Corner& low = downwards ? to : from;
  const Corner& high = downwards ? from : to;
  const double part = (row - low.v) / (high.v - low.v);
  return {low.u + part * (high.u - low.u), low.depth + part * (high.depth - low.depth), downwards};
}

// All lines that meet a triangle. Its edges count half-open: a line through an edge or a corner
// meets exactly one of the triangles around it.
void AddTriangle(const std::array<Corner, 3>& triangle, std::vector<Crossing>& crossings) {
  const auto [lowest, highest] = std::minmax({triangle[0].v, triangle[1].v, triangle[2].v});
  for (int row = static_cast<int>(std::ceil(lowest)); row < highest; ++row) {
    std::array<RowCrossing, 2> ends;
    int count = 0;
    for (int k = 0; k < 3; ++k) {
      const Corner& from = triangle[k];
      const Corner& to = triangle[(k + 1) % 3];
      if ((from.v <= row) != (to.v <= row)) ends[count++] = CrossRow(from, to, row);
    }
    if (count < 2) continue;
    auto& [left, right] = ends;
    if (left.u > right.u) std::swap(left, right);
    // Counter-clockwise boundaries run down on the left: such a triangle faces along the line.
    const int step = left.downwards ? -1 : 1;
    for (int u = static_cast<int>(std::ceil(left.u)); u < right.u; ++u) {
      const double part = (u - left.u) / (right.u - left.u);
      crossings.push_back({KeyOf(u, row), left.depth + part * (right.depth - left.depth), step});
    }
  }
}

std::vector<Crossing> SortedCrossings(const std::vector<TriangleMesh>& solids,
                                      const CubicGrid& grid, int axis) {
  std::vector<Crossing> crossings;
  for (const TriangleMesh& solid : solids) {
    std::vector<Corner> corners;
    for (const Vec3f& vertex : solid.vertices) {
      const Vec3 p = (vertex.cast<double>() - grid.origin) / grid.spacing;
      corners.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3], p[axis]});
    }
    for (const auto& [a, b, c] : solid.triangles) {
      AddTriangle({corners[a], corners[b], corners[c]}, crossings);
    }
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return std::tie(a.line, a.depth, a.step) < std::tie(b.line, b.depth, b.step);
  });
  return crossings;
}

}  // namespace

Dexels::Dexels(const std::vector<TriangleMesh>& solids, const CubicGrid& grid, int axis,
               double min_gap) {
  int inside = 0;  // of so many solids
  uint64_t line = 0;
  for (const Crossing& crossing : SortedCrossings(solids, grid, axis)) {
    if (lines_.empty() || crossing.line != line) {
      line = crossing.line;
      lines_.push_back({static_cast<int>(line >> 32), static_cast<int>(line & 0xffffffffU), {}});
      inside = 0;
    }
    std::vector<Span>& spans = lines_.back().spans;
    const bool is_apart = spans.empty() || crossing.depth - spans.back().to >= min_gap;
    if (inside == 0 && is_apart) spans.push_back({crossing.depth, crossing.depth});
    inside += crossing.step;
    spans.back().to = crossing.depth;
  }
  index_.reserve(lines_.size());
  for (size_t i = 0; i < lines_.size(); ++i) {
    index_[KeyOf(lines_[i].u, lines_[i].v)] = static_cast<int>(i);
  }
}

const Dexels::Span* Dexels::SpanAt(int u, int v, int w) const {
  const auto found = index_.find(KeyOf(u, v));
  if (found == index_.end()) return nullptr;
  for (const Span& span : lines_[found->second].spans) {
    if (span.from <= w && w < span.to) return &span;
  }
  return nullptr;
}

}  // namespace curvefusion
