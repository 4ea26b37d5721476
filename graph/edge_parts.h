#pragma once

#include <cstddef>
#include <vector>

#include "graph/skeleton_graph.h"

namespace curvefusion {

/// Consecutive points of an edge, both included.
struct EdgePart {
  size_t first = 0;
  size_t last = 0;
};

inline size_t PointCount(const EdgePart& part) { return part.last - part.first + 1; }

/// The share of a part's points for which `holds(point)`.
template <class Holds>
double ShareOf(const Polyline& points, const EdgePart& part, const Holds& holds) {
  size_t count = 0;
  for (size_t i = part.first; i <= part.last; ++i) count += holds(points[i]) ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(PointCount(part));
}

/// The longest parts of so many points in which `holds(index)` for all.
template <class Holds>
std::vector<EdgePart> PartsWhere(size_t count, const Holds& holds) {
  std::vector<EdgePart> parts;
  for (size_t i = 0; i < count; ++i) {
    if (!holds(i)) continue;
    if (parts.empty() || parts.back().last + 1 < i) parts.push_back({i, i});
    parts.back().last = i;
  }
  return parts;
}

/// Metres along a curve from the first to the last point of a part.
double Length(const Polyline& points, const EdgePart& part);

/// Metres of a curve that is left, at least; derived: the shortest spur.
inline constexpr double kMinPiece = 0.012;

/// Leaves of an edge only these parts (ascending, apart), and of them those at least `min_length`
/// metres long. Parts that begin or end at a node of the edge stay there; free nodes are made at
/// all other ends. Nodes that lose their last edge stay.
void KeepParts(EdgeId edge, const std::vector<EdgePart>& parts, double min_length,
               SkeletonGraph& skeleton);

}  // namespace curvefusion
