#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernel/geometry.h"
#include "meshing/junction_union.h"

namespace curvefusion {

/// A point at which an edge of one solid crosses a triangle of the other.
struct CrossingNode {
  int low, high;  ///< vertices of the edge, low < high
  double along;   ///< position on it, 0 at low and 1 at high
  Vec3 point;
};

/// A segment along which a triangle crosses another. Seen from outside of its solid, what lies on
/// the left of the way between the nodes is inside the other solid.
struct CrossingSegment {
  int face;
  int from, to;  ///< nodes
};

/// Where the surfaces of two solids cross.
struct SolidCrossing {
  std::vector<CrossingNode> nodes;
  std::vector<CrossingSegment> segments;  ///< of both solids, those of one face together
};

/// Where two solids cross; `both` holds their triangles, those of the first solid before
/// `second_face`. All decisions are exact on the coordinates as they are, the places of nodes are
/// rounded. Nothing where the solids are not in general position to each other: a vertex in the
/// plane of a triangle, edges that meet. Near-linear in triangles and pairs that come near each
/// other.
std::optional<SolidCrossing> FindCrossing(const UnionMesh& both, int second_face);

}  // namespace curvefusion
