#include "kernel/camera.h"

#include <gtest/gtest.h>

namespace curvefusion {
namespace {

const PinholeCamera kCamera{640, 480, 580, 590, 319.5, 239.5};

TEST(PinholeCamera, UnprojectInvertsProject) {
  const Vec3 p(0.1, -0.2, 0.9);
  const Vec2 pixel = kCamera.Project(p);
  EXPECT_LT((kCamera.Unproject(pixel.x(), pixel.y(), 0.9) - p).norm(), 1e-12);
}

TEST(PinholeCamera, HalfSizeSeesThePointAtTheSamePlaceOfTheImage) {
  const Vec3 p(0.1, -0.2, 0.9);
  const Vec2 full = kCamera.Project(p);
  const Vec2 half = kCamera.Scaled(0.5).Project(p);
  // Relative to the image's corner, half a pixel up and left of the first pixel's centre.
  EXPECT_NEAR((half.x() + 0.5) * 2, full.x() + 0.5, 1e-12);
  EXPECT_NEAR((half.y() + 0.5) * 2, full.y() + 0.5, 1e-12);
}

TEST(PinholeCamera, ContainsPixelsThatRoundIntoTheImage) {
  EXPECT_TRUE(kCamera.Contains({-0.4, 479.4}));
  EXPECT_FALSE(kCamera.Contains({-0.6, 0}));
  EXPECT_FALSE(kCamera.Contains({639.5, 0}));
}

}  // namespace
}  // namespace curvefusion
