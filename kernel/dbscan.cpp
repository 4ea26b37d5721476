#include "kernel/dbscan.h"

#include "kernel/spatial_search.h"

namespace curvefusion {

std::vector<int> Dbscan(const std::vector<Vec3>& points, double radius, int min_points) {
  const PointIndex index(points);
  const int n = static_cast<int>(points.size());
  std::vector<int> labels(n, kNoise);
  std::vector<int> neighbours, frontier;
  int clusters = 0;
  for (int seed = 0; seed < n; ++seed) {
    if (labels[seed] != kNoise) continue;
    index.WithinRadius(points[seed], radius, neighbours);
    if (static_cast<int>(neighbours.size()) < min_points) continue;
    labels[seed] = clusters;
    frontier.assign(1, seed);
    while (!frontier.empty()) {
      const int current = frontier.back();
      frontier.pop_back();
      index.WithinRadius(points[current], radius, neighbours);
      if (static_cast<int>(neighbours.size()) < min_points) continue;
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
