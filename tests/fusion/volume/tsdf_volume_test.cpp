#include "fusion/volume/tsdf_volume.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "kernel/error.h"
#include "kernel/parallel.h"
#include "tests/fusion/analytic_depth.h"
#include "tests/fusion/mesh_topology.h"

namespace curvefusion {
namespace {

constexpr double kVoxel = 0.005;

// Views from all around: the 26 directions to the neighbours of a grid cell.
std::vector<RigidTransform> PosesAround(const Vec3& target, double distance) {
  std::vector<RigidTransform> poses;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        poses.push_back(LookAt(target + distance * Vec3(x, y, z).normalized(), target));
      }
    }
  }
  return poses;
}

TsdfVolume Scan(const DepthAlongRay& shape, const PinholeCamera& camera,
                const std::vector<RigidTransform>& poses, const TsdfOptions& options = {}) {
  TsdfVolume volume(options);
  for (const RigidTransform& pose : poses) {
    volume.Integrate(RenderDepth(shape, camera, pose), camera, pose);
  }
  return volume;
}

struct DepthComparison {
  int compared = 0;
  int missing = 0;   // true surface, nothing in the rendering
  int invented = 0;  // a surface where there is none
  double mean_error = 0;
  double max_error = 0;
};

DepthComparison Compare(const DepthImage& rendering, const DepthImage& truth) {
  DepthComparison result;
  for (int v = 0; v < truth.height(); ++v) {
    for (int u = 0; u < truth.width(); ++u) {
      const double error = std::abs(rendering(u, v) - truth(u, v));
      if (truth(u, v) > 0 && rendering(u, v) > 0) {
        ++result.compared;
        result.mean_error += error;
        result.max_error = std::max(result.max_error, error);
      }
      result.missing += truth(u, v) > 0 && rendering(u, v) == 0;
      result.invented += truth(u, v) == 0 && rendering(u, v) > 0;
    }
  }
  result.mean_error /= std::max(1, result.compared);
  return result;
}

TEST(TsdfVolume, EmptyVolumeHasNoSurface) {
  const TsdfVolume volume{TsdfOptions{}};
  const DepthImage depth = volume.Raycast(KinectCamera(0.25), RigidTransform::Identity());
  EXPECT_EQ(std::count(depth.data(), depth.data() + depth.size(), 0.0f), 160 * 120);
  EXPECT_TRUE(volume.ExtractMesh().vertices.empty());
  EXPECT_EQ(volume.block_count(), 0u);
}

TEST(TsdfVolume, ImageWithoutMeasurementsStoresNothing) {
  TsdfVolume volume{TsdfOptions{}};
  const PinholeCamera camera = KinectCamera(0.25);
  DepthImage depth(camera.width, camera.height, 0);
  depth(10, 10) = std::numeric_limits<float>::quiet_NaN();
  depth(11, 10) = std::numeric_limits<float>::infinity();
  depth(12, 10) = -1;
  depth(13, 10) = 4.1f;  // beyond max_depth
  volume.Integrate(depth, camera, RigidTransform::Identity());
  EXPECT_EQ(volume.block_count(), 0u);
}

TEST(TsdfVolume, FrontalPlaneIsReproducedEverywhere) {
  const PinholeCamera camera = KinectCamera();
  const DepthAlongRay plane = Plane(Vec3::UnitZ(), 1.0123);
  const RigidTransform pose = RigidTransform::Identity();
  const DepthImage truth = RenderDepth(plane, camera, pose);
  const DepthImage rendering = Scan(plane, camera, {pose}).Raycast(camera, pose);
  const DepthComparison result = Compare(rendering, truth);
  // The field is linear along the axis: only float rounding is left.
  EXPECT_LT(result.max_error, 1e-5);
  // At the image border the outermost voxels lie up to one voxel, 2.9 pixels, inside.
  EXPECT_LT(result.missing, 2 * 3 * (640 + 480));
  EXPECT_EQ(result.invented, 0);
  for (int v = 4; v < 476; ++v) {
    for (int u = 4; u < 636; ++u) ASSERT_GT(rendering(u, v), 0) << u << " " << v;
  }
}

TEST(TsdfVolume, SlantedPlaneSeenFromElsewhereIsWithinAQuarterVoxel) {
  // 40 degrees to the optical axis, at 0.4 to 0.9 m: half a pixel is 0.6 mm of depth, well below
  // the quarter voxel asked for.
  const PinholeCamera camera = KinectCamera();
  const Vec3 normal = Vec3(0.6, 0.24, 0.763).normalized();
  const double offset = 0.5;
  std::vector<RigidTransform> poses;
  for (int i = 0; i < 5; ++i) {
    poses.push_back(LookAt({0.03 * i, -0.02 * i, 0.013 * i}, {0.05, 0.05, 0.7}));
  }
  const TsdfVolume volume = Scan(Plane(normal, offset), camera, poses);
  const RigidTransform pose = LookAt({0.06, -0.03, 0.04}, {0.05, 0.05, 0.7});
  const PinholeCamera small = KinectCamera(0.5);
  const DepthImage rendering = volume.Raycast(small, pose);
  double sum = 0;
  int count = 0;
  for (int v = 20; v < 220; ++v) {
    for (int u = 20; u < 300; ++u) {
      ASSERT_GT(rendering(u, v), 0) << u << " " << v;
      const double error = normal.dot(pose * small.Unproject(u, v, rendering(u, v))) - offset;
      EXPECT_LT(std::abs(error), kVoxel / 4) << u << " " << v;
      sum += error;
      ++count;
    }
  }
  // Rounding to the nearest pixel is not biased.
  EXPECT_LT(std::abs(sum / count), kVoxel / 100);
}

TEST(TsdfVolume, SphereIsWithinAQuarterVoxelWithoutHolesOrFattening) {
  const PinholeCamera camera = KinectCamera(0.5);
  const Vec3 center(-0.3, 0.2, -1.7);
  const double radius = 0.15;
  const DepthAlongRay sphere = Sphere(center, radius);
  const TsdfVolume volume = Scan(sphere, KinectCamera(), PosesAround(center, 0.8));
  const RigidTransform pose = LookAt(center + Vec3(0.5, 0.3, 0.6), center);
  const DepthImage rendering = volume.Raycast(camera, pose);
  const DepthImage truth = RenderDepth(sphere, camera, pose);
  const DepthImage grown = RenderDepth(Sphere(center, radius + kVoxel / 2), camera, pose);
  const DepthImage shrunk = RenderDepth(Sphere(center, radius - kVoxel / 2), camera, pose);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (grown(u, v) == 0) {
        EXPECT_EQ(rendering(u, v), 0) << "fattened at " << u << " " << v;
      }
      if (shrunk(u, v) == 0) continue;
      ASSERT_GT(rendering(u, v), 0) << "hole at " << u << " " << v;
      const Vec3 p = pose * camera.Unproject(u, v, rendering(u, v));
      // Distance to the sphere, which is fair at any incidence.
      EXPECT_LT(std::abs((p - center).norm() - radius), kVoxel / 4) << u << " " << v;
    }
  }
  EXPECT_LT(Compare(rendering, truth).mean_error, kVoxel / 4);
}

TEST(TsdfVolume, SphereMeshIsAClosedOrientedManifoldOfGenusZero) {
  const Vec3 center(0.4, -0.35, 0.1);  // its blocks straddle zero
  const double radius = 0.15;
  const TsdfVolume volume = Scan(Sphere(center, radius), KinectCamera(), PosesAround(center, 0.7));
  const TriangleMesh mesh = volume.ExtractMesh();
  ASSERT_GT(mesh.triangles.size(), 5000u);
  EXPECT_TRUE(IsClosedOrientedManifold(mesh));
  EXPECT_EQ(EulerCharacteristic(mesh), 2);
  const double true_volume = 4.0 / 3 * M_PI * std::pow(radius, 3);
  // A quarter voxel of radius is 3 * 1.25 / 150 of the volume.
  EXPECT_NEAR(SignedVolume(mesh), true_volume, 0.025 * true_volume);
  for (const Vec3f& vertex : mesh.vertices) {
    ASSERT_NEAR((vertex.cast<double>() - center).norm(), radius, kVoxel / 4);
  }
}

TEST(TsdfVolume, MeshIsManifoldWhereSignsAreRandom) {
  // Noise of several voxels makes every ambiguous cell; boundary edges remain where the observed
  // region ends, but no edge may have more than two triangles or two of the same direction.
  const PinholeCamera camera = KinectCamera(0.5);
  DepthImage depth(camera.width, camera.height, 0);
  uint32_t state = 1;
  for (size_t i = 0; i < depth.size(); ++i) {
    state = state * 1664525u + 1013904223u;
    depth.data()[i] = 0.6f + 0.03f * static_cast<float>(state >> 8) / (1 << 24);
  }
  TsdfVolume volume{TsdfOptions{}};
  volume.Integrate(depth, camera, RigidTransform::Identity());
  const TriangleMesh mesh = volume.ExtractMesh();
  ASSERT_GT(mesh.triangles.size(), 10000u);
  for (const auto& [edge, count] : DirectedEdges(mesh)) EXPECT_EQ(count, 1);
}

TEST(TsdfVolume, NoSurfaceWhereThereIsNoData) {
  const PinholeCamera camera = KinectCamera();
  const RigidTransform pose = RigidTransform::Identity();
  DepthImage depth = RenderDepth(Plane(Vec3::UnitZ(), 1.0), camera, pose);
  for (int v = 200; v < 280; ++v) {
    for (int u = 300; u < 400; ++u) depth(u, v) = 0;
  }
  TsdfVolume volume{TsdfOptions{}};
  volume.Integrate(depth, camera, pose);
  const DepthImage rendering = volume.Raycast(camera, pose);
  for (int v = 200; v < 280; ++v) {
    for (int u = 300; u < 400; ++u) ASSERT_EQ(rendering(u, v), 0) << u << " " << v;
  }
  // A voxel is 2.9 pixels: the hole may grow by one cell.
  for (const auto& [u, v] : {std::pair(296, 240), {403, 240}, {350, 196}, {350, 283}}) {
    EXPECT_GT(rendering(u, v), 0) << u << " " << v;
  }
}

TEST(TsdfVolume, SurfaceSeenFromBehindIsNone) {
  const PinholeCamera camera = KinectCamera(0.5);
  const TsdfVolume volume = Scan(Plane(Vec3::UnitZ(), 1.0), camera, {RigidTransform::Identity()});
  const DepthImage rendering = volume.Raycast(camera, LookAt({0, 0, 2}, {0, 0, 1}));
  EXPECT_EQ(std::count(rendering.data(), rendering.data() + rendering.size(), 0.0f),
            static_cast<long>(rendering.size()));
}

// A vertical wire before a wall.
DepthAlongRay WireBeforeWall(double x, double thickness) {
  return Union(Box({x - thickness / 2, -2, 0.7}, {x + thickness / 2, 2, 0.7 + thickness}),
               Plane(Vec3::UnitZ(), 1.0));
}

TEST(TsdfVolume, StandingWireIsSeenBeforeTheWall) {
  const PinholeCamera camera = KinectCamera();
  const RigidTransform pose = RigidTransform::Identity();
  const DepthAlongRay scene = WireBeforeWall(0.0, 0.02);
  const DepthImage rendering = Scan(scene, camera, {pose, pose, pose}).Raycast(camera, pose);
  for (int v = 20; v < 460; ++v) {
    EXPECT_NEAR(rendering(320, v), 0.7, kVoxel / 4) << v;
    EXPECT_NEAR(rendering(200, v), 1.0, kVoxel / 4) << v;
  }
}

TEST(TsdfVolume, WireThatMovedAwayIsCarved) {
  const PinholeCamera camera = KinectCamera();
  const RigidTransform pose = RigidTransform::Identity();
  TsdfVolume volume{TsdfOptions{}};
  for (const double x : {0.0, 0.1, 0.2, 0.3}) {
    volume.Integrate(RenderDepth(WireBeforeWall(x, 0.02), camera, pose), camera, pose);
  }
  // The first place was free in three of four frames.
  const DepthImage rendering = volume.Raycast(camera, pose);
  for (int v = 20; v < 460; ++v) EXPECT_NEAR(rendering(320, v), 1.0, kVoxel / 4) << v;
}

TEST(TsdfVolume, FlyingPixelIsCarved) {
  const PinholeCamera camera = KinectCamera();
  const RigidTransform pose = RigidTransform::Identity();
  DepthImage depth = RenderDepth(Plane(Vec3::UnitZ(), 1.0), camera, pose);
  TsdfVolume volume{TsdfOptions{}};
  const DepthImage clean = depth;
  for (int u = 320; u < 328; ++u) {
    for (int v = 240; v < 248; ++v) depth(u, v) = 0.6f;
  }
  volume.Integrate(depth, camera, pose);
  EXPECT_NEAR(volume.Raycast(camera, pose)(324, 244), 0.6, kVoxel / 4);
  volume.Integrate(clean, camera, pose);
  volume.Integrate(clean, camera, pose);
  EXPECT_NEAR(volume.Raycast(camera, pose)(324, 244), 1.0, kVoxel / 4);
}

TEST(TsdfVolume, SolidityIsTheShareOfFramesThatEndThere) {
  const PinholeCamera camera = KinectCamera(0.25);
  const RigidTransform pose = RigidTransform::Identity();
  const DepthImage near = RenderDepth(Plane(Vec3::UnitZ(), 1.0), camera, pose);
  const DepthImage far = RenderDepth(Plane(Vec3::UnitZ(), 1.3), camera, pose);
  TsdfVolume volume({});
  for (int i = 0; i < 8; ++i) volume.Integrate(near, camera, pose);
  const double distance = 0.015;  // of a truncation of 20 mm
  const DepthImage solid = volume.SolidityBehind(near, camera, pose, distance);
  volume.Integrate(far, camera, pose);
  volume.Integrate(far, camera, pose);
  const DepthImage grille = volume.SolidityBehind(near, camera, pose, distance);
  const int u = camera.width / 2, v = camera.height / 2;
  // The nearest voxel lies up to 2.5 mm off, a sixth of the distance.
  EXPECT_NEAR(solid(u, v), 1.0, 0.17);
  // Two of ten frames saw free space, a truncation in front of surfaces.
  EXPECT_NEAR(grille(u, v), 0.8 * solid(u, v) - 0.2 * 20 / 15, 1e-3);
  EXPECT_TRUE(std::isnan(volume.SolidityBehind(DepthImage(camera.width, camera.height, 0), camera,
                                               pose, distance)(u, v)));
  EXPECT_THROW(volume.SolidityBehind(near, camera, pose, 0.02), Error);
}

TEST(TsdfVolume, ExtentOfSeveralMetresWithNegativeCoordinates) {
  // Four walls of a room of 6 m, far from the origin, each seen by a camera in the middle.
  const PinholeCamera camera = KinectCamera(0.5);
  const Vec3 middle(-120.3, -45.7, -60.2);
  TsdfOptions options;
  options.voxel_size = 0.01;
  TsdfVolume volume(options);
  std::vector<RigidTransform> poses;
  for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    poses.push_back(LookAt(middle, middle + direction));
    const DepthAlongRay wall = Plane(direction, direction.dot(middle) + 3);
    volume.Integrate(RenderDepth(wall, camera, poses.back()), camera, poses.back());
  }
  for (const RigidTransform& pose : poses) {
    const DepthImage rendering = volume.Raycast(camera, pose);
    for (int v = 10; v < 230; v += 10) {
      for (int u = 10; u < 310; u += 10) EXPECT_NEAR(rendering(u, v), 3, 1e-4) << u << " " << v;
    }
  }
  // 4 walls of 3.3 m x 2.5 m and 80 mm truncation in blocks of 80 mm: between two and three layers.
  EXPECT_GT(volume.block_count(), 4u * 40 * 30);
  EXPECT_LT(volume.block_count(), 4u * 44 * 34 * 3);
  EXPECT_GT(volume.memory_bytes(), volume.block_count() * 512 * 6);
}

TEST(TsdfVolume, SameBitsForAnyNumberOfThreads) {
  const Vec3 center(0.1, 0.2, 1.0);
  const DepthAlongRay scene =
      Union(Sphere(center, 0.2), Plane(Vec3(0.1, 0.2, 1).normalized(), 1.5));
  const PinholeCamera camera = KinectCamera(0.5);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    TsdfVolume volume = Scan(scene, camera,
                             {LookAt({0, 0, 0}, center), LookAt({0.3, 0.1, 0.1}, center),
                              LookAt({-0.3, 0.2, -0.1}, center)});
    return std::pair(volume.Raycast(camera, LookAt({0.1, 0, 0}, center)), volume.ExtractMesh());
  };
  const auto [depth_1, mesh_1] = run(1);
  const auto [depth_2, mesh_2] = run(2);
  EXPECT_EQ(std::memcmp(depth_1.data(), depth_2.data(), depth_1.size() * sizeof(float)), 0);
  EXPECT_EQ(mesh_1.triangles, mesh_2.triangles);
  ASSERT_EQ(mesh_1.vertices.size(), mesh_2.vertices.size());
  for (size_t i = 0; i < mesh_1.vertices.size(); ++i) {
    ASSERT_EQ(mesh_1.vertices[i], mesh_2.vertices[i]);
  }
}

TEST(TsdfVolume, CameraInsideTheStoredBlocksSeesThem) {
  // The camera's own block and blocks beside it reach behind the image plane.
  TsdfOptions options;
  options.voxel_size = 0.05;
  const PinholeCamera camera = KinectCamera(0.25);
  const RigidTransform pose = RigidTransform::Identity();
  TsdfVolume volume(options);
  volume.Integrate(RenderDepth(Plane(Vec3::UnitZ(), 0.3), camera, pose), camera, pose);
  volume.Integrate(RenderDepth(Plane(Vec3::UnitZ(), 0.3), camera, LookAt({0, 0, -1}, {0, 0, 1})),
                   camera, LookAt({0, 0, -1}, {0, 0, 1}));
  EXPECT_NEAR(volume.Raycast(camera, pose)(80, 60), 0.3, 0.05 / 4);
}

TEST(TsdfVolume, MemoryBoundIsAnErrorThatNamesTheRemedy) {
  TsdfOptions options;
  options.max_memory = 0.01;
  TsdfVolume volume(options);
  const PinholeCamera camera = KinectCamera(0.5);
  const RigidTransform pose = RigidTransform::Identity();
  try {
    volume.Integrate(RenderDepth(Plane(Vec3::UnitZ(), 3.5), camera, pose), camera, pose);
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_NE(std::string(error.what()).find("voxel_size"), std::string::npos) << error.what();
  }
  EXPECT_EQ(volume.block_count(), 0u);
}

TEST(TsdfVolume, BadInputIsRejected) {
  TsdfVolume volume{TsdfOptions{}};
  const PinholeCamera camera = KinectCamera(0.25);
  const DepthImage depth(camera.width, camera.height, 1);
  RigidTransform pose = RigidTransform::Identity();
  EXPECT_THROW(volume.Integrate(DepthImage(10, 10, 1), camera, pose), Error);
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(volume.Integrate(depth, camera, pose), Error);
  EXPECT_THROW(volume.Raycast(camera, pose), Error);
  pose.translation().x() = 1e6;
  EXPECT_THROW(volume.Integrate(depth, camera, pose), Error);
  TsdfOptions options;
  options.voxel_size = 0;
  EXPECT_THROW(TsdfVolume{options}, Error);
}

}  // namespace
}  // namespace curvefusion
