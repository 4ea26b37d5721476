#include "fusion/curve_graph/viewed_region.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/frame_stream.h"
#include "fusion/curve_graph/strip_views.h"

namespace curvefusion {

namespace {

constexpr int kCameras = 40;      // chosen: evenly spread ones; half of them is not decided by one
constexpr double kMost = 0.5;     // chosen: a camera moved around an object sees it in every image
constexpr double kNearest = 0.1;  // metres; chosen: scans are taken from .3 m and more
constexpr double kWidestWire = 0.012;  // metres, CurveFusion 5
constexpr double kNarrowestPx = 4;     // chosen: strips that differ from both sides 3 pixels away
constexpr double kLeastAngle = 0.05;   // radians; chosen: places are then known to a twentieth
constexpr int kDistances = 24;         // chosen: steps of a seventh
constexpr int kAcross = 12;            // chosen: lines of sight across an image

std::vector<RigidTransform> ColorCameras(const Sequence& sequence) {
  std::vector<RigidTransform> T_color_world;
  for (const int i : EvenlyThinned(AllFrames(sequence), kCameras))
    T_color_world.push_back(sequence.T_color_world(i));
  return T_color_world;
}

// The farthest place at which wires are looked for, metres.
double Farthest(const PinholeCamera& camera, const std::vector<RigidTransform>& T_color_world) {
  Eigen::AlignedBox3d path;
  for (const RigidTransform& T : T_color_world) path.extend(Vec3(T.inverse().translation()));
  const double extent = path.diagonal().norm();
  return std::min(camera.fx * kWidestWire / kNarrowestPx, extent / kLeastAngle);
}

bool Sees(const PinholeCamera& camera, const RigidTransform& T_color_world, double farthest,
          const Vec3& p) {
  const Vec3 p_color = T_color_world * p;
  if (p_color.z() < kNearest || p_color.z() > farthest) return false;
  return camera.Contains(camera.Project(p_color));
}

}  // namespace

Eigen::AlignedBox3d RegionSeenByMost(const Sequence& sequence) {
  const PinholeCamera camera = StripViews::CameraLookedThrough(sequence.color_camera);
  const std::vector<RigidTransform> T_color_world = ColorCameras(sequence);
  const double farthest = Farthest(camera, T_color_world);
  Eigen::AlignedBox3d region;
  if (farthest <= kNearest) return region;
  const double step = static_cast<double>(camera.width) / kAcross;
  const double ratio = std::pow(farthest / kNearest, 1.0 / kDistances);
  for (const RigidTransform& T : T_color_world) {
    const RigidTransform T_world_color = T.inverse();
    for (double v = step / 2; v < camera.height; v += step) {
      for (double u = step / 2; u < camera.width; u += step) {
        double distance = kNearest;
        for (int i = 0; i <= kDistances; ++i, distance *= ratio) {
          const Vec3 p = T_world_color * camera.Unproject(u, v, distance);
          const auto seen = std::count_if(
              T_color_world.begin(), T_color_world.end(),
              [&](const RigidTransform& other) { return Sees(camera, other, farthest, p); });
          if (static_cast<double>(seen) >= kMost * static_cast<double>(T_color_world.size()))
            region.extend(p);
        }
      }
    }
  }
  return region;
}

}  // namespace curvefusion
