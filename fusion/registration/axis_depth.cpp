#include "fusion/registration/axis_depth.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace curvefusion {

namespace {

constexpr double kStep = 0.5;          // pixels across the strip
constexpr double kOutlineReachPx = 7;  // block matching fattens wires by up to 4 px on a side
constexpr double kMaxOffsetPx = 2;     // from the shift found before, in the second fit
constexpr double kMinOutlines = 50;    // that count in a direction

float DepthAt(const DepthImage& depth, const Vec2& pixel) {
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  return depth.Contains(u, v) ? depth(u, v) : 0;
}

// The run of pixels of the wire around the strip's centre; outlined where it ends on both sides.
void FindOutline(const DepthImage& depth, const StripPlace& place, double reach,
                 StripDepth& found) {
  const double limit_px = place.half_width_px + kOutlineReachPx;
  if (place.clearance_px < 2 * limit_px) return;
  double ends[2];
  for (const int side : {-1, 1}) {
    double offset_px = 0;
    while (offset_px <= limit_px) {
      const float z = DepthAt(depth, place.pixel + side * offset_px * place.normal);
      if (!(z > 0 && std::abs(z - place.depth) <= reach)) break;
      offset_px += kStep;
    }
    if (offset_px > limit_px) return;
    ends[side > 0] = side * (offset_px - 0.5 * kStep);
  }
  found.outlined = true;
  found.offset_px = 0.5 * (ends[0] + ends[1]);
}

}  // namespace

StripDepth MeasureStripDepth(const DepthImage& depth, const StripPlace& place, double reach) {
  StripDepth found;
  double sum = 0;
  int count = 0;
  const int half_count = std::max(1, static_cast<int>(place.half_width_px / kStep));
  for (int i = -half_count; i <= half_count; ++i) {
    const float z = DepthAt(depth, place.pixel + i * kStep * place.normal);
    if (!(z > 0 && std::abs(z - place.depth) <= reach)) continue;
    sum += z;
    ++count;
  }
  if (count == 0) return found;
  found.measured = true;
  found.depth = sum / count;
  FindOutline(depth, place, reach, found);
  return found;
}

Vec2 EstimateColorShift(const std::vector<Vec2>& normals, const std::vector<double>& offsets_px) {
  assert(normals.size() == offsets_px.size());
  Vec2 shift = Vec2::Zero();
  for (int round = 0; round < 3; ++round) {
    Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
    Vec2 rhs = Vec2::Zero();
    for (size_t i = 0; i < normals.size(); ++i) {
      if (round > 0 && std::abs(offsets_px[i] - normals[i].dot(shift)) > kMaxOffsetPx) continue;
      matrix += normals[i] * normals[i].transpose();
      rhs += offsets_px[i] * normals[i];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(matrix);
    if (solver.eigenvalues()[0] < kMinOutlines) return Vec2::Zero();
    shift = solver.eigenvectors() *
            (solver.eigenvectors().transpose() * rhs).cwiseQuotient(solver.eigenvalues());
  }
  return shift;
}

}  // namespace curvefusion
