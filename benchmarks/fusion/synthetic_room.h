#pragma once

#include "tests/fusion/analytic_depth.h"

namespace curvefusion {

/// What the benchmarks scan: a wall and a floor, a box, a ball and a fence of wires, by a camera
/// that swings around them.
constexpr int kFrames = 12;

inline DepthAlongRay Room() {
  DepthAlongRay room = Union(Plane(Vec3::UnitZ(), 1.8), Plane(Vec3::UnitY(), 0.6));
  room = Union(room, Box({-0.5, 0.2, 1.1}, {-0.1, 0.6, 1.5}));
  room = Union(room, Sphere({0.35, 0.35, 1.2}, 0.25));
  for (int i = 0; i < 6; ++i) {
    const double x = -0.5 + 0.2 * i;
    room = Union(room, Box({x, -0.5, 0.8}, {x + 0.005, 0.5, 0.805}));
  }
  return room;
}

inline RigidTransform PoseOfFrame(int frame) {
  const double angle = 0.5 * frame / kFrames - 0.25;
  return LookAt(Vec3(1.4 * std::sin(angle), -0.1, 1.2 - 1.4 * std::cos(angle)), {0, 0.1, 1.2});
}

}  // namespace curvefusion
