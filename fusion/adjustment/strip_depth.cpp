#include "fusion/adjustment/strip_depth.h"

#include <algorithm>
#include <cmath>

namespace curvefusion {

namespace {

// Chosen: depth reaches beyond a strip by what block matching fattens wires, and by the shift of
// colours.
constexpr double kStep = 0.5;          // pixels across the strip
constexpr double kOutlineReachPx = 7;  // block matching fattens wires by up to 4 px on a side
constexpr double kFreePx = 5;          // wires nearer to one another are fattened together

float DepthAt(const DepthImage& depth, const Vec2& pixel) {
  const int u = static_cast<int>(std::lround(pixel.x()));
  const int v = static_cast<int>(std::lround(pixel.y()));
  return depth.Contains(u, v) ? depth(u, v) : 0;
}

bool IsOfWire(float z, const StripPlace& place, double reach) {
  return z > 0 && std::abs(z - place.depth) <= reach;
}

// How far the wire reaches in the direction of `outwards` (unit).
std::optional<double> FindEdge(const DepthImage& depth, const StripPlace& place,
                               const Vec2& outwards, double reach) {
  const auto depth_at = [&](double px) { return DepthAt(depth, place.pixel + px * outwards); };
  const double limit_px = place.half_width_px + kOutlineReachPx;
  double end_px = 0;
  while (end_px <= limit_px && IsOfWire(depth_at(end_px), place, reach)) end_px += kStep;
  if (end_px > limit_px) return std::nullopt;
  for (double free_px = 0; free_px < kFreePx; free_px += kStep) {
    const float z = depth_at(end_px + free_px);
    if (z > 0 && z < place.depth + reach) return std::nullopt;
  }
  return end_px - 0.5 * kStep;
}

}  // namespace

StripDepth MeasureStripDepth(const DepthImage& depth, const StripPlace& place, double reach) {
  StripDepth found;
  double sum = 0;
  int count = 0;
  const int half_count = std::max(1, static_cast<int>(place.half_width_px / kStep));
  for (int i = -half_count; i <= half_count; ++i) {
    const float z = DepthAt(depth, place.pixel + i * kStep * place.normal);
    if (!IsOfWire(z, place, reach)) continue;
    sum += z;
    ++count;
  }
  if (count == 0) return found;
  found.measured = true;
  found.depth = sum / count;
  found.edges_px = {FindEdge(depth, place, -place.normal, reach),
                    FindEdge(depth, place, place.normal, reach)};
  return found;
}

}  // namespace curvefusion
