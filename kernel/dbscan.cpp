#include "kernel/dbscan.h"

#include "kernel/point_grid.h"

namespace curvefusion {

std::vector<int> Dbscan(const std::vector<Vec3>& points, double radius, int min_points) {
  const PointGrid grid(points, radius);
  const int n = static_cast<int>(points.size());
  std::vector<int> labels(n, kNoise);
  std::vector<int> neighbours, frontier;
  const auto find_neighbours = [&](int point) {
    neighbours.clear();
    grid.ForEachWithin(points[point], radius, [&](int i, const Vec3&) { neighbours.push_back(i); });
    return static_cast<int>(neighbours.size());
  };
  int clusters = 0;
  for (int seed = 0; seed < n; ++seed) {
    if (labels[seed] != kNoise) continue;
    if (find_neighbours(seed) < min_points) continue;
    labels[seed] = clusters;
    frontier.assign(1, seed);
    while (!frontier.empty()) {
      const int current = frontier.back();
      frontier.pop_back();
      if (find_neighbours(current) < min_points) continue;
      for (const int neighbour : neighbours) {
        if (labels[neighbour] != kNoise) continue;
        labels[neighbour] = clusters;
        frontier.push_back(neighbour);
      }
    }
    ++clusters;
  }
  return labels;
}

}  // namespace curvefusion
