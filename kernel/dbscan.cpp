#include "kernel/dbscan.h"

#include <algorithm>
#include <cmath>

#include "kernel/buckets.h"
#include "kernel/disjoint_sets.h"
#include "kernel/voxel_grid.h"

namespace curvefusion {

namespace {

// Points within the radius of one another lie at most so many cells apart.
constexpr int kReach = 2;

// Points in cells so small that all points of a cell lie within the radius of one another: most
// are core points, and of one cluster, without a look at any distance (Gunawan 2013).
class DenseCells {
 public:
  DenseCells(const std::vector<Vec3>& points, double radius)
      : points_(points), squared_radius_(radius * radius) {
    constexpr double kRounding = 1e-9;
    const double side = (1 - kRounding) * radius / std::sqrt(3.0);
    for (const Vec3& p : points) cell_of_point_.push_back(cells_.Number(VoxelOf(p, side)));
    points_of_cell_ = SortIntoBuckets(cell_of_point_, cells_.size());
  }

  int size() const { return cells_.size(); }
  int CellOf(int point) const { return cell_of_point_[point]; }
  int Count(int cell) const {
    return points_of_cell_.first[cell + 1] - points_of_cell_.first[cell];
  }

  // Calls visit(cell) for all cells that may hold points within the radius of those of a cell, it
  // included, until it returns false.
  template <class Visit>
  void VisitCellsAround(int cell, const Visit& visit) const {
    const VoxelKey& key = cells_.key(cell);
    for (int x = -kReach; x <= kReach; ++x) {
      for (int y = -kReach; y <= kReach; ++y) {
        for (int z = -kReach; z <= kReach; ++z) {
          const int other = cells_.Find({key.x + x, key.y + y, key.z + z});
          if (other != VoxelNumbers::kNone && !visit(other)) return;
        }
      }
    }
  }

  // Calls visit(point) for the points of a cell within the radius of p, until it returns false.
  template <class Visit>
  bool VisitWithin(int cell, const Vec3& p, const Visit& visit) const {
    for (int i = points_of_cell_.first[cell]; i < points_of_cell_.first[cell + 1]; ++i) {
      const int member = points_of_cell_.members[i];
      if ((points_[member] - p).squaredNorm() <= squared_radius_ && !visit(member)) return false;
    }
    return true;
  }

  template <class Visit>
  void VisitMembers(int cell, const Visit& visit) const {
    for (int i = points_of_cell_.first[cell]; i < points_of_cell_.first[cell + 1]; ++i)
      visit(points_of_cell_.members[i]);
  }

 private:
  const std::vector<Vec3>& points_;
  double squared_radius_;
  VoxelNumbers cells_;
  std::vector<int> cell_of_point_;
  Buckets points_of_cell_;
};

std::vector<char> FindCorePoints(const std::vector<Vec3>& points, const DenseCells& cells,
                                 int min_points) {
  std::vector<char> is_core(points.size(), 1);
  for (size_t i = 0; i < points.size(); ++i) {
    const int own = cells.CellOf(static_cast<int>(i));
    if (cells.Count(own) >= min_points) continue;
    int count = 0;
    const auto is_too_few = [&](int) { return ++count < min_points; };
    cells.VisitCellsAround(
        own, [&](int cell) { return cells.VisitWithin(cell, points[i], is_too_few); });
    is_core[i] = count >= min_points;
  }
  return is_core;
}

// Whether a core point of one cell lies within the radius of one of another.
bool AreLinked(const std::vector<Vec3>& points, const DenseCells& cells,
               const std::vector<char>& is_core, int a, int b) {
  bool is_linked = false;
  cells.VisitMembers(a, [&](int i) {
    if (is_linked || !is_core[i]) return;
    is_linked = !cells.VisitWithin(b, points[i], [&](int j) { return !is_core[j]; });
  });
  return is_linked;
}

DisjointSets LinkCells(const std::vector<Vec3>& points, const DenseCells& cells,
                       const std::vector<char>& is_core) {
  DisjointSets clusters(static_cast<size_t>(cells.size()));
  for (int cell = 0; cell < cells.size(); ++cell) {
    cells.VisitCellsAround(cell, [&](int other) {
      if (other < cell && clusters.Root(other) != clusters.Root(cell) &&
          AreLinked(points, cells, is_core, cell, other)) {
        clusters.Unite(cell, other);
      }
      return true;
    });
  }
  return clusters;
}

}  // namespace

std::vector<int> Dbscan(const std::vector<Vec3>& points, double radius, int min_points) {
  const DenseCells cells(points, radius);
  const std::vector<char> is_core = FindCorePoints(points, cells, min_points);
  DisjointSets clusters = LinkCells(points, cells, is_core);
  std::vector<int> labels(points.size(), kNoise);
  std::vector<int> label_of_cell(static_cast<size_t>(cells.size()), kNoise);
  int count = 0;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!is_core[i]) continue;
    int& label = label_of_cell[clusters.Root(cells.CellOf(static_cast<int>(i)))];
    if (label == kNoise) label = count++;
    labels[i] = label;
  }
  for (size_t i = 0; i < points.size(); ++i) {
    if (is_core[i]) continue;
    int first = kNoise;
    const auto take_first = [&](int j) {
      if (is_core[j] && (first == kNoise || labels[j] < first)) first = labels[j];
      return true;
    };
    cells.VisitCellsAround(cells.CellOf(static_cast<int>(i)), [&](int cell) {
      return cells.VisitWithin(cell, points[i], take_first);
    });
    labels[i] = first;
  }
  return labels;
}

std::vector<std::vector<int>> ClustersOf(const std::vector<int>& labels) {
  std::vector<std::vector<int>> clusters;
  for (size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] == kNoise) continue;
    clusters.resize(std::max(clusters.size(), static_cast<size_t>(labels[i]) + 1));
    clusters[labels[i]].push_back(static_cast<int>(i));
  }
  return clusters;
}

}  // namespace curvefusion
