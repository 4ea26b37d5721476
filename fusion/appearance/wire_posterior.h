#pragma once

#include <cstdint>
#include <vector>

#include "kernel/image.h"

namespace curvefusion {

/// The colours of an image as bins of a 24^3 histogram.
using ColourBins = Image<uint16_t>;
ColourBins BinColours(const ColorImage& image);

/// How likely a pixel is to show wire, 0 to 255.
using PosteriorImage = Image<uint8_t>;

/// Colour histograms of wire and of the background next to it.
class WireColourModel {
 public:
  WireColourModel();

  void AddWire(uint16_t bin) { ++wire_[bin]; }
  void AddBackground(uint16_t bin) { ++background_[bin]; }
  void Add(const WireColourModel& other);

  /// The probability of wire for the colour of every bin, as likely as background beforehand, 0 to
  /// 255; colours never seen are background.
  std::vector<uint8_t> Posterior() const;

 private:
  std::vector<uint32_t> wire_;
  std::vector<uint32_t> background_;
};

/// Looks the posterior up for every pixel and blurs it a little (sigma .7 px), so that pixels'
/// noise does not decide.
PosteriorImage ApplyPosterior(const ColourBins& bins, const std::vector<uint8_t>& posterior);

}  // namespace curvefusion
