#pragma once

#include <limits>
#include <vector>

#include "kernel/geometry.h"
#include "kernel/point_grid.h"
#include "kernel/wide_lanes.h"

namespace curvefusion {

/// So many points are summed at a time. Derived: the floats that a register of AVX2 holds.
inline constexpr int kLanes = 8;
using Lanes [[gnu::vector_size(kLanes * sizeof(float))]] = float;

/// The sum of the lanes, always in the same order.
inline float Sum(const Lanes& lanes) {
  float sum = 0;
  for (int i = 0; i < kLanes; ++i) sum += lanes[i];
  return sum;
}

/// Sums over the points of a ball.
struct BallSums {
  double weight = 0;
  double squared_weight = 0;
};

/// Points as flat arrays of floats, padded so that whole packets can be read wherever they start.
struct PackedArrays {
  std::vector<float> x, y, z, weights;

  /// kLanes points of a range that ends before `last`, from the `first` on; those from `last` on
  /// weigh nothing.
  struct Packet {
    Lanes x, y, z, weights;
  };
  Packet Load(int first, int last) const;

  /// Room for so many points and the padding behind them, which weighs nothing.
  void Resize(size_t points);
};

/// Weighted points sorted into a grid and stored as flat arrays of floats, relative to one of them:
/// for very many sums over all points near a place. Thread-safe for concurrent queries, each with
/// neighbours of its own. Building is linear.
class PackedPoints {
 public:
  /// For queries of about `radius`, metres. Positions must be finite, as many as weights.
  PackedPoints(const std::vector<Vec3>& positions, const std::vector<float>& weights,
               double radius);

  /// Points that are all in one place of the arrays, [first, last), and near one another.
  struct Run {
    Vec3f center;  ///< of their cell, as the points are stored
    int first;
    int last;
  };

  /// The cells around the last query, kept for the next one, which is fast where it lies in the
  /// same cell: ask for places in order (GroupByCell). The results do not depend on it.
  class Neighbours {
   private:
    friend class PackedPoints;
    std::vector<Run> cells_;
    Vec3 center_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
    double radius_ = 0;
  };

  /// Of all points within `radius` of the centre, to single precision.
  BallSums SumsWithin(const Vec3& center, double radius, Neighbours& neighbours) const;

  /// Calls visit(first, last) for parts of the arrays that hold all points within `radius` of the
  /// centre and few others.
  template <class Visit>
  void ForEachRangeNear(const Vec3& center, double radius, Neighbours& neighbours,
                        const Visit& visit) const;

  /// The occupied cells that overlap a box.
  void FindCells(const Vec3& low, const Vec3& high, std::vector<Run>& cells) const;

  double cell_size() const { return grid_.cell_size(); }

  /// The points' indices, sorted by cell.
  const std::vector<int>& order() const { return grid_.order(); }

  /// A place as the points are stored.
  Vec3f Relative(const Vec3& place) const { return (place - origin_).cast<float>(); }

  /// In the order of the grid.
  const PackedArrays& arrays() const { return arrays_; }

 private:
  PointGrid grid_;
  Vec3 origin_;
  PackedArrays arrays_;
};

[[gnu::always_inline]] inline PackedArrays::Packet PackedArrays::Load(int first, int last) const {
  // From so many on, ones for so many lanes less. Derived: kLanes ones.
  static constexpr float kOnesThenZeros[2 * kLanes] = {1, 1, 1, 1, 1, 1, 1, 1};
  Packet packet;
  __builtin_memcpy(&packet.x, &x[first], sizeof(Lanes));
  __builtin_memcpy(&packet.y, &y[first], sizeof(Lanes));
  __builtin_memcpy(&packet.z, &z[first], sizeof(Lanes));
  __builtin_memcpy(&packet.weights, &weights[first], sizeof(Lanes));
  if (last - first < kLanes) {
    Lanes ones;
    __builtin_memcpy(&ones, &kOnesThenZeros[kLanes - (last - first)], sizeof(Lanes));
    packet.weights *= ones;
  }
  return packet;
}

template <class Visit>
void PackedPoints::ForEachRangeNear(const Vec3& center, double radius, Neighbours& neighbours,
                                    const Visit& visit) const {
  const Vec3 cell = grid_.CellCenterAt(center);
  if (cell != neighbours.center_ || radius != neighbours.radius_) {
    neighbours.center_ = cell;
    neighbours.radius_ = radius;
    const Vec3 reach = Vec3::Constant(radius + 0.5 * cell_size());
    FindCells(cell - reach, cell + reach, neighbours.cells_);
  }
  const Vec3f at = Relative(center);
  const float half_cell = static_cast<float>(0.5 * cell_size());
  const float squared_radius = static_cast<float>(1.00001 * radius * radius);
  int first = 0;
  int last = 0;
  for (const Run& run : neighbours.cells_) {
    const float dx = std::max(0.0F, std::abs(run.center.x() - at.x()) - half_cell);
    const float dy = std::max(0.0F, std::abs(run.center.y() - at.y()) - half_cell);
    const float dz = std::max(0.0F, std::abs(run.center.z() - at.z()) - half_cell);
    if (dx * dx + dy * dy + dz * dz > squared_radius) continue;
    if (run.first != last) {
      if (first < last) visit(first, last);
      first = run.first;
    }
    last = run.last;
  }
  if (first < last) visit(first, last);
}

}  // namespace curvefusion
