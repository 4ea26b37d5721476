#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "capture/sequence.h"

namespace curvefusion {

/// What colour images show of a layered scene.
enum class SceneColour { kRegistered, kConstant, kNoise };

/// Rectangles at random places, `nearest` to `farthest` metres away, before a wall at 2.2 m, other
/// ones in every frame, as 320x240 images; the grey level of each surface is its own.
/// `color_camera` sees the colours, from `offset` (metres, T_color_depth's translation); the
/// intrinsics say that it is the depth camera.
struct LayeredScene {
  int frames = 12;
  double nearest = 0.6;
  double farthest = 1.6;
  PinholeCamera depth_camera = {320, 240, 290, 290, 159.5, 119.5};
  PinholeCamera color_camera = depth_camera;
  Vec3 offset = Vec3::Zero();
  SceneColour colour = SceneColour::kRegistered;
};

/// Writes the scene as one pose a frame, the camera moving along x by 20 mm a frame.
void WriteLayeredScene(const LayeredScene& scene, const std::filesystem::path& folder);

}  // namespace curvefusion
