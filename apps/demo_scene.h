#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/camera.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// The wires of the demo: a cube frame with a ring in its front face, 12 junctions and 7 cycles.
inline constexpr double kDemoWireRadius = 0.0025;  // metres

/// A straight piece of wire with round ends.
struct Capsule {
  Vec3 a;
  Vec3 b;
  double radius = kDemoWireRadius;
};

/// What the demo camera looks at: wires 80 mm above a table, a box and a wall behind them. World
/// frame: z up, the table top at z = 0, the wall at positive y.
struct DemoScene {
  std::vector<Capsule> wires;
};
DemoScene MakeDemoScene();

/// The pose of one of `frame_count` frames on the camera's way around the front of the scene.
RigidTransform DemoCameraPose(int frame, int frame_count);

/// One frame as a structured-light camera gives it: depth noise that grows with the distance
/// squared and comes in steps of disparity, pixels missing along silhouettes.
struct DemoFrame {
  DepthImage depth;
  ColorImage color;
};

/// Ray-casts a frame. The same scene, pose and frame number give the same bits for any number of
/// threads: noise is a hash of frame number and pixel.
DemoFrame RenderDemoFrame(const DemoScene& scene, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera, int frame);

}  // namespace curvefusion
