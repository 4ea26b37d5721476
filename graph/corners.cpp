#include "graph/corners.h"

#include <cmath>
#include <vector>

namespace curvefusion {

namespace {

constexpr double kReach = 10 * kMillimetre;  // along the curve to either side; chosen

}  // namespace

std::optional<size_t> SharpestCorner(const Polyline& points, double min_turn) {
  const std::vector<double> arc_lengths = CumulativeLength(points);
  std::optional<size_t> sharpest;
  double least = std::cos(min_turn);
  for (size_t i = 0; i < points.size(); ++i) {
    const double place = arc_lengths[i];
    if (place < kReach || place > arc_lengths.back() - kReach) continue;
    const Vec3 before = points[i] - PointAt(points, arc_lengths, place - kReach);
    const Vec3 after = PointAt(points, arc_lengths, place + kReach) - points[i];
    const double cosine = before.normalized().dot(after.normalized());
    if (cosine >= least) continue;
    least = cosine;
    sharpest = i;
  }
  return sharpest;
}

}  // namespace curvefusion
