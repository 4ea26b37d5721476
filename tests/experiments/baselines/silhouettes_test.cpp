// Voxels fitted to silhouettes of a ring of wire, of which the truth is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "experiments/baselines/silhouette_maps.h"
#include "experiments/baselines/silhouette_voxels.h"
#include "experiments/metrics/mesh_metrics.h"
#include "experiments/metrics/normal_error.h"
#include "meshing/tubes.h"

namespace curvefusion {
namespace {

constexpr double kWire = 2 * kMillimetre;  // radius
constexpr double kRing = 40 * kMillimetre;
constexpr double kVoxel = 1 * kMillimetre;
constexpr int kViews = 30;
constexpr double kFarAway = 0.4;  // a pixel is then 1 mm
const PinholeCamera kCamera{160, 120, 400, 400, 79.5, 59.5};
const Eigen::AlignedBox3d kBox(Vec3(-0.05, -0.05, -0.01), Vec3(0.05, 0.05, 0.01));

SkeletonGraph Ring() {
  Polyline points;
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * std::numbers::pi * i / 100;
    points.push_back(kRing * Vec3(std::cos(angle), std::sin(angle), 0));
  }
  points.push_back(points.front());
  SkeletonGraph graph;
  const EdgeId edge = graph.AddPolyline(points);
  graph.SetCurve(edge, points, std::vector<double>(points.size(), kWire));
  return graph;
}

// The same with every pixel wrong with this probability.
std::vector<SilhouetteMap> WithWrongPixels(std::vector<SilhouetteMap> maps, double share) {
  std::mt19937 random(1);
  for (SilhouetteMap& map : maps) {
    for (size_t i = 0; i < map.probability.size(); ++i) {
      float& p = map.probability.data()[i];
      if (static_cast<double>(random()) < share * std::mt19937::max()) p = 1 - p;
    }
  }
  return maps;
}

// The same with images that show nothing of the object.
std::vector<SilhouetteMap> WithEmptyImages(std::vector<SilhouetteMap> maps, double share) {
  const auto empty = static_cast<size_t>(share * static_cast<double>(maps.size()));
  for (size_t i = 0; i < empty; ++i) {
    SilhouetteMap& map = maps[i * maps.size() / empty];
    std::fill_n(map.probability.data(), map.probability.size(), 0.0f);
  }
  return maps;
}

// By its definition: voxels whose centres fall on silhouette in all views.
VoxelSet VisualHull(const std::vector<SilhouetteMap>& maps) {
  VoxelSet hull{kVoxel, {}, 0};
  for (VoxelKey key{-50, 0, 0}; key.x <= 50; ++key.x) {  // kBox
    for (key.y = -50; key.y <= 50; ++key.y) {
      for (key.z = -10; key.z <= 10; ++key.z) {
        const Vec3 p = kVoxel * Vec3(key.x, key.y, key.z);
        if (std::all_of(maps.begin(), maps.end(), [&](const SilhouetteMap& map) {
              const Vec2 pixel = map.camera.Project(map.T_world_camera.inverse() * p);
              const Eigen::Vector2i at = PinholeCamera::Rounded(pixel);
              return map.probability.Contains(at.x(), at.y()) &&
                     map.probability(at.x(), at.y()) > 0.5f;
            })) {
          hull.voxels.push_back(key);
        }
      }
    }
  }
  return hull;
}

// The sum of squared differences by its definition: a voxel covers what a ball of pi r^2 = 6 / 4
// covers, at least the nearest pixel.
double ErrorOf(const std::vector<SilhouetteMap>& maps, const std::vector<VoxelKey>& voxels) {
  double error = 0;
  for (const SilhouetteMap& map : maps) {
    MaskImage covered(map.camera.width, map.camera.height, 0);
    for (const VoxelKey& key : voxels) {
      const Vec3 p = map.T_world_camera.inverse() * (kVoxel * Vec3(key.x, key.y, key.z));
      const Vec2 center = map.camera.Project(p);
      const double radius =
          std::max(std::sqrt(1.5 / std::numbers::pi) * 400 * kVoxel / p.z(), 0.7072);
      for (int v = static_cast<int>(center.y()) - 2; v <= center.y() + 2; ++v) {
        for (int u = static_cast<int>(center.x()) - 2; u <= center.x() + 2; ++u) {
          if ((Vec2(u, v) - center).norm() <= radius) covered(u, v) = 1;
        }
      }
    }
    for (size_t i = 0; i < map.probability.size(); ++i) {
      const double difference = covered.data()[i] - map.probability.data()[i];
      error += difference * difference;
    }
  }
  return error;
}

double FAtOneVoxel(const VoxelSet& set) {
  static_assert(kDistanceThresholds[0] == kVoxel);
  return CompareSurface(SurfaceOf(set), Ring()).within[0].F().value_or(0);
}

VoxelSet Fit(const std::vector<SilhouetteMap>& maps) {
  return FitVoxelsToSilhouettes(maps, kBox, kVoxel, NoProgress);
}

class Silhouettes : public testing::Test {
 protected:
  const std::vector<SilhouetteMap> maps_ =
      TrueSilhouettes(Ring(), kCamera, PosesAround(Vec3::Zero(), kFarAway, kViews));
};

TEST_F(Silhouettes, OfTheTruthShowTheTubesWidth) {
  double pixels = 0;
  for (const SilhouetteMap& map : maps_) {
    pixels += std::accumulate(map.probability.data(),
                              map.probability.data() + map.probability.size(), 0.0);
  }
  // A ring seen from above at kFarAway: circumference times diameter; from the side it is shorter.
  const double from_above = 2 * std::numbers::pi * 40 * 4;
  EXPECT_LT(pixels / kViews, from_above);
  EXPECT_GT(pixels / kViews, 0.6 * from_above);
}

TEST_F(Silhouettes, WithoutErrorsGiveTheRingWithinAVoxel) {
  EXPECT_GE(FAtOneVoxel(Fit(maps_)), 0.9);
}

// One wrong pixel of thirty is enough for a visual hull to lose a voxel: it keeps .8^30 = .1 %.
TEST_F(Silhouettes, WithWrongPixelsGiveMoreThanTheVisualHull) {
  const auto wrong = WithWrongPixels(maps_, 0.2);
  EXPECT_LT(FAtOneVoxel(VisualHull(wrong)), 0.1);
  EXPECT_GT(FAtOneVoxel(Fit(wrong)), 0.7);  // most of the wire, with voxels of noise beside it
}

TEST_F(Silhouettes, WithEmptyImagesStillGiveTheRing) {
  const auto wrong = WithEmptyImages(maps_, 0.2);
  EXPECT_TRUE(VisualHull(wrong).voxels.empty());
  EXPECT_GE(FAtOneVoxel(Fit(wrong)), 0.9);  // four of five views see every voxel of it
}

TEST_F(Silhouettes, AreFittedToALocalMinimumOfTheSumOfSquares) {
  const auto wrong = WithWrongPixels(maps_, 0.2);
  VoxelSet set = Fit(wrong);
  const double error = ErrorOf(wrong, set.voxels);
  EXPECT_NEAR(set.error, error, 1e-3);  // sums of 19200 pixels of 30 views, all of them whole
  EXPECT_LT(error, ErrorOf(wrong, {}));
  for (size_t i = 0; i < set.voxels.size(); i += set.voxels.size() / 20) {
    std::vector<VoxelKey> without = set.voxels;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_GT(ErrorOf(wrong, without), error - 1);  // a change must pay one pixel
  }
}

TEST_F(Silhouettes, OfNothingGiveNothing) {
  const auto empty = WithEmptyImages(maps_, 1);
  EXPECT_TRUE(Fit(empty).voxels.empty());
  EXPECT_TRUE(Fit({}).voxels.empty());
  EXPECT_TRUE(SurfaceOf(Fit(empty)).triangles.empty());
}

TEST(VoxelSurface, OfOneVoxelIsAClosedOctahedronAboutItsCentre) {
  const TriangleMesh mesh = SurfaceOf({kVoxel, {{-1, 7, 8}}, 0});  // where blocks of 8 meet
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
  for (const Vec3f& p : mesh.vertices) {
    EXPECT_NEAR((p.cast<double>() - kVoxel * Vec3(-1, 7, 8)).norm(), kVoxel / 2, 1e-8);
  }
}

TEST(NormalError, IsSmallOnTubesAndLargeOnVoxels) {
  const TriangleMesh tubes = ToTriangleMesh(BuildTubes(Ring(), TubeOptions()).surface);
  const auto smooth = MeanNormalError(tubes, Ring());
  ASSERT_TRUE(smooth);
  // Sixteen sides of 22.5 degrees and chords of the axis: facets lie on both sides of the normal.
  EXPECT_LT(*smooth, 6 * std::numbers::pi / 180);
  const auto maps = TrueSilhouettes(Ring(), kCamera, PosesAround(Vec3::Zero(), kFarAway, kViews));
  EXPECT_GT(MeanNormalError(SurfaceOf(Fit(maps)), Ring()).value_or(0), 2 * *smooth);
  EXPECT_FALSE(MeanNormalError({}, Ring()));
  EXPECT_FALSE(MeanNormalError(tubes, {}));
}

}  // namespace
}  // namespace curvefusion
