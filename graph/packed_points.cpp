#include "graph/packed_points.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

namespace curvefusion {

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
  const Vec3f at = Relative(center);
  const auto squared_radius = static_cast<float>(radius * radius);
  Lanes sum{};
  Lanes squares{};
  ForEachRangeNear(center, radius, neighbours, [&](int first, int last) {
    Lanes sum_here = sum, squares_here = squares;
    for (int i = first; i < last; i += kLanes) {
      const PackedArrays::Packet points = arrays_.Load(i, last);
      const Lanes dx = points.x - at.x();
      const Lanes dy = points.y - at.y();
      const Lanes dz = points.z - at.z();
      const Lanes squared = dx * dx + dy * dy + dz * dz;
      const Lanes weights = squared <= squared_radius ? points.weights : Lanes{};
      sum_here += weights;
      squares_here += weights * weights;
    }
    sum = sum_here;
    squares = squares_here;
  });
  return {Sum(sum), Sum(squares)};
}

std::vector<int> InOrderOfCells(const std::vector<Vec3>& places, double cell_size) {
  return PointGrid(places, 2 * cell_size).order();
}

}  // namespace curvefusion
