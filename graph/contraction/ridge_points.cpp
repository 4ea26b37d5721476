#include "graph/contraction/ridge_points.h"

#include <algorithm>
#include <numeric>

#include "kernel/point_grid.h"

namespace curvefusion {

std::vector<int> StrongestApart(const std::vector<Vec3>& positions,
                                const std::vector<double>& strengths, double spacing) {
  std::vector<int> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return strengths[a] > strengths[b]; });
  const PointGrid grid(positions, spacing);
  std::vector<char> covered(positions.size(), 0);
  std::vector<int> kept;
  for (const int i : order) {
    if (covered[i]) continue;
    grid.ForEachWithin(positions[i], spacing, [&](int j, const Vec3&) { covered[j] = 1; });
    kept.push_back(i);
  }
  return kept;
}

RidgePoints Merged(const RidgePoints& a, const RidgePoints& b, double spacing) {
  RidgePoints both = a;
  both.positions.insert(both.positions.end(), b.positions.begin(), b.positions.end());
  both.directions.insert(both.directions.end(), b.directions.begin(), b.directions.end());
  both.strengths.insert(both.strengths.end(), b.strengths.begin(), b.strengths.end());
  both.levels.insert(both.levels.end(), b.levels.begin(), b.levels.end());
  RidgePoints merged;
  for (const int i : StrongestApart(both.positions, both.strengths, spacing)) {
    merged.positions.push_back(both.positions[i]);
    merged.directions.push_back(both.directions[i]);
    merged.strengths.push_back(both.strengths[i]);
    merged.levels.push_back(both.levels[i]);
  }
  return merged;
}

RidgePoints Transformed(RidgePoints ridge, const RigidTransform& T) {
  for (Vec3& p : ridge.positions) p = T * p;
  for (Vec3& direction : ridge.directions) direction = T.linear() * direction;
  return ridge;
}

}  // namespace curvefusion
