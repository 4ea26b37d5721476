#pragma once

#include <array>
#include <cstdint>

#include "kernel/geometry.h"
#include "kernel/image.h"

namespace curvefusion {

/// How far it is to the nearest edge of a colour image, by the direction of the edge.
class EdgeDistance {
 public:
  static constexpr int kDirections = 4;
  static constexpr double kFarthest =
      20;  ///< pixels of a 640 px wide image; what is farther is as far

  /// A distance and its derivatives by the pixel.
  struct Sample {
    double distance = 0;
    double du = 0;
    double dv = 0;
  };

  EdgeDistance() = default;
  /// Finds the edges at about 320 px width: the strongest fifth of the gradients, at least 3 grey
  /// levels a pixel, thinned along the gradient. About 3 ms an image.
  explicit EdgeDistance(const ColorImage& image);

  /// The direction that a normal angle (radians) belongs to.
  static int DirectionOf(double angle);

  /// Whether Nearest and Interpolated may be asked about a pixel of the image.
  bool Contains(const Vec2& pixel) const;
  /// The distance at the nearest place known, in pixels of a 640 px wide image.
  double Nearest(const Vec2& pixel, int direction) const;
  /// The same between places, with derivatives by pixels of the image.
  Sample Interpolated(const Vec2& pixel, int direction) const;

  double edge_share() const { return edge_share_; }  ///< of the places

 private:
  double divisor_ = 1;  // of the image's size
  double unit_ = 1;     // of a stored distance, in pixels of a 640 px wide image
  double edge_share_ = 0;
  std::array<Image<uint8_t>, kDirections> distances_;
};

}  // namespace curvefusion
