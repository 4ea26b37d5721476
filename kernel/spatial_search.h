#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "kernel/geometry.h"

namespace curvefusion {

/// A static index over points (a CGAL Kd_tree). Thread-safe for concurrent queries. Building costs
/// O(n log n); results are in ascending index order, so they do not depend on the tree's layout.
class PointIndex {
 public:
  explicit PointIndex(const std::vector<Vec3>& points);
  ~PointIndex();
  PointIndex(PointIndex&&) noexcept;
  PointIndex& operator=(PointIndex&&) noexcept;

  size_t size() const;

  /// Indices of all points within `radius` (inclusive) of p, ascending, into `found` (overwritten,
  /// so that its memory is reused from query to query).
  void WithinRadius(const Vec3& p, double radius, std::vector<int>& found) const;

  /// Index of the nearest point, -1 for an empty index.
  int Nearest(const Vec3& p) const;

  /// Indices of the k nearest points, nearest first; fewer where there are fewer.
  std::vector<int> NearestK(const Vec3& p, int k) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace curvefusion
