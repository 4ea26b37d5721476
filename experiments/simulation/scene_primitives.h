#pragma once

#include <limits>
#include <vector>

#include "experiments/simulation/scene.h"

namespace curvefusion {

// Rays against the primitives of a scene. A ray is origin + t direction; the functions return t of
// its first crossing, kNoHit where there is none. What begins inside a primitive has no meaning.

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// What rays from one origin against one capsule have in common.
struct CapsuleSeen {
  CapsuleSeen(const SceneCapsule& capsule, const Vec3& origin);

  Vec3 axis;        // from its start to its end
  Vec3 from_start;  // to the origin, as from_end
  Vec3 from_end;
  double axis_axis;
  double axis_from_start;
  double start_c;  // constant terms of the quadratic equations of its half-balls and its cylinder
  double end_c;
  double cylinder_c;
};

double HitCapsule(const CapsuleSeen& capsule, const Vec3& direction);
double HitPlane(const ScenePlane& plane, const Vec3& origin, const Vec3& direction);
double HitBox(const SceneBox& box, const Vec3& origin, const Vec3& direction);

/// Outward unit normal at a point of the surface.
Vec3 CapsuleNormal(const SceneCapsule& capsule, const Vec3& p);
Vec3 BoxNormal(const SceneBox& box, const Vec3& p);

/// The eight corners of a box.
std::vector<Vec3> Corners(const SceneBox& box);

}  // namespace curvefusion
