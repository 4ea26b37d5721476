#include "experiments/simulation/families/wire_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {
namespace {

// Between b and c at t in [0, 1], with knots spaced by square roots of distances (Barry and
// Goldman 1988).
Vec3 CatmullRom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double share) {
  const auto step = [](const Vec3& p, const Vec3& q) { return std::sqrt((q - p).norm()); };
  const double t0 = 0, t1 = t0 + step(a, b), t2 = t1 + step(b, c), t3 = t2 + step(c, d);
  const double t = t1 + share * (t2 - t1);
  const auto mix = [t](const Vec3& p, const Vec3& q, double from, double to) -> Vec3 {
    return ((to - t) * p + (t - from) * q) / (to - from);
  };
  const Vec3 ab = mix(a, b, t0, t1), bc = mix(b, c, t1, t2), cd = mix(c, d, t2, t3);
  return mix(mix(ab, bc, t0, t2), mix(bc, cd, t1, t3), t1, t2);
}

}  // namespace

Polyline SmoothThrough(const Polyline& knots, double step) {
  Polyline points = {knots.front()};
  const int last = static_cast<int>(knots.size()) - 1;
  for (int i = 0; i < last; ++i) {
    const Vec3& b = knots[i];
    const Vec3& c = knots[i + 1];
    const Vec3 a = i > 0 ? knots[i - 1] : Vec3(2 * b - c);
    const Vec3 d = i + 1 < last ? knots[i + 2] : Vec3(2 * c - b);
    const int parts = std::max(1, static_cast<int>(std::ceil((c - b).norm() / step)));
    for (int k = 1; k < parts; ++k) {
      points.push_back(CatmullRom(a, b, c, d, static_cast<double>(k) / parts));
    }
    points.push_back(c);
  }
  return points;
}

Polyline Straight(const Vec3& from, const Vec3& to, double step) {
  const int parts = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step)));
  Polyline points = {from};
  for (int k = 1; k < parts; ++k) points.push_back(from + (to - from) * k / parts);
  points.push_back(to);
  return points;
}

Polyline PlaneCurve(double length, const std::function<double(double)>& curvature, double step) {
  const int parts = std::max(1, static_cast<int>(std::ceil(length / step)));
  const double ds = length / parts;
  Polyline points = {Vec3::Zero()};
  double heading = 0;
  for (int k = 0; k < parts; ++k) {
    const double turn = curvature((k + 0.5) * ds) * ds;
    heading += turn / 2;
    points.push_back(points.back() + ds * Vec3(std::cos(heading), std::sin(heading), 0));
    heading += turn / 2;
  }
  return points;
}

double SelfDistance(const Polyline& points, double apart, bool closed) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<double> at = CumulativeLength(points);
  for (size_t i = 0; i < points.size(); ++i) {
    for (size_t j = 0; j < i; ++j) {
      const double separation = at[i] - at[j];
      if (separation < apart || (closed && at.back() - separation < apart)) continue;
      least = std::min(least, (points[i] - points[j]).norm());
    }
  }
  return least;
}

Lattice::Lattice(int columns, int rows, bool closed,
                 const std::function<Vec3(double u, double v)>& at)
    : columns_(columns), rows_(rows), width_(columns * kFine + 1), closed_(closed) {
  for (int y = 0; y <= rows * kFine; ++y) {
    for (int x = 0; x < width_; ++x) {
      const bool again = closed && x == width_ - 1;
      points_.push_back(again ? Point(0, y)
                              : at(static_cast<double>(x) / kFine, static_cast<double>(y) / kFine));
    }
  }
}

Polyline Lattice::RowPart(int row, int first, int last) const {
  const bool loop = closed_ && first == 0 && last == columns_;
  Polyline points;
  for (int x = first * kFine; x <= last * kFine - (loop ? 1 : 0); ++x) {
    points.push_back(Point(x, row * kFine));
  }
  return points;
}

Polyline Lattice::ColumnPart(int column, int first, int last) const {
  Polyline points;
  for (int y = first * kFine; y <= last * kFine; ++y) points.push_back(Point(column * kFine, y));
  return points;
}

}  // namespace curvefusion
