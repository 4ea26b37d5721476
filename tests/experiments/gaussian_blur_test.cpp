#include "experiments/simulation/gaussian_blur.h"

#include <gtest/gtest.h>

#include "kernel/geometry.h"

namespace curvefusion {
namespace {

// A dot becomes the product of a Gaussian along rows and one along columns, in its channel alone.
TEST(GaussianBlur, SpreadsADot) {
  constexpr double kSigma = 0.9;
  Image<Vec3f> image(21, 15, Vec3f::Zero());
  image(10, 7) = Vec3f(0, 2, 0);
  BlurByGaussian(image, kSigma);
  Vec3f sum = Vec3f::Zero();
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      sum += image(u, v);
      const double square = (u - 10) * (u - 10) + (v - 7) * (v - 7);
      if (std::abs(u - 10) > 3 || std::abs(v - 7) > 3) {
        EXPECT_EQ(image(u, v), Vec3f::Zero());
      } else {
        EXPECT_NEAR(image(u, v).y() / image(10, 7).y(), std::exp(-square / (2 * kSigma * kSigma)),
                    1e-6);
      }
    }
  }
  EXPECT_NEAR(sum.y(), 2, 1e-5);
  EXPECT_EQ(sum.x(), 0);
  EXPECT_EQ(sum.z(), 0);
}

// In a corner too: what lies beyond an edge is as the edge.
TEST(GaussianBlur, LeavesWhatIsEvenAsItIs) {
  Image<Vec3f> image(5, 4, Vec3f(1, 2, 3));
  BlurByGaussian(image, 2);
  for (size_t i = 0; i < image.size(); ++i) {
    EXPECT_LT((image.data()[i] - Vec3f(1, 2, 3)).norm(), 1e-5);
  }
}

}  // namespace
}  // namespace curvefusion
