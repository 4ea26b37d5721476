#include "fusion/nets/sheet_image.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"

namespace curvefusion {

namespace {

// Chosen on training scans chair 5, grid 5, mixture 3 and 5 and umbrella 5 (docs/nets.md).
constexpr double kBroad = 0.006;  // metres: what is broader is no wire
constexpr double kAround = 0.02;  // metres: light and what is behind change over more
constexpr double kMinClear = 2;   // times noise: 3.5 and more on nets, .6 on a wall with texture
constexpr float kFaint = 1e-6F;   // of a weight: as good as none

Image<float> StandsOut(const Image<float>& image, const MaskImage& known) {
  Image<float> out = MeanAround(image, known, kBroad / SheetImage::kStep);
  for (size_t i = 0; i < out.size(); ++i)
    out.data()[i] = known.data()[i] ? image.data()[i] - out.data()[i] : 0;
  return out;
}

// The weights of colours that predict where images agree, by least squares.
Vec3 ColoursThatAgree(const std::array<Image<float>, 3>& colours, const Image<float>& agreement) {
  Mat3 squares = Mat3::Identity();
  Vec3 products = Vec3::Zero();
  for (size_t i = 0; i < agreement.size(); ++i) {
    const Vec3 colour(colours[0].data()[i], colours[1].data()[i], colours[2].data()[i]);
    squares += colour * colour.transpose();
    products += agreement.data()[i] * colour;
  }
  return squares.ldlt().solve(products);
}

}  // namespace

Image<float> MeanAround(const Image<float>& image, const MaskImage& known, double sigma_px) {
  Image<float> mean = image, weights(known.width(), known.height());
  for (size_t i = 0; i < mean.size(); ++i) {
    weights.data()[i] = known.data()[i];
    mean.data()[i] *= weights.data()[i];
  }
  cv::GaussianBlur(MatOf(mean), MatOf(mean), {}, sigma_px);
  cv::GaussianBlur(MatOf(weights), MatOf(weights), {}, sigma_px);
  for (size_t i = 0; i < mean.size(); ++i) mean.data()[i] /= std::max(kFaint, weights.data()[i]);
  return mean;
}

SheetImage WiresOnSheet(const SheetColours& colours, const MaskImage& known, double noise) {
  SheetImage image;
  image.known = known;
  for (size_t i = 0; i < known.size(); ++i) image.known.data()[i] &= colours.change.data()[i] >= 0;
  image.wire = StandsOut(colours.change, image.known);
  for (size_t i = 0; i < image.wire.size(); ++i) image.wire.data()[i] *= -1;
  std::array<Image<float>, 3> stands_out;
  for (size_t k = 0; k < 3; ++k) stands_out[k] = StandsOut(colours.median[k], image.known);
  const Eigen::Vector3f weights = ColoursThatAgree(stands_out, image.wire).cast<float>();
  for (size_t i = 0; i < image.wire.size(); ++i)
    for (int k = 0; k < 3; ++k)
      image.wire.data()[i] += weights[k] * stands_out[static_cast<size_t>(k)].data()[i];
  Image<float> squares = image.wire;
  for (size_t i = 0; i < squares.size(); ++i) squares.data()[i] *= squares.data()[i];
  squares = MeanAround(squares, image.known, kAround / SheetImage::kStep);
  for (size_t i = 0; i < squares.size(); ++i) {
    const double usual = std::sqrt(squares.data()[i]);
    image.wire.data()[i] /= static_cast<float>(std::max({usual, kMinClear * noise, 1e-6}));
  }
  return image;
}

}  // namespace curvefusion
