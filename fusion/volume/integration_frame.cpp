#include "fusion/volume/integration_frame.h"

#include <algorithm>

namespace curvefusion {

namespace {

/// Pixels along the side of a tile of the pyramid's level 0. Chosen for speed, changes no result.
constexpr int kFinestTile = 4;

DepthImage PadValidDepth(const DepthImage& depth, double max_depth) {
  DepthImage padded(depth.width() + 2, depth.height() + 2, 0);
  const float limit = static_cast<float>(max_depth);
  for (int v = 0; v < depth.height(); ++v) {
    const float* from = depth.row(v);
    float* to = padded.row(v + 1) + 1;
    // NaN compares false and so becomes 0, too.
    for (int u = 0; u < depth.width(); ++u) to[u] = from[u] > 0 && from[u] <= limit ? from[u] : 0;
  }
  return padded;
}

DepthImage TileMaxima(const DepthImage& padded) {
  const int width = padded.width() - 2, height = padded.height() - 2;
  DepthImage maxima((width + kFinestTile - 1) / kFinestTile,
                    (height + kFinestTile - 1) / kFinestTile, 0);
  for (int v = 0; v < height; ++v) {
    const float* row = padded.row(v + 1) + 1;
    float* tiles = maxima.row(v / kFinestTile);
    for (int u = 0; u < width; ++u) {
      tiles[u / kFinestTile] = std::max(tiles[u / kFinestTile], row[u]);
    }
  }
  return maxima;
}

DepthImage HalvedByMaximum(const DepthImage& fine) {
  DepthImage coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2, 0);
  for (int v = 0; v < fine.height(); ++v) {
    for (int u = 0; u < fine.width(); ++u) {
      coarse(u / 2, v / 2) = std::max(coarse(u / 2, v / 2), fine(u, v));
    }
  }
  return coarse;
}

}  // namespace

IntegrationFrame::IntegrationFrame(const DepthImage& depth, const PinholeCamera& camera,
                                   const RigidTransform& T_world_camera, double max_depth)
    : camera_(camera),
      T_world_camera_(T_world_camera),
      T_camera_world_(T_world_camera.inverse()),
      padded_(PadValidDepth(depth, max_depth)) {
  max_pyramid_.push_back(TileMaxima(padded_));
  while (max_pyramid_.back().size() > 1) {
    max_pyramid_.push_back(HalvedByMaximum(max_pyramid_.back()));
  }
}

float IntegrationFrame::MaxDepthWithin(double u_min, double v_min, double u_max,
                                       double v_max) const {
  if (u_max < -0.5 || v_max < -0.5 || u_min > camera_.width - 0.5 || v_min > camera_.height - 0.5) {
    return 0;
  }
  int u0 = static_cast<int>(std::clamp(u_min, 0.0, camera_.width - 1.0)) / kFinestTile;
  int u1 = static_cast<int>(std::clamp(u_max + 0.5, 0.0, camera_.width - 1.0)) / kFinestTile;
  int v0 = static_cast<int>(std::clamp(v_min, 0.0, camera_.height - 1.0)) / kFinestTile;
  int v1 = static_cast<int>(std::clamp(v_max + 0.5, 0.0, camera_.height - 1.0)) / kFinestTile;
  size_t level = 0;
  for (; level + 1 < max_pyramid_.size() && std::max(u1 - u0, v1 - v0) > 3; ++level) {
    u0 /= 2, u1 /= 2, v0 /= 2, v1 /= 2;
  }
  float maximum = 0;
  for (int v = v0; v <= v1; ++v) {
    for (int u = u0; u <= u1; ++u) maximum = std::max(maximum, max_pyramid_[level](u, v));
  }
  return maximum;
}

}  // namespace curvefusion
