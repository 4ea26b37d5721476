#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "fusion/curve_graph/strip_middles.h"
#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// How many images look at a place, and how many of them show the middle of a strip there.
struct StripAgreement {
  static constexpr int kMinLooks = 8;  ///< images; chosen: fewer tell no share
  /// Chosen: what an image tells counts so much, as neighbouring ones tell the same.
  static constexpr double kCorrelation = 0.3;

  int looked = 0;
  int seen = 0;
  double evidence = 0;         // logarithm of how much likelier that is for a wire than by chance
  double middle_evidence = 0;  // likewise, of how near the strips' middles are

  double Sum() const { return evidence + middle_evidence; }

  /// Where every so many-th image was asked: what they tell all together.
  StripAgreement Weighted(size_t stride) const;
};

/// Where places lie in one image, and 1 if it looks at them. The others' pixels are of no account,
/// but in the image.
struct LookedAt {
  explicit LookedAt(size_t count) : u(count), v(count), is_open(count) {}
  std::vector<int> u, v, is_open;
};

/// Strips in one image: how far every pixel is from the nearest, which way that runs, and what it
/// tells to find one there. Curves explain the strips along them.
class StripImage {
 public:
  /// How near the middle of a strip must be in a look, pixels.
  enum Look { kFirstLook, kCloseLook };
  static constexpr double kReachPx[2] = {3.5, 1.4};  // chosen like those of strip_image.cpp

  StripImage() = default;

  /// `strips` were found in a part of an image; there are none elsewhere. No curve is known yet.
  StripImage(int width, int height, const cv::Rect& part, const StripPixels& strips);

  /// Whether a curve covers a pixel.
  bool IsExplained(int u, int v) const { return to_strip_(u, v) == kExplained; }

  /// Whether the middle of a strip is within reach of a pixel that is not explained.
  bool IsSeen(Look look, int u, int v) const { return to_strip_(u, v) <= ReachUnits(look); }

  /// Which way the nearest strip runs, see DirectionUnits.
  uint8_t DirectionOfStrip(int u, int v) const { return direction_(u, v); }

  /// What a strip within reach of a pixel tells, or none: the logarithm of how much likelier that
  /// is for a wire than by chance, by the share of pixels around that have a strip within reach.
  double Evidence(Look look, bool is_seen, int u, int v) const {
    return kEvidence[around_[look](u / kCellPx, v / kCellPx)][is_seen];
  }

  /// The same of how near the middle of a strip within close reach is.
  double MiddleEvidence(int u, int v) const { return kMiddleEvidence[to_strip_(u, v)]; }

  /// Adds what the image tells of places, where no curve covers it.
  void AddTo(Look look, const LookedAt& places, std::vector<StripAgreement>& agreements) const;

  /// Some middles of strips that no curve covered when strips were last found.
  const std::vector<Eigen::Vector2i>& unexplained() const { return unexplained_; }

  /// A curve covers the line from one pixel to another.
  void Explain(const Eigen::Vector2i& from, const Eigen::Vector2i& to, int width_px);

  /// Strips that curves cover do not count as chance any more, nor as the nearest.
  void DropExplained();

 private:
  static constexpr double kDistanceUnits = 16;  // in a pixel; derived: 15 pixels fit into a byte
  static constexpr uint8_t kExplained = 255;  // in place of a distance; derived: the greatest byte
  static constexpr int kCellPx = 4;           // chosen: chance is averaged over several cells
  static constexpr int kAroundCells = 9;      // chosen like those of strip_image.cpp
  static constexpr int kAroundPixels = kAroundCells * kAroundCells * kCellPx * kCellPx;
  static const std::array<double, kExplained + 1> kMiddleEvidence;  // by units
  // Without a strip and with one, by the number of pixels around.
  static const std::array<std::array<float, 2>, kAroundPixels + 1> kEvidence;

  static constexpr int ReachUnits(Look look) {
    return static_cast<int>(kReachPx[look] * kDistanceUnits);
  }
  void SetStrips(const StripPixels& strips);
  void SetNearest(const StripPixels& strips);
  void SetEvidence(Look look);

  cv::Rect part_;
  Image<uint8_t> to_strip_;    // units, less than kExplained where no curve covers a pixel
  Image<uint8_t> direction_;   // of the nearest strip
  Image<uint16_t> around_[2];  // in cells: how many pixels around have a strip within reach
  std::vector<Eigen::Vector2i> unexplained_;
};

}  // namespace curvefusion
