#include "capture/farthest_depth.h"

#include <algorithm>

namespace curvefusion {

Image<float> FarthestInCells(const DepthImage& depth) {
  Image<float> cells((depth.width() + kDepthCellPx - 1) / kDepthCellPx,
                     (depth.height() + kDepthCellPx - 1) / kDepthCellPx);
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      float& cell = cells(u / kDepthCellPx, v / kDepthCellPx);
      cell = std::max(cell, depth(u, v));
    }
  }
  return cells;
}

}  // namespace curvefusion
