#include "fusion/paper/ghost_clusters.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <set>

#include "kernel/dbscan.h"
#include "kernel/point_grid.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

using Clusters = std::vector<ObservedPoints>;

// What is searched first for a neighbour, metres. Chosen: only the time depends on it.
constexpr double kSearchRadius = 0.02;

Clusters SplitIntoClusters(const ObservedPoints& points, const GhostClusterOptions& options) {
  const std::vector<int> labels =
      Dbscan(points.positions, options.cluster_radius, options.core_points);
  Clusters clusters;
  for (const std::vector<int>& members : ClustersOf(labels)) {
    ObservedPoints& cluster = clusters.emplace_back();
    for (const int i : members) cluster.Add(points, static_cast<size_t>(i));
  }
  return clusters;
}

// A cluster, its bounds, and its points to be searched.
struct Extent {
  explicit Extent(const ObservedPoints& cluster)
      : points(cluster.positions), grid(cluster.positions, kSearchRadius) {
    for (const Vec3& p : points) bounds.extend(p);
  }
  bool IsNear(const Extent& other, double distance) const {
    if (bounds.exteriorDistance(other.bounds) > distance) return false;
    return std::any_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return other.grid.Nearest(p, distance) >= 0; });
  }

  const std::vector<Vec3>& points;
  PointGrid grid;
  Eigen::AlignedBox3d bounds;
};

Clusters WithoutIsolated(Clusters clusters, double distance) {
  const std::vector<Extent> extents(clusters.begin(), clusters.end());
  const auto is_ghost = [&](size_t i) {
    if (extents[i].bounds.diagonal().norm() > distance) return false;
    for (size_t j = 0; j < extents.size(); ++j) {
      if (j != i && extents[i].IsNear(extents[j], distance)) return false;
    }
    return true;
  };
  Clusters kept;
  for (size_t i = 0; i < clusters.size(); ++i) {
    if (!is_ghost(i)) kept.push_back(clusters[i]);
  }
  return kept;
}

// "We first represent all the clusters in a voxel grid."
bool IsVerified(const ObservedPoints& cluster, const std::set<VoxelKey>& lifted, double voxel_size,
                double share) {
  std::set<VoxelKey> voxels;
  for (const Vec3& p : cluster.positions) voxels.insert(VoxelOf(p, voxel_size));
  const auto verified = std::count_if(
      voxels.begin(), voxels.end(), [&](const VoxelKey& voxel) { return lifted.count(voxel) > 0; });
  return static_cast<double>(verified) >= share * static_cast<double>(voxels.size());
}

int64_t CountPoints(const Clusters& clusters) {
  int64_t count = 0;
  for (const ObservedPoints& cluster : clusters) count += static_cast<int64_t>(cluster.size());
  return count;
}

}  // namespace

void VisitOptions(GhostClusterOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"cluster_radius", "m", 0.001, 0.1,
                 "DBSCAN radius. CurveFusion 4.1 uses DBSCAN, the value is ours."},
                options.cluster_radius);
  visitor.Visit({"core_points", "points", 1, 1000,
                 "DBSCAN density. CurveFusion 4.1 uses DBSCAN; Ester et al. 1996 have 4."},
                options.core_points);
  visitor.Visit(
      {"min_cluster_points", "points", 1, 100000, "Smaller clusters are ghosts. CurveFusion 4.1."},
      options.min_cluster_points);
  visitor.Visit({"isolation_distance", "m", 0, 10,
                 "Clusters shorter than this and farther than this from every other one are "
                 "ghosts. CurveFusion 4.1."},
                options.isolation_distance);
  visitor.Visit({"verified_share", "", 0, 1,
                 "Clusters with a smaller share of voxels on colour edges are ghosts. CurveFusion "
                 "4.1."},
                options.verified_share);
}

std::vector<ObservedPoints> RemoveGhostClusters(const ObservedPoints& points,
                                                const std::vector<Vec3>& edge_samples,
                                                double voxel_size,
                                                const GhostClusterOptions& options,
                                                PointFunnel& funnel) {
  Clusters clusters = SplitIntoClusters(points, options);
  std::erase_if(clusters, [&](const ObservedPoints& cluster) {
    return static_cast<int>(cluster.size()) < options.min_cluster_points;
  });
  const int64_t large = CountPoints(clusters);
  clusters = WithoutIsolated(std::move(clusters), options.isolation_distance);
  const int64_t connected = CountPoints(clusters);
  std::set<VoxelKey> lifted;
  for (const Vec3& sample : edge_samples) lifted.insert(VoxelOf(sample, voxel_size));
  std::erase_if(clusters, [&](const ObservedPoints& cluster) {
    return !IsVerified(cluster, lifted, voxel_size, options.verified_share);
  });
  const int64_t verified = CountPoints(clusters);
  funnel.small_clusters += static_cast<int64_t>(points.size()) - large;
  funnel.isolated += large - connected;
  funnel.unverified += connected - verified;
  funnel.points += verified;
  return clusters;
}

}  // namespace curvefusion
