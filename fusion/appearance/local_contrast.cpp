#include "fusion/appearance/local_contrast.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "capture/image_mat.h"
#include "kernel/quantile.h"

namespace curvefusion {

namespace {

constexpr double kBlurPx = 0.8;  // chosen: as for strips (strip_middles.cpp)
// Derived: a strip is blurred by 2 px on either side and fills less than half of a window that
// reaches this much farther than it is wide.
constexpr double kBlurredPx = 4;
constexpr double kWidestPx = 100;  // chosen: what is wider is nothing thin
constexpr double kLeast = 10;      // grey levels; cameras' noise comes to 3
// Chosen: so many times the usual distance is as likely wire as not.
constexpr double kOutstanding = 2.5;
constexpr size_t kEvery = 17;  // so many-th pixel tells what is usual

}  // namespace

PosteriorImage LocalContrast(const ColorImage& image, double strip_px) {
  const cv::Mat pixels = MatOf(image);
  cv::Mat smooth, some_pixels, around;
  cv::GaussianBlur(pixels, smooth, cv::Size(5, 5), kBlurPx);
  // The median of every second pixel of every second row is the same but for noise.
  cv::resize(smooth, some_pixels, {(image.width() + 1) / 2, (image.height() + 1) / 2}, 0, 0,
             cv::INTER_NEAREST);
  const double reach_px = std::min(strip_px, kWidestPx) + kBlurredPx;
  cv::medianBlur(some_pixels, around, 2 * static_cast<int>(std::ceil(reach_px / 2)) + 1);
  Image<float> distances(image.width(), image.height());
  for (int v = 0; v < image.height(); ++v) {
    const auto* colours = smooth.ptr<cv::Vec3b>(v);
    const auto* usual = around.ptr<cv::Vec3b>(v / 2);
    for (int u = 0; u < image.width(); ++u)
      distances(u, v) =
          static_cast<float>(cv::norm(cv::Vec3f(colours[u]) - cv::Vec3f(usual[u / 2])));
  }
  std::vector<double> some;
  for (size_t i = 0; i < distances.size(); i += kEvery) some.push_back(distances.data()[i]);
  const double even = std::max(kLeast, kOutstanding * Median(std::move(some)));
  PosteriorImage contrast(image.width(), image.height());
  for (size_t i = 0; i < distances.size(); ++i) {
    const double square = distances.data()[i] * distances.data()[i];
    contrast.data()[i] = static_cast<uint8_t>(255 * square / (square + even * even));
  }
  return contrast;
}

}  // namespace curvefusion
