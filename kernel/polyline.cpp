#include "kernel/polyline.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvefusion {

double Length(const Polyline& points) {
  double length = 0;
  for (size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

std::vector<double> CumulativeLength(const Polyline& points) {
  std::vector<double> cumulative(points.size(), 0.0);
  for (size_t i = 1; i < points.size(); ++i) {
    cumulative[i] = cumulative[i - 1] + (points[i] - points[i - 1]).norm();
  }
  return cumulative;
}

Polyline Resample(const Polyline& points, double step) {
  const std::vector<double> cumulative = CumulativeLength(points);
  if (points.size() < 2 || cumulative.back() <= 0) return points;
  const int segments = std::max(1, static_cast<int>(std::lround(cumulative.back() / step)));
  Polyline resampled;
  resampled.reserve(segments + 1);
  resampled.push_back(points.front());
  for (int i = 1; i < segments; ++i) {
    resampled.push_back(PointAt(points, cumulative, cumulative.back() * i / segments));
  }
  resampled.push_back(points.back());
  return resampled;
}

double ClosestParameter(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 d = b - a;
  const double squared_length = d.squaredNorm();
  if (squared_length <= 0) return 0;
  return std::clamp(d.dot(p - a) / squared_length, 0.0, 1.0);
}

PolylineProjection Project(const Polyline& points, const Vec3& p) {
  PolylineProjection nearest{0, std::numeric_limits<double>::infinity()};
  if (points.size() == 1) nearest.distance = (p - points[0]).norm();
  double arc_length = 0;
  for (size_t i = 1; i < points.size(); ++i) {
    const Vec3 d = points[i] - points[i - 1];
    const double t = ClosestParameter(points[i - 1], points[i], p);
    const double distance = (points[i - 1] + t * d - p).norm();
    const double segment_length = d.norm();
    if (distance < nearest.distance) nearest = {arc_length + t * segment_length, distance};
    arc_length += segment_length;
  }
  return nearest;
}

Vec3 PointAt(const Polyline& points, const std::vector<double>& cumulative_length,
             double arc_length) {
  if (arc_length <= 0) return points.front();
  if (arc_length >= cumulative_length.back()) return points.back();
  const auto next =
      std::upper_bound(cumulative_length.begin(), cumulative_length.end(), arc_length);
  const size_t i = static_cast<size_t>(next - cumulative_length.begin());
  const double t =
      (arc_length - cumulative_length[i - 1]) / (cumulative_length[i] - cumulative_length[i - 1]);
  return points[i - 1] + t * (points[i] - points[i - 1]);
}

std::vector<Vec3> Tangents(const Polyline& points) {
  std::vector<Vec3> tangents(points.size(), Vec3::Zero());
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3& before = points[i > 0 ? i - 1 : i];
    const Vec3& after = points[std::min(i + 1, points.size() - 1)];
    const double length = (after - before).norm();
    if (length > 0) tangents[i] = (after - before) / length;
  }
  return tangents;
}

}  // namespace curvefusion
