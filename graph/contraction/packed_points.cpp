#include "graph/contraction/packed_points.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace curvefusion {

namespace {

struct LaneSums {
  Vec3f center;
  float squared_radius;
  Lanes weight{};
  Lanes squared_weight{};
};

// Adds the points of [first, last) that are in the ball.
CURVEFUSION_WIDE_LANES void AddWithin(const PackedArrays& arrays, int first, int last,
                                      LaneSums& sums) {
  Lanes sum = sums.weight;
  Lanes squares = sums.squared_weight;
  for (int i = first; i < last; i += kLanes) {
    const PackedArrays::Packet points = arrays.Load(i, last);
    const Lanes dx = points.x - sums.center.x();
    const Lanes dy = points.y - sums.center.y();
    const Lanes dz = points.z - sums.center.z();
    const Lanes squared = dx * dx + dy * dy + dz * dz;
    const Lanes weights = squared <= sums.squared_radius ? points.weights : Lanes{};
    sum += weights;
    squares += weights * weights;
  }
  sums.weight = sum;
  sums.squared_weight = squares;
}

}  // namespace

void PackedArrays::Resize(size_t points) {
  for (std::vector<float>* values : {&x, &y, &z, &weights}) {
    values->resize(points + kLanes - 1);
    std::fill(values->begin() + static_cast<std::ptrdiff_t>(points), values->end(), 0.0F);
  }
}

PackedPoints::PackedPoints(const std::vector<Vec3>& positions, const std::vector<float>& weights,
                           double radius)
    : grid_(positions, radius),
      origin_(positions.empty() ? Vec3(Vec3::Zero()) : positions.front()) {
  assert(positions.size() == weights.size());
  arrays_.Resize(positions.size());
  for (size_t i = 0; i < positions.size(); ++i) {
    const int point = grid_.order()[i];
    const Vec3f offset = Relative(positions[point]);
    arrays_.x[i] = offset.x();
    arrays_.y[i] = offset.y();
    arrays_.z[i] = offset.z();
    arrays_.weights[i] = weights[point];
  }
}

void PackedPoints::FindCells(const Vec3& low, const Vec3& high, std::vector<Run>& cells) const {
  cells.clear();
  grid_.ForEachCell(low, high, [&](const PointGrid::CellPoints& cell) {
    // What has no bounds is near everything.
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    cells.push_back({cell.is_bounded ? Relative(cell.center) : Vec3f(Vec3f::Constant(kNone)),
                     cell.first, cell.last});
  });
}

BallSums PackedPoints::SumsWithin(const Vec3& center, double radius, Neighbours& neighbours) const {
  LaneSums sums{Relative(center), static_cast<float>(radius * radius)};
  ForEachRangeNear(center, radius, neighbours,
                   [&](int first, int last) { AddWithin(arrays_, first, last, sums); });
  return {Sum(sums.weight), Sum(sums.squared_weight)};
}

}  // namespace curvefusion
