#include "kernel/ball_sums.h"

#include <cassert>
#include <cstring>

namespace curvefusion {

namespace {

// Two points at once: the compiler maps these types to the SIMD registers there are.
typedef double Double2 __attribute__((vector_size(16)));
constexpr int kLanes = 2;

Double2 Load(const double* values) {
  Double2 lanes;
  std::memcpy(&lanes, values, sizeof(lanes));
  return lanes;
}

}  // namespace

BallSums::BallSums(const std::vector<Vec3>& points, const std::vector<float>& weights,
                   double radius)
    : radius_(radius), grid_(points, radius) {
  assert(weights.size() == points.size());
  // Whole pairs are read wherever they start.
  const size_t padded = points.size() + kLanes - 1;
  for (std::vector<double>* values : {&x_, &y_, &z_, &weights_}) values->reserve(padded);
  for (const int point : grid_.order()) {
    x_.push_back(points[point].x());
    y_.push_back(points[point].y());
    z_.push_back(points[point].z());
    weights_.push_back(weights[point]);
  }
  for (std::vector<double>* values : {&x_, &y_, &z_, &weights_}) values->resize(padded, 0);
}

BallSums::Sums BallSums::Around(const Vec3& p) const {
  const double reach = radius_ + grid_.cell_size();
  const auto is_near = [&](double x, double y) {
    const double dx = x - p.x(), dy = y - p.y();
    return dx * dx + dy * dy <= reach * reach;
  };
  const double squared_radius = radius_ * radius_;
  Double2 sum = {0, 0}, squares = {0, 0};
  const auto add = [&](int i, const Double2& weights) {
    const Double2 dx = Load(&x_[i]) - p.x();
    const Double2 dy = Load(&y_[i]) - p.y();
    const Double2 dz = Load(&z_[i]) - p.z();
    const Double2 inside = dx * dx + (dy * dy + dz * dz) <= squared_radius ? weights : Double2{};
    sum += inside;
    squares += inside * inside;
  };
  grid_.ForEachRange(p - Vec3::Constant(radius_), p + Vec3::Constant(radius_), is_near,
                     [&](int first, int last) {
                       int i = first;
                       for (; i + kLanes <= last; i += kLanes) add(i, Load(&weights_[i]));
                       if (i < last) add(i, Double2{weights_[i], 0});
                     });
  return {sum[0] + sum[1], squares[0] + squares[1]};
}

}  // namespace curvefusion
