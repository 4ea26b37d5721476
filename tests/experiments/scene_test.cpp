#include "experiments/simulation/scene.h"

#include <gtest/gtest.h>

#include "experiments/simulation/motion.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"
#include "kernel/polyline.h"

namespace curvefusion {
namespace {

const PinholeCamera kCamera{640, 480, 580, 580, 319.5, 239.5};

double DistanceToBox(const SceneBox& box, const Vec3& p) {
  const Vec3 d = p - box.center;
  const Vec3 local(box.heading.dot(d.head<2>()), box.heading.x() * d.y() - box.heading.y() * d.x(),
                   d.z());
  const Vec3 outside = local.cwiseAbs() - box.half_size;
  return outside.cwiseMax(0).norm() + std::min(outside.maxCoeff(), 0.0);
}

double DistanceToScene(const Scene& scene, const Vec3& p) {
  double distance = 10;
  for (const SceneCapsule& c : scene.capsules) {
    const double t = ClosestParameter(c.start, c.end, p);
    distance = std::min(distance, (c.start + t * (c.end - c.start) - p).norm() - c.radius);
  }
  for (const ScenePlane& plane : scene.planes) {
    distance = std::min(distance, plane.normal.dot(p) - plane.offset);
  }
  for (const SceneBox& box : scene.boxes) distance = std::min(distance, DistanceToBox(box, p));
  return distance;
}

// Sphere tracing without any tiles. Grazed surfaces count as hit within 1 um.
double MarchedDepth(const Scene& scene, const SceneView& view, double u, double v) {
  const double length_per_depth = (view.PointAt(u, v, 1) - view.Center(v)).norm();
  double depth = 0;
  for (int step = 0; step < 2000; ++step) {
    const double distance = DistanceToScene(scene, view.PointAt(u, v, depth));
    if (distance < 1e-6) break;
    depth += distance / length_per_depth;
  }
  return depth;
}

struct CageView {
  Scene scene = MakeScene(MakeObject("cage"), {}, 3);
  std::vector<RigidTransform> poses;
  CageView() {
    ScanTask task;
    task.object_bounds = scene.object_bounds;
    task.table_height = scene.TableHeight();
    poses = HandheldPath(task, 60, {}, 3);
  }
};

TEST(SceneView, TracesTheSameDepthAsSphereTracing) {
  const CageView cage;
  // A shutter that rolls by two frames, so that rows differ.
  const SceneView view(cage.scene, kCamera, cage.poses[30], cage.poses[32]);
  Random random(1, RandomStream::kScene);
  int wires = 0;
  int different = 0;
  constexpr int kRays = 3000;
  for (int i = 0; i < kRays; ++i) {
    const double u = random.Uniform(200, 440);
    const double v = random.Uniform(80, 400);
    const RayHit hit = view.Trace(u, v);
    wires += view.Surface(hit.primitive) == 0;
    different += std::abs(hit.depth - MarchedDepth(cage.scene, view, u, v)) > 1e-4;
  }
  EXPECT_GT(wires, 100);
  // Rays that graze a wire within 1 um are hits to one and misses to the other.
  EXPECT_LE(different, kRays / 500);
}

TEST(SceneView, NormalsFaceTheCameraAndAreUnit) {
  const CageView cage;
  const SceneView view(cage.scene, kCamera, cage.poses[0], cage.poses[0]);
  for (int v = 0; v < kCamera.height; v += 7) {
    for (int u = 0; u < kCamera.width; u += 7) {
      const RayHit hit = view.Trace(u, v);
      ASSERT_GE(hit.primitive, 0);
      const Vec3 p = view.PointAt(u, v, hit.depth);
      const Vec3 normal = view.Normal(hit.primitive, p);
      EXPECT_NEAR(normal.norm(), 1, 1e-9);  // rounding
      EXPECT_GT(normal.dot(view.Center(v) - p), -1e-6);
    }
  }
}

TEST(SceneView, HidesWhatLiesBehindAWire) {
  const CageView cage;
  const SceneView view(cage.scene, kCamera, cage.poses[0], cage.poses[0]);
  for (int v = 100; v < 400; v += 11) {
    for (int u = 200; u < 440; u += 11) {
      const double depth = view.Trace(u, v).depth;
      EXPECT_FALSE(view.IsHidden(u, v, depth));
      EXPECT_TRUE(view.IsHidden(u, v, depth + 0.01) || view.IsUniform(u, v));
    }
  }
}

TEST(Scene, KeepsTheObjectOffTableWallAndBoxes) {
  for (const char* name : {"cage", "deco", "chair", "empty"}) {
    for (uint64_t seed = 0; seed < 5; ++seed) {
      const Scene scene = MakeScene(MakeObject(name), {}, seed);
      const double gap = scene.object_bounds.min().z() - scene.TableHeight();
      EXPECT_GE(gap, 0.06);
      EXPECT_LE(gap, 0.10);
      EXPECT_GE(scene.boxes.size(), 3u) << name << seed;
      EXPECT_LE(scene.boxes.size(), 5u);
      EXPECT_EQ(scene.materials.size(), 1 + scene.planes.size() + scene.boxes.size());
      EXPECT_LT(scene.object_bounds.center().norm(), 1e-9);  // rounding
      for (const SceneCapsule& wire : scene.capsules) {
        for (const SceneBox& box : scene.boxes) EXPECT_GT(DistanceToBox(box, wire.start), 0.02);
        const double to_wall = -scene.planes[1].offset - wire.start.y();
        EXPECT_GE(to_wall, 0.4);
      }
    }
  }
}

TEST(Motion, HandCarriesTheCameraAtItsSpeedAndDistance) {
  const CageView cage;
  ScanTask task;
  task.object_bounds = cage.scene.object_bounds;
  task.table_height = cage.scene.TableHeight();
  const auto poses = HandheldPath(task, 600, {.hand_noise = 0}, 1);
  ASSERT_EQ(poses.size(), 600u);
  for (size_t i = 0; i + 1 < poses.size(); ++i) {
    const double speed = 30 * (poses[i + 1].translation() - poses[i].translation()).norm();
    // 0.1 to 0.2 m/s, and slower where the path turns round.
    EXPECT_LE(speed, 0.21);
    const Vec3 eye = poses[i].translation();
    const double to_object = task.object_bounds.exteriorDistance(eye);
    EXPECT_GT(to_object, 0.4);
    EXPECT_LT(to_object, 0.7);
    EXPECT_GE(eye.z(), task.table_height + 0.1 - 1e-9);
    const Vec2 center = kCamera.Project(poses[i].inverse() * Vec3::Zero());
    EXPECT_TRUE(kCamera.Contains(center));
  }
}

TEST(Motion, SwayHasItsAmplitude) {
  const CageView cage;
  ScanTask task;
  task.object_bounds = cage.scene.object_bounds;
  const auto smooth = HandheldPath(task, 3000, {.hand_noise = 0}, 1);
  const auto shaken = HandheldPath(task, 3000, {}, 1);
  double squares = 0;
  for (size_t i = 0; i < smooth.size(); ++i) {
    squares += (shaken[i].translation() - smooth[i].translation()).squaredNorm() / 3;
  }
  // 4 mm per axis; a tenth: 100 s hold about 125 independent samples of three axes.
  EXPECT_NEAR(std::sqrt(squares / smooth.size()), 0.004, 0.0004);
}

TEST(MakeScene, WiresLikeTheWallDifferInInfraredAlone) {
  SceneOptions options;
  options.wire_like_background = true;
  options.wire_albedo = 0.05;
  options.wire_infrared_albedo = 0.6;
  const Scene scene = MakeScene(MakeObject("cubeframe", {}), options, 1);
  const SurfaceMaterial& wall = scene.materials[2];
  EXPECT_EQ(scene.planes[1].normal, Vec3(-Vec3::UnitY()));  // the wall behind
  EXPECT_EQ(scene.materials[0].color, wall.color);
  EXPECT_EQ(scene.materials[0].texture_seed, wall.texture_seed);
  EXPECT_EQ(scene.materials[0].infrared_albedo, 0.6);
  options.wire_like_background = false;
  options.wire_saturation = 0;
  const Scene black = MakeScene(MakeObject("cubeframe", {}), options, 1);
  EXPECT_EQ(black.materials[0].color, Vec3(Vec3::Constant(0.05)));
}

}  // namespace
}  // namespace curvefusion
