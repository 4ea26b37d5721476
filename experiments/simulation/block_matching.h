#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "kernel/image.h"
#include "kernel/options.h"

namespace curvefusion {

/// An image of non-negative intensities below 1024.
using IntensityImage = Image<int16_t>;

/// When a match counts. The matcher of the real chip is not public: these are choices. Of a 4 mm
/// wire at 0.7 m two thirds are recalled; .59 to .68 with seeds at .55 to .45, a quarter without
/// growing (tests/experiments/structured_light_test.cpp).
struct BlockMatchingOptions {
  double seed_correlation = 0.5;   ///< a pixel matched this well stands for itself
  double grow_correlation = 0.35;  ///< a neighbour of a matched pixel needs only this
  /// What the chip drops: components of fewer than `min_component` pixels whose disparities differ
  /// by at most `component_step` from one to the next. Fitted: in raw recordings of a Kinect V1 and
  /// a PrimeSense there are hardly any islands of fewer than about 220 pixels, and four times as
  /// many just above; with steps of .5 px a simulated frame has no small component at all, with 2
  /// px twice as many as real ones have.
  bool drop_small_components = true;
  int min_component = 220;
  double component_step = 1;  ///< px
};

void VisitOptions(BlockMatchingOptions& options, OptionVisitor& visitor);

/// Zero-mean normalised cross-correlation of 9x9 blocks of an image against a known reference:
/// the depth of structured light. Immutable and thread-safe once built.
class BlockMatcher {
 public:
  static constexpr int kMinDisparity = 8;
  static constexpr int kDisparities = 104;
  static constexpr int kSubpixels = 8;  ///< steps of 1/8 px

  /// `pattern(column, eighths, row)` is the reference at the position (column + eighths / 8, row),
  /// 0 to 1, such that an image pixel (u, v) with disparity d shows the reference at (u - d, v).
  /// Columns may be negative.
  using Pattern = std::function<double(int column, int eighths, int row)>;
  BlockMatcher(int width, int height, const Pattern& pattern, const BlockMatchingOptions& options);

  /// Disparity in pixels, in steps of 1/8; 0 where nothing matches, and where little does: see
  /// BlockMatchingOptions::drop_small_components. One thread; 640x480 takes about
  /// a fifth of a second.
  Image<float> Match(const IntensityImage& image) const;

 private:
  // One shifted copy of the reference. Column x of the images stands for pattern position
  // x - kMargin + shift.
  struct Reference {
    IntensityImage intensity;
    Image<int32_t> sum;  // over 9x9 blocks
    Image<float> scale;  // 1 / sqrt(81 sum of squares - square of sum); 0 for flat blocks
  };
  struct BlockMoments {
    Image<int32_t> sum;
    Image<float> scale;
  };
  struct Patch;

  static BlockMoments Moments(const IntensityImage& image);
  Image<int16_t> BestDisparities(const IntensityImage& image, const BlockMoments& moments) const;
  void Grow(const IntensityImage& image, const BlockMoments& moments,
            Image<int16_t>& disparities) const;
  float Correlation(const Patch& patch, int u, int v, int eighths) const;

  int width_;
  int height_;
  BlockMatchingOptions options_;
  std::vector<Reference> references_;  // shifted by 0/8 ... 7/8 px
  // Of references_[0], each row reversed: disparities of one pixel then lie side by side.
  IntensityImage reversed_intensity_;
  Image<int32_t> reversed_sum_;
  Image<float> reversed_scale_;
};

}  // namespace curvefusion
