#include "experiments/simulation/curve_shapes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvefusion {
namespace {

constexpr double kPi = std::numbers::pi;

// Second derivatives at the knots of the periodic C2 spline: the standard three-moment equations,
// closed into a circle. steps[i] is the parameter from knot i to knot i + 1.
Eigen::MatrixX2d SplineMoments(const std::vector<Vec2>& knots, const std::vector<double>& steps) {
  const int n = static_cast<int>(knots.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixX2d right(n, 2);
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n;
    const int after = (i + 1) % n;
    system(i, before) += steps[before] / 6;
    system(i, i) += (steps[before] + steps[i]) / 3;
    system(i, after) += steps[i] / 6;
    right.row(i) =
        (knots[after] - knots[i]) / steps[i] - (knots[i] - knots[before]) / steps[before];
  }
  return system.partialPivLu().solve(right);
}

}  // namespace

WireCurve Wire(const Polyline& points_mm, double diameter_mm) {
  WireCurve curve{points_mm, diameter_mm * kMillimetre};
  for (Vec3& point : curve.points) point *= kMillimetre;
  return curve;
}

WireCurve Loop(const Polyline& points_mm, double diameter_mm) {
  WireCurve curve = Wire(points_mm, diameter_mm);
  const Vec3 first = curve.points.front();
  curve.points.push_back(first);
  return curve;
}

Polyline CirclePoints(double radius_mm, double z_mm, int count) {
  Polyline points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    points.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle), z_mm);
  }
  return points;
}

Polyline RoundedRectangle(double width_mm, double height_mm, double corner_radius_mm) {
  constexpr int kPointsPerCorner = 10;
  const double x = width_mm / 2 - corner_radius_mm;
  const double y = height_mm / 2 - corner_radius_mm;
  const std::vector<Vec2> centers = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
  Polyline points;
  for (int corner = 0; corner < 4; ++corner) {
    const double start = corner * kPi / 2;
    for (const double angle : Linspace(start, start + kPi / 2, kPointsPerCorner)) {
      points.emplace_back(centers[corner].x() + corner_radius_mm * std::cos(angle),
                          centers[corner].y() + corner_radius_mm * std::sin(angle), 0);
    }
  }
  return points;
}

std::vector<double> Linspace(double first, double last, int count) {
  std::vector<double> values(count);
  for (int i = 0; i < count; ++i) values[i] = first + (last - first) * i / (count - 1);
  return values;
}

Polyline PeriodicSpline(const std::vector<Vec2>& knots, int count) {
  const int n = static_cast<int>(knots.size());
  std::vector<double> steps(n);
  std::vector<double> starts(n + 1, 0.0);
  for (int i = 0; i < n; ++i) {
    steps[i] = (knots[(i + 1) % n] - knots[i]).norm();
    starts[i + 1] = starts[i] + steps[i];
  }
  const Eigen::MatrixX2d moments = SplineMoments(knots, steps);
  Polyline points;
  for (int k = 0; k < count; ++k) {
    const double parameter = starts[n] * k / count;
    const int i = static_cast<int>(std::upper_bound(starts.begin(), starts.end(), parameter) -
                                   starts.begin()) -
                  1;
    const int j = (i + 1) % n;
    const double a = (starts[i + 1] - parameter) / steps[i];
    const double b = 1 - a;
    const double h = steps[i] * steps[i] / 6;
    const Vec2 bend = h * ((a * a * a - a) * moments.row(i) + (b * b * b - b) * moments.row(j));
    const Vec2 point = a * knots[i] + b * knots[j] + bend;
    points.emplace_back(point.x(), point.y(), 0);
  }
  return points;
}

}  // namespace curvefusion
