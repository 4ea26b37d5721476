#pragma once

#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// Label of points that belong to no cluster.
inline constexpr int kNoise = -1;

/// Density-based clusters (Ester et al. 1996): a point with at least `min_points` points within
/// `radius`, itself included, is a core point; clusters are what core points reach through one
/// another. Returns one label per point: 0, 1, ... in order of each cluster's lowest index, or
/// kNoise. A border point goes to the first cluster that reaches it.
std::vector<int> Dbscan(const std::vector<Vec3>& points, double radius, int min_points);

/// The points of each cluster, ascending, by the labels of Dbscan.
std::vector<std::vector<int>> ClustersOf(const std::vector<int>& labels);

}  // namespace curvefusion
