#include "fusion/segmentation/depth_opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fusion/volume/tsdf_volume.h"
#include "kernel/error.h"
#include "tests/fusion/analytic_depth.h"

namespace curvefusion {
namespace {

const RigidTransform kOrigin = RigidTransform::Identity();

DepthAlongRay Wall(double z) { return Plane(Vec3::UnitZ(), z); }

// A bar of some width that crosses the whole image upright, turned by `angle` about the line of
// sight.
DepthAlongRay Bar(double x, double width, double z, double angle = 0) {
  return [=](const Vec3& origin, const Vec3& direction) {
    const double t = (z - origin.z()) / direction.z();
    const Vec3 p = origin + t * direction;
    const double across = p.x() * std::cos(angle) + p.y() * std::sin(angle) - x;
    return std::abs(across) <= width / 2 ? t : 0.0;
  };
}

// Pixels at least `margin` from the image's border where the opening differs from what is expected.
int CountDifferences(const DepthImage& opened, const std::function<float(int u, int v)>& expected,
                     int margin = 0) {
  int differences = 0;
  for (int v = margin; v < opened.height() - margin; ++v) {
    for (int u = margin; u < opened.width() - margin; ++u) {
      differences += opened(u, v) != expected(u, v);
    }
  }
  return differences;
}

class DepthOpening : public ::testing::TestWithParam<double> {};

TEST_P(DepthOpening, RemovesAThinBarAndKeepsAThickOneWhole) {
  const PinholeCamera camera = KinectCamera(GetParam());
  for (const double z : {0.5, 0.7, 1.1}) {
    for (const double angle : {0.0, 0.3, M_PI / 4, M_PI / 2}) {
      // A pixel is up to 3.8 mm: 36 mm is thin and 44 mm thick however pixels fall.
      // Where an oblique bar leaves the image, its edges cannot be seen from its middle.
      const int margin = angle == 0 ? 0 : static_cast<int>(0.045 * camera.fx / z);
      const DepthImage thin =
          RenderDepth(Union(Bar(0.01, 0.036, z, angle), Wall(1.4)), camera, kOrigin);
      const DepthImage opened_thin = OpenDepth(thin, camera, {}, {});
      EXPECT_EQ(CountDifferences(
                    opened_thin, [&](int u, int v) { return thin(u, v) < 1.2f ? 0 : thin(u, v); },
                    margin),
                0)
          << z << " " << angle;
      const DepthImage thick =
          RenderDepth(Union(Bar(0.01, 0.044, z, angle), Wall(1.4)), camera, kOrigin);
      EXPECT_EQ(
          CountDifferences(
              OpenDepth(thick, camera, {}, {}), [&](int u, int v) { return thick(u, v); }, margin),
          0)
          << z << " " << angle;
    }
  }
}

TEST_P(DepthOpening, LosesNothingOfTheWallBetweenWires) {
  const PinholeCamera camera = KinectCamera(GetParam());
  DepthAlongRay scene = Wall(1.0);
  for (int i = -10; i <= 10; ++i) scene = Union(scene, Bar(0.03 * i, 0.012, 0.7));
  const DepthImage rendering = RenderDepth(scene, camera, kOrigin);
  EXPECT_EQ(
      CountDifferences(OpenDepth(rendering, camera, {}, {}),
                       [&](int u, int v) { return rendering(u, v) < 0.8f ? 0 : rendering(u, v); }),
      0);
}

TEST_P(DepthOpening, RemovesAGrilleThatLooksLikeASurfaceButForItsSolidity) {
  const PinholeCamera camera = KinectCamera(GetParam());
  const DepthAlongRay scene = Union(Bar(0, 0.2, 0.7), Wall(1.0));
  const DepthImage rendering = RenderDepth(scene, camera, kOrigin);
  const auto is_bar = [&](int u, int v) { return rendering(u, v) < 0.8f; };
  DepthImage solidity(camera.width, camera.height, 1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      // Every twentieth pixel was never seen through.
      if (is_bar(u, v) && (u + 7 * v) % 20 != 0) solidity(u, v) = 0;
    }
  }
  EXPECT_EQ(CountDifferences(OpenDepth(rendering, camera, solidity, {}),
                             [&](int u, int v) { return is_bar(u, v) ? 0 : rendering(u, v); }),
            0);
}

TEST_P(DepthOpening, KeepsTheRimOfASurfaceThatIsSeenThroughThere) {
  const PinholeCamera camera = KinectCamera(GetParam());
  const DepthImage rendering = RenderDepth(Union(Bar(0, 0.2, 0.7), Wall(1.0)), camera, kOrigin);
  DepthImage solidity(camera.width, camera.height, 1);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = camera.Unproject(u, v, 0.7).x();
      if (rendering(u, v) < 0.8f && std::abs(x) > 0.092) solidity(u, v) = 0;
    }
  }
  // 8 mm of rim and the 10 mm eroded beside it are less than the 20 mm of dilation.
  EXPECT_EQ(CountDifferences(OpenDepth(rendering, camera, solidity, {}),
                             [&](int u, int v) { return rendering(u, v); }),
            0);
}

TEST_P(DepthOpening, LeavesSlantedPlanesWhole) {
  const PinholeCamera camera = KinectCamera(GetParam());
  for (const double degrees : {0.0, 30.0, 60.0, 75.0, 80.0}) {
    const double angle = degrees * M_PI / 180;
    const Vec3 normal(0.5 * std::sin(angle), std::sqrt(0.75) * std::sin(angle), std::cos(angle));
    DepthImage rendering = RenderDepth(Plane(normal, 0.8 * std::cos(angle)), camera, kOrigin);
    // Towards the horizon a plane is seen at any angle; beyond 84 degrees it is left out here.
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Vec3 ray = camera.Unproject(u, v, 1).normalized();
        if (normal.dot(ray) < std::cos(84 * M_PI / 180)) rendering(u, v) = 0;
      }
    }
    // Where the cut meets the image's border it makes a corner, which opening rounds.
    EXPECT_EQ(
        CountDifferences(
            OpenDepth(rendering, camera, {}, {}), [&](int u, int v) { return rendering(u, v); }, 2),
        0)
        << degrees;
  }
}

TEST_P(DepthOpening, KeepsTheEdgesOfABoxBeforeAWallAndRoundsItsCornersLittle) {
  const PinholeCamera camera = KinectCamera(GetParam());
  const DepthAlongRay scene = Union(Box({-0.2, -0.1, 0.8}, {0.1, 0.15, 1.0}), Wall(1.3));
  const DepthImage rendering = RenderDepth(scene, camera, kOrigin);
  DepthOpeningOptions options;
  const DepthImage opened = OpenDepth(rendering, camera, {}, options);
  // What an ideal opening rounds off each of the four corners of the front face.
  const double pixel = 0.8 / camera.fx;
  const double rounded = 4 * (1 - M_PI / 4) * std::pow(options.radius / pixel, 2);
  const int lost = CountDifferences(opened, [&](int u, int v) { return rendering(u, v); });
  EXPECT_GT(lost, 0);
  EXPECT_LT(lost, rounded);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (opened(u, v) == rendering(u, v)) continue;
      const Vec3 p = camera.Unproject(u, v, rendering(u, v));
      // Nothing is lost away from the corners.
      EXPECT_LT(std::min(std::abs(p.x() + 0.2), std::abs(p.x() - 0.1)), options.radius);
      EXPECT_LT(std::min(std::abs(p.y() + 0.1), std::abs(p.y() - 0.15)), options.radius);
    }
  }
}

TEST_P(DepthOpening, GapsDoNotHarmSurfacesAndWiresBeforeNothingGo) {
  const PinholeCamera camera = KinectCamera(GetParam());
  DepthImage wall = RenderDepth(Wall(1.0), camera, kOrigin);
  for (int v = 20; v < camera.height; v += 60) {
    for (int u = 20; u < camera.width; u += 60) wall(u, v) = wall(u + 1, v) = 0;
  }
  EXPECT_EQ(
      CountDifferences(OpenDepth(wall, camera, {}, {}), [&](int u, int v) { return wall(u, v); }),
      0);
  const DepthImage wire = RenderDepth(Bar(0, 0.02, 0.8), camera, kOrigin);
  EXPECT_EQ(CountDifferences(OpenDepth(wire, camera, {}, {}), [](int, int) { return 0.0f; }), 0);
}

TEST_P(DepthOpening, WireOnABoxIsRemovedDownToItsRoot) {
  const PinholeCamera camera = KinectCamera(GetParam());
  const DepthAlongRay wire = [](const Vec3& origin, const Vec3& direction) {
    const double t = (0.8 - origin.z()) / direction.z();
    const Vec3 p = origin + t * direction;
    return std::abs(p.y()) < 0.004 && p.x() > 0 ? t : 0.0;
  };
  const DepthAlongRay box = Box({-0.2, -0.1, 0.8}, {0.0, 0.1, 1.0});
  const DepthImage rendering = RenderDepth(Union(Union(box, wire), Wall(1.3)), camera, kOrigin);
  const DepthImage opened = OpenDepth(rendering, camera, {}, {});
  const int middle = static_cast<int>(std::lround(camera.cy));
  for (int u = 0; u < camera.width; ++u) {
    const double x = camera.Unproject(u, middle, 0.8).x();
    if (x > 0.006) {
      EXPECT_TRUE(opened(u, middle) == 0 || opened(u, middle) > 1.2f) << x;
    }
    if (x > -0.19 && x < -0.001) {
      EXPECT_NEAR(opened(u, middle), 0.8, 1e-6) << x;
    }
  }
}

TEST_P(DepthOpening, RadiusZeroAndEmptyRendering) {
  const PinholeCamera camera = KinectCamera(GetParam());
  const DepthImage scene = RenderDepth(Union(Bar(0, 0.004, 0.7), Wall(1)), camera, kOrigin);
  DepthOpeningOptions options;
  options.radius = 0;
  EXPECT_EQ(CountDifferences(OpenDepth(scene, camera, {}, options),
                             [&](int u, int v) { return scene(u, v); }),
            0);
  const DepthImage nothing(camera.width, camera.height, 0);
  EXPECT_EQ(CountDifferences(OpenDepth(nothing, camera, {}, {}), [](int, int) { return 0.0f; }), 0);
  EXPECT_THROW(OpenDepth(DepthImage(3, 3, 1), camera, {}, {}), Error);
}

INSTANTIATE_TEST_SUITE_P(Resolution, DepthOpening, ::testing::Values(0.5, 1.0),
                         [](const auto& test) { return test.param == 1 ? "Full" : "Half"; });

TEST(DepthOpeningOfVolume, RemovesTheWiresThatTheVolumeCaught) {
  const PinholeCamera camera = KinectCamera();
  const DepthAlongRay background = Union(Wall(1.2), Box({-0.35, -0.1, 0.7}, {-0.2, 0.25, 0.9}));
  const DepthAlongRay wires =
      Union(Box({-0.02, -1, 0.7}, {-0.008, 1, 0.712}), Box({-0.1, 0.1, 0.75}, {0.4, 0.11, 0.76}));
  TsdfVolume volume{TsdfOptions{}};
  for (int i = 0; i < 5; ++i) {
    const RigidTransform pose = LookAt({0.03 * i, 0.01 * i, 0}, {0, 0, 0.9});
    volume.Integrate(RenderDepth(Union(background, wires), camera, pose), camera, pose);
  }
  const PinholeCamera small = KinectCamera(0.5);
  const RigidTransform pose = LookAt({0.05, 0.02, 0}, {0, 0, 0.9});
  const DepthImage rendering = volume.Raycast(small, pose);
  const DepthImage opened = OpenDepth(rendering, small, {}, {});
  const DepthImage with_wires = RenderDepth(Union(background, wires), small, pose);
  const DepthImage without = RenderDepth(background, small, pose);
  int caught = 0, left = 0, kept = 0, lost = 0;
  for (int v = 0; v < small.height; ++v) {
    for (int u = 0; u < small.width; ++u) {
      const bool is_wire = with_wires(u, v) < without(u, v);
      if (is_wire) {
        caught += rendering(u, v) > 0 && rendering(u, v) < without(u, v) - 0.1;
        left += opened(u, v) > 0 && opened(u, v) < without(u, v) - 0.1;
      } else if (std::abs(rendering(u, v) - without(u, v)) < 0.01) {
        ++kept;
        lost += opened(u, v) == 0;
      }
    }
  }
  EXPECT_GT(caught, 1500);  // the volume does catch these wires
  EXPECT_EQ(left, 0);
  EXPECT_GT(kept, 60000);
  EXPECT_LT(lost, kept / 1000);  // the box's rounded corners
}

}  // namespace
}  // namespace curvefusion
