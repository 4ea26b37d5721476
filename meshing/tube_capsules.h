#pragma once

#include <array>
#include <map>
#include <vector>

#include "graph/skeleton_graph.h"
#include "kernel/geometry.h"

namespace curvefusion {

/// A piece of a tube short enough to have one radius: all balls about the points of a segment.
struct TubeCapsule {
  Vec3 a;
  Vec3 b;
  double radius = 0;

  double Volume() const;
  /// From its surface, negative inside.
  double Distance(const Vec3& p) const;
};

/// The tubes of a skeleton, whose edges must have radii, as capsules; where a radius changes along
/// a segment, the steps are 2 % of it.
std::vector<TubeCapsule> CapsulesOf(const SkeletonGraph& graph);

/// Capsules by the cells of a grid they may reach, so that a point looks at few of them.
class CapsuleGrid {
 public:
  explicit CapsuleGrid(std::vector<TubeCapsule> capsules);

  const std::vector<TubeCapsule>& capsules() const { return capsules_; }
  const TubeCapsule& operator[](int index) const { return capsules_[index]; }

  /// All capsules nearer to a point than half their radius, and some others.
  const std::vector<int>& Near(const Vec3& p) const;

 private:
  using Cell = std::array<int, 3>;
  Cell CellOf(const Vec3& p) const;

  std::vector<TubeCapsule> capsules_;
  double cell_size_ = 0;
  std::map<Cell, std::vector<int>> cells_;
};

}  // namespace curvefusion
