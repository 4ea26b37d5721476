#include "fusion/appearance/wire_posterior.h"

#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "capture/image_mat.h"

namespace curvefusion {

namespace {

constexpr int kBins = 24;  // a channel; chosen: 10.7 grey levels, three times the noise of cameras
constexpr size_t kCells = static_cast<size_t>(kBins) * kBins * kBins;
constexpr double kBlurPx = 0.7;  // chosen: of the posterior, over 3 x 3 pixels
// Chosen: shares of pixels below which a colour counts as never seen. One that neither wires nor
// background have is wire with 1/6.
constexpr double kRareWire = 2e-6;
constexpr double kRareBackground = 1e-5;

// Shares of pixels, each bin's spread over its neighbours with weights 1 2 1 in each channel.
std::vector<double> SmoothShares(const std::vector<uint32_t>& counts) {
  const double total = std::max(1.0, std::accumulate(counts.begin(), counts.end(), 0.0));
  std::vector<double> shares(counts.begin(), counts.end());
  std::vector<double> smooth(kCells);
  for (const size_t stride : {size_t{1}, size_t{kBins}, size_t{kBins} * kBins}) {
    for (size_t i = 0; i < kCells; ++i) {
      const size_t position = i / stride % kBins;
      smooth[i] = 2 * shares[i] + (position > 0 ? shares[i - stride] : shares[i]) +
                  (position + 1 < kBins ? shares[i + stride] : shares[i]);
    }
    shares.swap(smooth);
  }
  for (double& share : shares) share /= 64 * total;
  return shares;
}

}  // namespace

ColourBins BinColours(const ColorImage& image) {
  ColourBins bins(image.width(), image.height());
  const Rgb* pixels = image.data();
  for (size_t i = 0; i < image.size(); ++i) {
    const int r = pixels[i][0] * kBins / 256;
    const int g = pixels[i][1] * kBins / 256;
    const int b = pixels[i][2] * kBins / 256;
    bins.data()[i] = static_cast<uint16_t>((r * kBins + g) * kBins + b);
  }
  return bins;
}

WireColourModel::WireColourModel() : wire_(kCells, 0), background_(kCells, 0) {}

void WireColourModel::Add(const WireColourModel& other) {
  for (size_t i = 0; i < kCells; ++i) {
    wire_[i] += other.wire_[i];
    background_[i] += other.background_[i];
  }
}

std::vector<uint8_t> WireColourModel::Posterior() const {
  const std::vector<double> wire = SmoothShares(wire_);
  const std::vector<double> background = SmoothShares(background_);
  std::vector<uint8_t> posterior(kCells);
  for (size_t i = 0; i < kCells; ++i) {
    const double w = wire[i] + kRareWire;
    posterior[i] =
        static_cast<uint8_t>(std::lround(255 * w / (w + background[i] + kRareBackground)));
  }
  return posterior;
}

PosteriorImage ApplyPosterior(const ColourBins& bins, const std::vector<uint8_t>& posterior) {
  PosteriorImage raw(bins.width(), bins.height());
  for (size_t i = 0; i < bins.size(); ++i) raw.data()[i] = posterior[bins.data()[i]];
  PosteriorImage image(bins.width(), bins.height());
  cv::GaussianBlur(MatOf(raw), MatOf(image), cv::Size(3, 3), kBlurPx);
  return image;
}

}  // namespace curvefusion
