#include "fusion/tracking/model_view.h"

#include <cmath>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr int kBandRows = 16;  // of an image, for a thread at a time; chosen, changes no result
// Depth gained per metre sideways. Chosen: tan 80 degrees; what is steeper is an edge between
// surfaces.
constexpr float kMaxSlope = 5.67f;

// Whether two neighbouring pixels' points may be of one surface.
bool IsOneSurface(const Vec3f& a, const Vec3f& b, float pixel_size) {
  return a.z() > 0 && b.z() > 0 &&
         std::abs(a.z() - b.z()) < 2 * kMaxSlope * pixel_size * std::min(a.z(), b.z());
}

Vec3f NormalAt(const Image<Vec3f>& points, int u, int v, float pixel_size) {
  const Vec3f& left = points(u - 1, v);
  const Vec3f& right = points(u + 1, v);
  const Vec3f& up = points(u, v - 1);
  const Vec3f& down = points(u, v + 1);
  if (!IsOneSurface(left, right, pixel_size) || !IsOneSurface(up, down, pixel_size)) {
    return Vec3f::Zero();
  }
  return (down - up).cross(right - left).normalized();
}

ModelLevel Halved(const ModelLevel& fine) {
  return {EveryNth(fine.camera, 2), EverySecond(fine.points), EverySecond(fine.normals)};
}

}  // namespace

ModelLevel PointsAndNormals(const DepthImage& depth, const PinholeCamera& camera) {
  ModelLevel level;
  level.camera = camera;
  level.points = Image<Vec3f>(depth.width(), depth.height(), Vec3f::Zero());
  level.normals = Image<Vec3f>(depth.width(), depth.height(), Vec3f::Zero());
  ParallelFor(0, depth.height(), kBandRows, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < depth.width(); ++u) {
      const float z = depth(u, v);
      if (z > 0) level.points(u, v) = camera.Unproject(u, v, z).cast<float>();
    }
  });
  const auto pixel_size = static_cast<float>(1 / camera.fx);
  ParallelFor(1, depth.height() - 1, kBandRows, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 1; u + 1 < depth.width(); ++u) {
      if (depth(u, v) > 0) level.normals(u, v) = NormalAt(level.points, u, v, pixel_size);
    }
  });
  return level;
}

ModelView RenderModel(const TsdfVolume& volume, const PinholeCamera& camera,
                      const RigidTransform& T_world_camera) {
  ModelView view;
  view.T_world_model = T_world_camera;
  view.levels.push_back(PointsAndNormals(volume.Raycast(camera, T_world_camera), camera));
  for (int i = 1; i < kTrackingLevels; ++i) view.levels.push_back(Halved(view.levels.back()));
  return view;
}

}  // namespace curvefusion
