#include "fusion/segmentation/ghost_removal.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "kernel/dbscan.h"
#include "kernel/point_grid.h"

namespace curvefusion {

namespace {

using Cluster = std::vector<int>;  // indices of points
// Metres; chosen: what is searched first for a neighbour.
constexpr double kSearchRadius = 0.02;
// Of the largest cluster's points: other objects are larger, parts between which wires have no
// depth may be smaller, but nearly all of their points are verified. Chosen on 41 training scans
// and 6 rooms without wires (docs/lab_notebook.md).
constexpr double kObjectShare = 0.3;
constexpr double kPartShare = 0.05;
constexpr double kPartVerified = 0.9;

// Clusters of at least min_cluster_points, largest first.
std::vector<Cluster> LargeClusters(const std::vector<Vec3>& points,
                                   const GhostRemovalOptions& options) {
  std::vector<Cluster> clusters =
      ClustersOf(Dbscan(points, options.cluster_radius, options.core_points));
  const auto too_small = [&](const Cluster& cluster) {
    return static_cast<int>(cluster.size()) < options.min_cluster_points;
  };
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(), too_small), clusters.end());
  std::stable_sort(clusters.begin(), clusters.end(),
                   [](const Cluster& a, const Cluster& b) { return a.size() > b.size(); });
  return clusters;
}

// The share of a cluster's points that lie on colour edges.
double VerifiedShare(const BundlePoints& bundle, const Cluster& cluster) {
  int verified = 0;
  for (const int i : cluster) verified += bundle.on_edge[i];
  return static_cast<double>(verified) / static_cast<double>(cluster.size());
}

std::vector<Vec3> PointsOf(const std::vector<Vec3>& points, const Cluster& cluster) {
  std::vector<Vec3> of_cluster;
  for (const int i : cluster) of_cluster.push_back(points[i]);
  return of_cluster;
}

bool IsNear(const std::vector<Vec3>& points, const PointGrid& others, double distance) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Vec3& p) { return others.Nearest(p, distance) >= 0; });
}

int64_t CountPoints(const std::vector<Cluster>& clusters) {
  return std::accumulate(clusters.begin(), clusters.end(), int64_t{0},
                         [](int64_t sum, const Cluster& cluster) {
                           return sum + static_cast<int64_t>(cluster.size());
                         });
}

// Whether colours say that a cluster far from all others is no ghost.
bool StandsAlone(const BundlePoints& bundle, const Cluster& cluster, size_t largest,
                 const GhostRemovalOptions& options) {
  const auto size = static_cast<double>(cluster.size()), most = static_cast<double>(largest);
  const double verified = VerifiedShare(bundle, cluster);
  if (size >= kObjectShare * most) return verified >= options.isolated_share;
  return size >= kPartShare * most && verified >= std::max(options.isolated_share, kPartVerified);
}

// Clusters within isolation_distance of a larger cluster that stays, and large ones that colour
// verifies; the largest always stays.
std::vector<Cluster> WithoutIsolated(const BundlePoints& bundle, std::vector<Cluster> clusters,
                                     const GhostRemovalOptions& options) {
  const std::vector<Vec3>& points = bundle.points.positions;
  const size_t largest = clusters.empty() ? 0 : clusters.front().size();
  std::vector<Cluster> kept;
  std::vector<PointGrid> kept_points;
  for (Cluster& cluster : clusters) {
    const std::vector<Vec3> of_cluster = PointsOf(points, cluster);
    const auto is_near = [&](const PointGrid& larger) {
      return IsNear(of_cluster, larger, options.isolation_distance);
    };
    if (!kept.empty() && !StandsAlone(bundle, cluster, largest, options) &&
        std::none_of(kept_points.begin(), kept_points.end(), is_near)) {
      continue;
    }
    kept_points.emplace_back(of_cluster, kSearchRadius);
    kept.push_back(std::move(cluster));
  }
  return kept;
}

}  // namespace

void VisitOptions(GhostRemovalOptions& options, OptionVisitor& visitor) {
  visitor.Visit({"cluster_radius", "m", 0.001, 0.1,
                 "DBSCAN radius. CurveFusion 4.1 uses DBSCAN, the value is ours."},
                options.cluster_radius);
  visitor.Visit({"core_points", "points", 1, 100,
                 "DBSCAN density. CurveFusion 4.1 uses DBSCAN, the value is ours."},
                options.core_points);
  visitor.Visit(
      {"min_cluster_points", "points", 1, 100000, "Smaller clusters are ghosts. CurveFusion 4.1."},
      options.min_cluster_points);
  visitor.Visit({"isolation_distance", "m", 0, 10,
                 "Clusters farther than this from every larger one are ghosts. CurveFusion 4.1, "
                 "read as said in ghost_removal.h."},
                options.isolation_distance);
  visitor.Visit({"isolated_share", "", 0, 2,
                 "Deviation: large clusters are no ghosts, however far away, where such a share of "
                 "their points lies on colour edges: another object, or a part of one between "
                 "which wires have no depth. More than 1 = never."},
                options.isolated_share);
  visitor.Visit(
      {"verified_share", "", 0, 1,
       "Clusters with a smaller share of points on colour edges are ghosts. CurveFusion 4.1."},
      options.verified_share);
}

BundlePoints RemoveGhosts(const BundlePoints& bundle, const GhostRemovalOptions& options,
                          PointFunnel* funnel) {
  std::vector<Cluster> clusters = LargeClusters(bundle.points.positions, options);
  const int64_t clustered = CountPoints(clusters);
  const auto unverified = [&](const Cluster& cluster) {
    return VerifiedShare(bundle, cluster) < options.verified_share;
  };
  clusters.erase(std::remove_if(clusters.begin(), clusters.end(), unverified), clusters.end());
  const int64_t verified = CountPoints(clusters);
  std::vector<int> kept;
  for (const Cluster& cluster : WithoutIsolated(bundle, std::move(clusters), options)) {
    kept.insert(kept.end(), cluster.begin(), cluster.end());
  }
  if (funnel != nullptr) {
    funnel->small_clusters += static_cast<int64_t>(bundle.points.size()) - clustered;
    funnel->unverified += clustered - verified;
    funnel->isolated += verified - static_cast<int64_t>(kept.size());
  }
  std::sort(kept.begin(), kept.end());
  BundlePoints remaining;
  for (const int i : kept) {
    remaining.points.Add(bundle.points, static_cast<size_t>(i));
    remaining.on_edge.push_back(bundle.on_edge[i]);
    remaining.voxels.push_back(bundle.voxels[i]);
  }
  return remaining;
}

}  // namespace curvefusion
