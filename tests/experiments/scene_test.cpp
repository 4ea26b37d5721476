#include "experiments/simulation/scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/simulation/motion.h"
#include "experiments/simulation/random.h"
#include "experiments/simulation/scene_view.h"
#include "kernel/polyline.h"

namespace curvefusion {
namespace {

const PinholeCamera kCamera{640, 480, 580, 580, 319.5, 239.5};

double DistanceToBox(const SceneBox& box, const Vec3& p) {
  const Vec3 d = p - box.center;
  const Vec3 local = box.rotation.transpose() * d;
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

// A camera that looks along y, z up.
RigidTransform LookAlongY(const Vec3& position) {
  RigidTransform T_world_camera = RigidTransform::Identity();
  T_world_camera.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  T_world_camera.translation() = position;
  return T_world_camera;
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

double NearestOfAll(const Scene& scene, const SceneView& view, double u, double v) {
  const Vec3 center = view.Center(v);
  const Vec3 direction = view.PointAt(u, v, 1) - center;
  double nearest = kNoHit;
  const auto consider = [&](double depth) {
    if (depth > 0.02) nearest = std::min(nearest, depth);
  };
  for (const SceneCapsule& capsule : scene.capsules) {
    consider(HitCapsule(CapsuleSeen(capsule, center), direction));
  }
  for (const ScenePlane& plane : scene.planes) consider(HitPlane(plane, center, direction));
  for (const SceneBox& box : scene.boxes) consider(HitBox(BoxSeen(box, center), direction));
  return nearest;
}

// What tiles leave out is not seen through them: curved and straight wires, boxes, ellipsoids and
// cups, while the camera turns and moves by two frames.
TEST(SceneView, TilesLeaveOutNothingThatIsSeen) {
  const CageView cage;
  Random random(1, RandomStream::kScene);
  for (const char* name : {"cage", "spring", "empty"}) {
    const Scene scene = MakeScene(MakeObject(name), {.furniture = 25}, 4);
    const SceneView view(scene, kCamera, cage.poses[30], cage.poses[32]);
    for (int i = 0; i < 20000; ++i) {
      const double u = random.Uniform(-0.5, kCamera.width - 0.5);
      const double v = random.Uniform(-0.5, kCamera.height - 0.5);
      const double nearest = NearestOfAll(scene, view, u, v);
      ASSERT_NEAR(view.Trace(u, v).depth, nearest, 1e-9) << name << " at " << u << ", " << v;
      // Nothing is looked for behind a plane.
      ASSERT_TRUE(view.IsHidden(u, v, nearest + 0.01) || view.IsUniform(u, v));
      ASSERT_FALSE(view.IsHidden(u, v, nearest));
    }
  }
}

// The horizon of a floor without walls crosses a row of tiles, which show it in part.
TEST(SceneView, IsUniformOnlyWhereAFaceFillsTheTile) {
  Scene scene;
  scene.materials.resize(2);
  scene.planes = {{Vec3::UnitZ(), -0.5}};
  PinholeCamera camera = kCamera;
  camera.cy = 240.5;
  const RigidTransform level = LookAlongY(Vec3::Zero());
  const SceneView view(scene, camera, level, level);
  EXPECT_TRUE(view.IsUniform(320, 400));
  EXPECT_FALSE(view.IsUniform(320, 200));
  EXPECT_GE(view.Trace(320, 241).primitive, 0);
  EXPECT_LT(view.Trace(320, 240).primitive, 0);
  EXPECT_FALSE(view.IsUniform(320, 241));
}

TEST(SceneView, SeesHowAWireTapers) {
  // Thins from 12 to 4 mm on its way up, 0.5 m before the camera.
  WireObject object{"taper", {{{{0, 0, -0.1}, {0, 0, 0.1}}, 0.008, {0.012, 0.004}}}};
  const Scene scene = MakeScene(object, {}, 1);
  const RigidTransform pose = LookAlongY(Vec3(0, -0.5, 0));
  const SceneView view(scene, kCamera, pose, pose);
  for (const double z : {-0.09, -0.03, 0.02, 0.08}) {
    const double radius = 0.004 - 0.02 * z;
    const double v = kCamera.cy - kCamera.fy * z / 0.5;
    // Steps of 0.05 mm, half of one at most beside the even taper; the ray slants by a fifth.
    EXPECT_NEAR(view.Trace(kCamera.cx, v).depth, 0.5 - radius, 0.0001) << z;
  }
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

// A third of a pixel beside a ray: exact on planes and flat faces while all rows have one pose;
// round faces bend.
TEST(SceneView, InverseDepthSlopeTellsTheDepthBesideARay) {
  const Scene scene = MakeScene(MakeObject("empty"), {.furniture = 25}, 4);
  const CageView cage;
  const SceneView view(scene, kCamera, cage.poses[0], cage.poses[0]);
  constexpr double kStep = 1.0 / 3;
  int faces = 0, bent = 0;
  for (int v = 0; v < kCamera.height; v += 7) {
    for (int u = 0; u < kCamera.width; u += 7) {
      if (!view.IsUniform(u, v)) continue;
      const SceneRay ray = view.RayThrough(u, v);
      const RayHit hit = view.Trace(ray);
      const Vec2 slope = view.InverseDepthSlope(ray, hit);
      ++faces;
      const double right = 1 / (1 / hit.depth + kStep * slope.x());
      const double below = 1 / (1 / hit.depth + kStep * slope.y());
      const double error = std::max(std::abs(view.Trace(u + kStep, v).depth - right),
                                    std::abs(view.Trace(u, v + kStep).depth - below));
      EXPECT_LT(error, 1e-4);
      bent += error > 1e-9;
    }
  }
  EXPECT_GT(faces, 3000);
  EXPECT_LT(bent, faces / 10);
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

TEST(SceneView, SeesWhatIsInscribedInBoxes) {
  Scene scene;
  scene.materials.resize(2);
  SceneBox cup;  // 100 mm wide and high with a wall of 5 mm, 0.5 m before the camera
  cup.center = {0, 0.5, 0};
  cup.half_size = {0.05, 0.05, 0.05};
  cup.shape = BoxShape::kCylinder;
  cup.wall = 0.005;
  cup.material = 1;
  SceneBox leaf = cup;  // an ellipsoid of half axes 30, 10 and 20 mm beside it
  leaf.center = {0.2, 0.5, 0};
  leaf.half_size = {0.03, 0.01, 0.02};
  leaf.shape = BoxShape::kEllipsoid;
  scene.boxes = {cup, leaf};
  const RigidTransform level = LookAlongY(Vec3::Zero());
  const SceneView front(scene, kCamera, level, level);
  const auto depth_at = [](const SceneView& view, double x, double z, double depth) {
    const double u = kCamera.cx + kCamera.fx * x / depth;
    return view.Trace(u, kCamera.cy - kCamera.fy * z / depth).depth;
  };
  EXPECT_NEAR(depth_at(front, 0, 0, 0.45), 0.45, 1e-9);  // rounding, as all below
  EXPECT_NEAR(front.Normal(0, {0, 0.45, 0}).y(), -1, 1e-9);
  EXPECT_EQ(depth_at(front, 0.051, 0, 0.5), 0);
  EXPECT_NEAR(depth_at(front, 0.2, 0, 0.49), 0.49, 1e-3);  // seen aslant: nearly its middle
  EXPECT_EQ(depth_at(front, 0.2, 0.021, 0.5), 0);
  // From 0.2 m above its rim, straight down: the floor lies 5 mm above the base.
  RigidTransform down = RigidTransform::Identity();
  down.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  down.translation() = Vec3(0, 0.5, 0.25);
  const SceneView above(scene, kCamera, down, down);
  EXPECT_NEAR(above.Trace(kCamera.cx, kCamera.cy).depth, 0.295, 1e-9);
  EXPECT_NEAR(depth_at(above, 0.047, 0, 0.2), 0.2, 1e-9);  // the rim
  // Through the mouth at half the rim's radius outwards, onto the inside of the wall.
  const Vec3 inside = above.PointAt(kCamera.cx + kCamera.fx * 0.18, kCamera.cy,
                                    above.Trace(kCamera.cx + kCamera.fx * 0.18, kCamera.cy).depth);
  EXPECT_NEAR(inside.x(), 0.045, 1e-9);
  EXPECT_NEAR(above.Normal(0, inside).x(), -1, 1e-9);
}

TEST(Scene, FurnitureIsNoWireAndKeepsClear) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const SceneOptions options{.furniture = 25};
    const Scene scene = MakeScene(MakeObject("cage"), options, seed);
    const Scene bare = MakeScene(MakeObject("cage"), {}, seed);
    EXPECT_GT(scene.boxes.size(), bare.boxes.size() + 20) << seed;
    EXPECT_LE(scene.materials.size(), 64u);  // the projector's dots know so many surfaces
    for (const SceneCapsule& capsule : scene.capsules) {
      EXPECT_LT(capsule.material, static_cast<int>(scene.materials.size()));
      if (capsule.material == 0) continue;
      EXPECT_GE(capsule.radius, 0.007);
      EXPECT_GT(scene.object_bounds.exteriorDistance(capsule.start), 0) << seed;
    }
    for (const SceneBox& box : scene.boxes) {
      EXPECT_GT(box.material, 0);
      Vec3 half = box.half_size;
      std::sort(half.begin(), half.end());
      // Flat where it is thin: its second width is at least 12 mm.
      EXPECT_GE(half[1], 0.006) << seed;
      EXPECT_GT(scene.object_bounds.exteriorDistance(box.center), 0) << seed;
    }
  }
  EXPECT_TRUE(MakeScene(MakeObject("empty"), {.furniture = 20}, 1).object.curves.empty());
}

TEST(SceneView, NormalsOfFurnitureFaceTheCamera) {
  const Scene scene = MakeScene(MakeObject("empty"), {.furniture = 30}, 4);
  const RigidTransform pose = LookAlongY(Vec3(0, -0.9, 0.05));
  const SceneView view(scene, kCamera, pose, pose);
  for (int v = 0; v < kCamera.height; v += 5) {
    for (int u = 0; u < kCamera.width; u += 5) {
      const RayHit hit = view.Trace(u, v);
      ASSERT_GE(hit.primitive, 0);
      const Vec3 p = view.PointAt(u, v, hit.depth);
      EXPECT_NEAR(view.Normal(hit.primitive, p).norm(), 1, 1e-9);  // rounding
      EXPECT_GT(view.Normal(hit.primitive, p).dot(view.Center(v) - p), -1e-6);
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

TEST(Motion, RestsAndKeepsToOneSideWhereAsked) {
  const CageView cage;
  ScanTask task;
  task.object_bounds = cage.scene.object_bounds;
  task.table_height = cage.scene.TableHeight();
  MotionOptions options{.hand_noise = 0, .sweep = 0.2, .azimuth = 0.6, .pause = 1};
  const auto poses = HandheldPath(task, 600, options, 1);
  int resting = 0;
  for (size_t i = 0; i + 1 < poses.size(); ++i) {
    const Vec3& eye = poses[i].translation();
    resting += (poses[i + 1].translation() - eye).norm() == 0;
    // The middle of the way is drawn within 8 degrees, .14 rad, of the one asked for.
    const double azimuth = std::atan2(eye.x(), -eye.y());
    EXPECT_GT(azimuth, 0.6 - 0.2 - 0.141);
    EXPECT_LT(azimuth, 0.6 + 0.2 + 0.141);
  }
  // 1 s of 2.5 s; the first and last moments of motion are slow, not at rest.
  EXPECT_NEAR(resting / 600.0, 0.4, 0.03);
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
