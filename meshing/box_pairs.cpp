#include "meshing/box_pairs.h"

#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace curvefusion {

namespace {
struct IndexedBox {
  using NT = double;
  using ID = int;
  static int dimension() { return 3; }
  int id() const { return index; }
  double min_coord(int d) const { return box->min()[d]; }
  double max_coord(int d) const { return box->max()[d]; }

  const Eigen::AlignedBox3d* box;
  int index;
};
}  // namespace

std::vector<std::pair<int, int>> OverlappingBoxes(const std::vector<Eigen::AlignedBox3d>& boxes) {
  std::vector<IndexedBox> indexed;
  indexed.reserve(boxes.size());
  for (size_t i = 0; i < boxes.size(); ++i) indexed.push_back({&boxes[i], static_cast<int>(i)});
  std::vector<std::pair<int, int>> pairs;
  CGAL::box_self_intersection_d(indexed.begin(), indexed.end(),
                                [&pairs](const IndexedBox& a, const IndexedBox& b) {
                                  pairs.push_back(std::minmax(a.index, b.index));
                                });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace curvefusion
