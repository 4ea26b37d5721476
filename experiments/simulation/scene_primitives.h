#pragma once

#include <cmath>
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

// The capsule lies inside its infinite cylinder, so a ray that misses the cylinder misses all.
inline double HitCapsule(const CapsuleSeen& capsule, const Vec3& direction) {
  const double axis_direction = capsule.axis.dot(direction);
  const double direction_direction = direction.squaredNorm();
  const double a = capsule.axis_axis * direction_direction - axis_direction * axis_direction;
  const double b = capsule.axis_axis * direction.dot(capsule.from_start) -
                   capsule.axis_from_start * axis_direction;
  const double discriminant = b * b - a * capsule.cylinder_c;
  if (discriminant < 0) return kNoHit;
  double along = capsule.axis_from_start;
  if (a > 0) {
    const double t = (-b - std::sqrt(discriminant)) / a;
    along = capsule.axis_from_start + t * axis_direction;
    if (along > 0 && along < capsule.axis_axis) return t;
  }
  const bool starts = along <= 0;
  const double half_b = direction.dot(starts ? capsule.from_start : capsule.from_end);
  const double ball =
      half_b * half_b - direction_direction * (starts ? capsule.start_c : capsule.end_c);
  return ball < 0 ? kNoHit : (-half_b - std::sqrt(ball)) / direction_direction;
}

inline double HitPlane(const ScenePlane& plane, const Vec3& origin, const Vec3& direction) {
  const double approach = plane.normal.dot(direction);
  return approach < 0 ? (plane.offset - plane.normal.dot(origin)) / approach : kNoHit;
}

/// A box and where rays begin, in its own axes.
struct BoxSeen {
  BoxSeen(const SceneBox& box, const Vec3& origin);

  const SceneBox* box;
  Vec3 origin;
};

double HitBox(const BoxSeen& seen, const Vec3& direction);

/// Outward unit normal at a point of the surface.
Vec3 CapsuleNormal(const SceneCapsule& capsule, const Vec3& p);
Vec3 BoxNormal(const SceneBox& box, const Vec3& p);

/// The eight corners of a box.
std::vector<Vec3> Corners(const SceneBox& box);

}  // namespace curvefusion
