#include "experiments/simulation/scene_primitives.h"

#include <algorithm>
#include <cmath>

namespace curvefusion {
namespace {

double HitCuboid(const SceneBox& box, const Vec3& o, const Vec3& d) {
  double enter = -kNoHit;
  double leave = kNoHit;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / d[axis];
    const double near = (-box.half_size[axis] - o[axis]) * inverse;
    const double far = (box.half_size[axis] - o[axis]) * inverse;
    enter = std::max(enter, std::min(near, far));
    leave = std::min(leave, std::max(near, far));
  }
  return enter <= leave ? enter : kNoHit;
}

double HitEllipsoid(const SceneBox& box, const Vec3& origin, const Vec3& direction) {
  const Vec3 o = origin.cwiseQuotient(box.half_size);
  const Vec3 d = direction.cwiseQuotient(box.half_size);
  const double a = d.squaredNorm();
  const double half_b = o.dot(d);
  const double discriminant = half_b * half_b - a * (o.squaredNorm() - 1);
  return discriminant < 0 ? kNoHit : (-half_b - std::sqrt(discriminant)) / a;
}

// Where a ray enters and leaves an infinite cylinder about z; nothing but kNoHit where it does not.
struct Chord {
  double enter = kNoHit;
  double leave = kNoHit;
};

Chord ThroughCylinder(double radius, const Vec3& o, const Vec3& d) {
  const double a = d.head<2>().squaredNorm();
  const double half_b = o.head<2>().dot(d.head<2>());
  const double discriminant = half_b * half_b - a * (o.head<2>().squaredNorm() - radius * radius);
  if (a == 0 || discriminant < 0) return {};
  const double root = std::sqrt(discriminant);
  return {(-half_b - root) / a, (-half_b + root) / a};
}

// Mantle, rim or lid, and through the mouth the inside of the wall and the floor.
double HitCylinder(const SceneBox& box, const Vec3& o, const Vec3& d) {
  const double radius = box.half_size.x();
  const double half = box.half_size.z();
  const double inner = box.wall > 0 ? radius - box.wall : 0;
  const double floor = -half + box.wall;
  double first = kNoHit;
  const auto consider = [&](double t, double low, double high) {
    const double z = o.z() + t * d.z();
    if (t < first && z >= low && z <= high) first = t;
  };
  const auto consider_disc = [&](double z, double from, double to) {
    const double t = (z - o.z()) / d.z();
    const double r = (o + t * d).head<2>().norm();
    if (t < first && r >= from && r <= to) first = t;
  };
  consider(ThroughCylinder(radius, o, d).enter, -half, half);
  if (d.z() < 0) consider_disc(half, inner, radius);
  if (d.z() > 0) consider_disc(-half, 0, radius);
  if (inner > 0) {
    consider(ThroughCylinder(inner, o, d).leave, floor, half);
    if (d.z() < 0) consider_disc(floor, 0, inner);
  }
  return first;
}

// At a point of the cylinder's surface: of whichever part of it is nearest.
Vec3 CylinderNormal(const SceneBox& box, const Vec3& p) {
  const double r = p.head<2>().norm();
  const Vec3 out(p.x() / r, p.y() / r, 0);
  const double inner = box.wall > 0 ? box.half_size.x() - box.wall : -1;
  const double half = box.half_size.z();
  double nearest = std::abs(box.half_size.x() - r);
  Vec3 normal = out;
  const auto consider = [&](double distance, const Vec3& candidate) {
    if (distance < nearest) normal = candidate;
    nearest = std::min(nearest, distance);
  };
  consider(std::abs(half - p.z()), Vec3::UnitZ());
  consider(std::abs(half + p.z()), -Vec3::UnitZ());
  if (inner > 0) {
    consider(std::abs(inner - r), -out);
    if (r < inner) consider(std::abs(p.z() + half - box.wall), Vec3::UnitZ());
  }
  return normal;
}

}  // namespace

CapsuleSeen::CapsuleSeen(const SceneCapsule& capsule, const Vec3& origin)
    : axis(capsule.end - capsule.start),
      from_start(origin - capsule.start),
      from_end(origin - capsule.end),
      axis_axis(axis.squaredNorm()),
      axis_from_start(axis.dot(from_start)),
      start_c(from_start.squaredNorm() - capsule.radius * capsule.radius),
      end_c(from_end.squaredNorm() - capsule.radius * capsule.radius),
      cylinder_c(axis_axis * start_c - axis_from_start * axis_from_start) {}

BoxSeen::BoxSeen(const SceneBox& seen, const Vec3& from)
    : box(&seen), origin(seen.rotation.transpose() * (from - seen.center)) {}

double HitBox(const BoxSeen& seen, const Vec3& direction) {
  const SceneBox& box = *seen.box;
  const Vec3& o = seen.origin;
  const Vec3 d = box.rotation.transpose() * direction;
  if (box.shape == BoxShape::kEllipsoid) return HitEllipsoid(box, o, d);
  return box.shape == BoxShape::kBox ? HitCuboid(box, o, d) : HitCylinder(box, o, d);
}

Vec3 CapsuleNormal(const SceneCapsule& capsule, const Vec3& p) {
  const Vec3 axis = capsule.end - capsule.start;
  const double along = (p - capsule.start).dot(axis) / axis.squaredNorm();
  return (p - capsule.start - std::clamp(along, 0.0, 1.0) * axis).normalized();
}

Vec3 BoxNormal(const SceneBox& box, const Vec3& p_world) {
  const Vec3 p = box.rotation.transpose() * (p_world - box.center);
  if (box.shape == BoxShape::kCylinder) return box.rotation * CylinderNormal(box, p);
  const Vec3 share = p.cwiseQuotient(box.half_size);
  if (box.shape == BoxShape::kEllipsoid) {
    return box.rotation * share.cwiseQuotient(box.half_size).normalized();
  }
  int axis = 0;
  share.cwiseAbs().maxCoeff(&axis);
  return box.rotation.col(axis) * (share[axis] > 0 ? 1 : -1);
}

std::vector<Vec3> Corners(const SceneBox& box) {
  std::vector<Vec3> corners;
  for (int k = 0; k < 8; ++k) {
    const Vec3 sign(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
    corners.push_back(box.center + box.rotation * sign.cwiseProduct(box.half_size));
  }
  return corners;
}

}  // namespace curvefusion
