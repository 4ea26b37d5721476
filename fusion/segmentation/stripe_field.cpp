#include "fusion/segmentation/stripe_field.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"

namespace curvefusion {

namespace {

// Chosen, of the derivatives: above pixels' noise, and below half the distance of the nearest
// stripes.
constexpr double kSigmaPx = 1.2;
// Chosen, of the extremum from the pixel's middle: a bit more than half, so that oblique lines hold
// together.
constexpr float kReachPx = 0.7f;
// Chosen: second derivative, 1/px^2, from which a stripe stands out. That of a line with a contrast
// of 1 is about 0.3.
constexpr float kLeastCurvature = 0.02f;

}  // namespace

StripeField::StripeField(const PosteriorImage& posterior)
    : smooth_(posterior.width(), posterior.height()) {
  cv::Mat to = MatOf(smooth_);
  MatOf(posterior).convertTo(to, CV_32F, 1 / 255.0);
  cv::GaussianBlur(to, to, cv::Size(), kSigmaPx);
}

StripePixel StripeField::At(int u, int v) const {
  if (u < 1 || v < 1 || u + 1 >= smooth_.width() || v + 1 >= smooth_.height()) return {};
  const float* up = smooth_.row(v - 1) + u;
  const float* at = smooth_.row(v) + u;
  const float* down = smooth_.row(v + 1) + u;
  const float gradient_u = (at[1] - at[-1]) / 2, gradient_v = (down[0] - up[0]) / 2;
  const float uu = at[1] + at[-1] - 2 * at[0], vv = down[0] + up[0] - 2 * at[0];
  const float uv = (down[1] - down[-1] - up[1] + up[-1]) / 4;
  // The direction across is that of the stronger curvature of the two principal ones.
  const float mean = (uu + vv) / 2, half = (uu - vv) / 2;
  const float root = std::hypot(half, uv);
  const float curvature = mean > 0 ? mean + root : mean - root;
  const float angle = 0.5f * (mean > 0 ? std::atan2(uv, half) : std::atan2(-uv, -half));
  StripePixel pixel{StripePart::kFlank, {std::cos(angle), std::sin(angle)}};
  const auto slope = std::abs(gradient_u * pixel.normal.x() + gradient_v * pixel.normal.y());
  if (std::abs(curvature) < kLeastCurvature) {
    if (slope <= kReachPx * kLeastCurvature) pixel.part = StripePart::kPlateau;
  } else if (slope <= kReachPx * std::abs(curvature)) {
    pixel.part = curvature < 0 ? StripePart::kCrest : StripePart::kValley;
  }
  return pixel;
}

}  // namespace curvefusion
