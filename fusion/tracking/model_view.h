#pragma once

#include <vector>

#include "fusion/tracking/frame_pyramid.h"
#include "fusion/volume/tsdf_volume.h"

namespace curvefusion {

/// What the model shows a camera, at one resolution: points and normals in that camera's frame. A
/// point without a normal has z = 0.
struct ModelLevel {
  PinholeCamera camera;
  Image<Vec3f> points;
  Image<Vec3f> normals;
};

/// A view of the model, the finest level first.
struct ModelView {
  RigidTransform T_world_model = RigidTransform::Identity();  ///< of the camera it was drawn for
  std::vector<ModelLevel> levels;
};

/// Points and normals of a depth image: central differences of points that are on one surface (not
/// farther apart in depth than a surface seen at 80 degrees).
ModelLevel PointsAndNormals(const DepthImage& depth, const PinholeCamera& camera);

/// Raycasts the volume for the camera of a frame's finest level (Newcombe et al. 2011).
ModelView RenderModel(const TsdfVolume& volume, const PinholeCamera& camera,
                      const RigidTransform& T_world_camera);

}  // namespace curvefusion
