#include "apps/demo_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernel/parallel.h"

namespace curvefusion {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCubeSide = 0.2;
constexpr double kCubeFloor = 0.08;  // height of the lowest wires above the table
constexpr double kRingRadius = 0.06;
constexpr int kRingSegments = 32;
constexpr double kWallY = 0.45;
constexpr double kBaseline = 0.075;          // camera to projector, Kinect V1
constexpr double kDisparityStep_px = 0.125;  // Kinect V1
constexpr double kAxialNoise = 1.4e-3;       // sigma = 1.4 mm z^2 (Khoshelham 2012)
constexpr double kLateralNoise_px = 0.3;
constexpr double kSilhouetteStep = 0.02;  // metres between two neighbouring pixels
constexpr double kSilhouetteLoss = 0.25;  // share of the pixels lost there
constexpr int kTile_px = 16;

const Vec3 kBoxMin(0.18, 0.12, 0.0);
const Vec3 kBoxMax(0.36, 0.30, 0.14);

struct Ray {
  Vec3 origin;
  Vec3 direction;  // of length such that the parameter of a hit is its depth
};

struct Hit {
  double depth = std::numeric_limits<double>::infinity();
  Vec3 normal = Vec3::Zero();
  Vec3 albedo = Vec3::Zero();
};

// A well-mixed hash (the finaliser of splitmix64).
uint64_t Mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// Uniform in [0, 1).
double Uniform(uint64_t key) { return static_cast<double>(Mix(key) >> 11) * 0x1.0p-53; }

// Standard normal, by Box and Muller.
double Gaussian(uint64_t key) {
  const double radius = std::sqrt(-2 * std::log(1 - Uniform(2 * key)));
  return radius * std::cos(2 * kPi * Uniform(2 * key + 1));
}

// Blotches of 8 mm, so that colour images have edges that are not wires.
Vec3 Textured(const Vec3& albedo, const Vec3& p, double contrast) {
  uint64_t key = 7;
  for (int axis = 0; axis < 3; ++axis) {
    key = Mix(key ^ static_cast<uint64_t>(std::floor(p[axis] / 0.008 + 0.01)));
  }
  return albedo * (1 + contrast * (Uniform(key) - 0.5));
}

void HitPlane(const Ray& ray, int axis, double at, const Vec3& albedo, Hit& hit) {
  const double depth = (at - ray.origin[axis]) / ray.direction[axis];
  if (!(depth > 0) || depth >= hit.depth) return;
  const Vec3 normal = (ray.direction[axis] > 0 ? -1.0 : 1.0) * Vec3::Unit(axis);
  hit = {depth, normal, Textured(albedo, ray.origin + depth * ray.direction, 0.15)};
}

void HitBox(const Ray& ray, Hit& hit) {
  double enter = 0;
  double leave = std::numeric_limits<double>::infinity();
  int entered_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double near = (kBoxMin[axis] - ray.origin[axis]) / ray.direction[axis];
    double far = (kBoxMax[axis] - ray.origin[axis]) / ray.direction[axis];
    if (near > far) std::swap(near, far);
    if (near > enter) {
      enter = near;
      entered_axis = axis;
    }
    leave = std::min(leave, far);
  }
  if (enter >= leave || enter <= 0 || enter >= hit.depth) return;
  const double side = ray.direction[entered_axis] > 0 ? -1 : 1;
  hit = {enter, side * Vec3::Unit(entered_axis), Vec3(0.30, 0.45, 0.35)};
}

// The first point of a sphere, as a ray parameter; infinite where it is missed.
double SphereDepth(const Ray& ray, const Vec3& centre, double radius) {
  const Vec3 offset = ray.origin - centre;
  const double a = ray.direction.squaredNorm();
  const double b = ray.direction.dot(offset);
  const double discriminant = b * b - a * (offset.squaredNorm() - radius * radius);
  return discriminant < 0 ? std::numeric_limits<double>::infinity()
                          : (-b - std::sqrt(discriminant)) / a;
}

// The first point of a capsule: of its cylinder where it lies between the ends, else of a ball.
double CapsuleDepth(const Ray& ray, const Capsule& wire) {
  const Vec3 axis = wire.b - wire.a;
  const Vec3 offset = ray.origin - wire.a;
  const double axis2 = axis.squaredNorm();
  const double axis_direction = axis.dot(ray.direction);
  const double axis_offset = axis.dot(offset);
  const double a = axis2 * ray.direction.squaredNorm() - axis_direction * axis_direction;
  const double b = axis2 * ray.direction.dot(offset) - axis_offset * axis_direction;
  const double c =
      axis2 * (offset.squaredNorm() - wire.radius * wire.radius) - axis_offset * axis_offset;
  const double discriminant = b * b - a * c;
  if (discriminant < 0) return std::numeric_limits<double>::infinity();
  const double depth = (-b - std::sqrt(discriminant)) / a;
  const double along = axis_offset + depth * axis_direction;
  if (along > 0 && along < axis2) return depth;
  return SphereDepth(ray, along <= 0 ? wire.a : wire.b, wire.radius);
}

void HitWire(const Ray& ray, const Capsule& wire, Hit& hit) {
  const double depth = CapsuleDepth(ray, wire);
  if (!(depth > 0) || depth >= hit.depth) return;
  const Vec3 p = ray.origin + depth * ray.direction;
  const Vec3 axis = wire.b - wire.a;
  const double t = std::clamp((p - wire.a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  hit = {depth, (p - wire.a - t * axis).normalized(), Vec3(0.75, 0.25, 0.12)};
}

// Which wires may be seen in each tile of the image.
class TileIndex {
 public:
  TileIndex(const DemoScene& scene, const PinholeCamera& camera,
            const RigidTransform& T_camera_world)
      : columns_((camera.width + kTile_px - 1) / kTile_px),
        rows_((camera.height + kTile_px - 1) / kTile_px),
        wires_(static_cast<size_t>(columns_) * rows_) {
    for (size_t i = 0; i < scene.wires.size(); ++i) {
      Insert(static_cast<int>(i), scene.wires[i], camera, T_camera_world);
    }
  }

  const std::vector<int>& At(int u, int v) const {
    return wires_[static_cast<size_t>(v / kTile_px) * columns_ + u / kTile_px];
  }

 private:
  void Insert(int index, const Capsule& wire, const PinholeCamera& camera,
              const RigidTransform& T_camera_world) {
    const Vec3 a = T_camera_world * wire.a;
    const Vec3 b = T_camera_world * wire.b;
    const double margin_px = camera.fx * wire.radius / std::min(a.z(), b.z()) + 3;
    const Vec2 pixel_a = camera.Project(a);
    const Vec2 pixel_b = camera.Project(b);
    const Vec2 low = (pixel_a.cwiseMin(pixel_b).array() - margin_px) / kTile_px;
    const Vec2 high = (pixel_a.cwiseMax(pixel_b).array() + margin_px) / kTile_px;
    for (int y = std::max(0, static_cast<int>(low.y())); y < rows_ && y <= high.y(); ++y) {
      for (int x = std::max(0, static_cast<int>(low.x())); x < columns_ && x <= high.x(); ++x) {
        wires_[static_cast<size_t>(y) * columns_ + x].push_back(index);
      }
    }
  }

  int columns_;
  int rows_;
  std::vector<std::vector<int>> wires_;
};

Hit Trace(const DemoScene& scene, const std::vector<int>& wires, const Ray& ray) {
  Hit hit;
  HitPlane(ray, 2, 0, Vec3(0.62, 0.52, 0.40), hit);
  HitPlane(ray, 1, kWallY, Vec3(0.80, 0.80, 0.76), hit);
  HitBox(ray, hit);
  for (const int wire : wires) HitWire(ray, scene.wires[wire], hit);
  return hit;
}

Ray PixelRay(const PinholeCamera& camera, const RigidTransform& T_world_camera, double u,
             double v) {
  return {T_world_camera.translation(), T_world_camera.linear() * camera.Unproject(u, v, 1)};
}

Vec3 Shade(const Hit& hit) {
  const Vec3 light = Vec3(0.4, -0.7, 0.9).normalized();
  return hit.albedo * (0.45 + 0.55 * std::max(0.0, hit.normal.dot(light)));
}

uint8_t ToByte(double intensity, uint64_t key) {
  return static_cast<uint8_t>(std::clamp(255 * intensity + 2 * Gaussian(key), 0.0, 255.0));
}

// The noise-free measurement becomes one of the sensor's disparity steps.
float MeasuredDepth(double depth, const PinholeCamera& camera, uint64_t key) {
  if (!std::isfinite(depth)) return 0;
  const double noisy = depth + kAxialNoise * depth * depth * Gaussian(key);
  const double disparity_px = camera.fx * kBaseline / noisy;
  const double step = std::round(disparity_px / kDisparityStep_px) * kDisparityStep_px;
  return static_cast<float>(camera.fx * kBaseline / step);
}

bool OnSilhouette(const Image<double>& depth, int u, int v) {
  constexpr std::array<std::array<int, 2>, 4> kNeighbours = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  return std::any_of(kNeighbours.begin(), kNeighbours.end(), [&](const auto& step) {
    const int u2 = u + step[0];
    const int v2 = v + step[1];
    return depth.Contains(u2, v2) && std::abs(depth(u2, v2) - depth(u, v)) > kSilhouetteStep;
  });
}

void AddRing(const Vec3& centre, DemoScene& scene) {
  const auto at = [&](int i) {
    const double angle = 2 * kPi * i / kRingSegments;
    return Vec3(centre + kRingRadius * Vec3(std::cos(angle), 0, std::sin(angle)));
  };
  for (int i = 0; i < kRingSegments; ++i) scene.wires.push_back({at(i), at(i + 1)});
}

}  // namespace

DemoScene MakeDemoScene() {
  DemoScene scene;
  const double half = kCubeSide / 2;
  const Vec3 centre(0, 0, kCubeFloor + half);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double s : {-half, half}) {
      for (const double t : {-half, half}) {
        Vec3 a = Vec3::Constant(-half);
        a[(axis + 1) % 3] = s;
        a[(axis + 2) % 3] = t;
        Vec3 b = a;
        b[axis] = half;
        scene.wires.push_back({centre + a, centre + b});
      }
    }
  }
  const Vec3 front = centre - Vec3(0, half, 0);
  AddRing(front, scene);
  for (const double up : {-1.0, 1.0}) {
    scene.wires.push_back({front + Vec3(0, 0, up * kRingRadius), front + Vec3(0, 0, up * half)});
  }
  return scene;
}

RigidTransform DemoCameraPose(int frame, int frame_count) {
  const double t = frame_count > 1 ? static_cast<double>(frame) / (frame_count - 1) : 0.5;
  const double azimuth = (2 * t - 1) * 40 * kPi / 180;
  const double distance = 0.68 + 0.05 * std::sin(5 * t);
  const Vec3 target(0, 0, kCubeFloor + kCubeSide / 2);
  const Vec3 eye = target + Vec3(distance * std::sin(azimuth), -distance * std::cos(azimuth),
                                 0.17 + 0.10 * std::sin(2 * kPi * t));
  RigidTransform T_world_camera = RigidTransform::Identity();
  const Vec3 forward = (target - eye).normalized();
  const Vec3 right = forward.cross(Vec3::UnitZ()).normalized();
  T_world_camera.linear().col(0) = right;
  T_world_camera.linear().col(1) = forward.cross(right);
  T_world_camera.linear().col(2) = forward;
  T_world_camera.translation() = eye;
  return T_world_camera;
}

DemoFrame RenderDemoFrame(const DemoScene& scene, const PinholeCamera& camera,
                          const RigidTransform& T_world_camera, int frame) {
  const TileIndex tiles(scene, camera, T_world_camera.inverse());
  Image<double> depth(camera.width, camera.height);
  DemoFrame result{DepthImage(camera.width, camera.height),
                   ColorImage(camera.width, camera.height)};
  const auto key = [&](int u, int v, int purpose) {
    return ((static_cast<uint64_t>(frame) * camera.height + v) * camera.width + u) * 8 + purpose;
  };
  const auto trace = [&](int u, int v, double du, double dv) {
    return Trace(scene, tiles.At(u, v), PixelRay(camera, T_world_camera, u + du, v + dv));
  };
  ParallelFor(0, camera.height, 8, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < camera.width; ++u) {
      depth(u, v) = trace(u, v, kLateralNoise_px * Gaussian(key(u, v, 0)),
                          kLateralNoise_px * Gaussian(key(u, v, 1)))
                        .depth;
      const Vec3 color = (Shade(trace(u, v, -0.25, -0.25)) + Shade(trace(u, v, 0.25, -0.25)) +
                          Shade(trace(u, v, -0.25, 0.25)) + Shade(trace(u, v, 0.25, 0.25))) /
                         4;
      for (int c = 0; c < 3; ++c) result.color(u, v)[c] = ToByte(color[c], key(u, v, 2 + c));
    }
  });
  ParallelFor(0, camera.height, 8, [&](int64_t row) {
    const int v = static_cast<int>(row);
    for (int u = 0; u < camera.width; ++u) {
      const bool lost = OnSilhouette(depth, u, v) && Uniform(key(u, v, 5)) < kSilhouetteLoss;
      if (!lost) result.depth(u, v) = MeasuredDepth(depth(u, v), camera, key(u, v, 6));
    }
  });
  return result;
}

}  // namespace curvefusion
