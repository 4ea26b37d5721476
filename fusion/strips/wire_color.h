#pragma once

#include <Eigen/Core>
#include <vector>

#include "fusion/strips/strip_profile.h"

namespace curvefusion {

/// A strip whose width is about known.
struct ColoredStrip {
  int frame = 0;  ///< in sequence.frames
  double width_px = 0;
  StripColors colors;
};

/// The colour of a wire: light and shade move it along one line through black.
struct WireColor {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, in RGB
  double shade = 0;                                     ///< usual length, grey levels
  double shade_spread = 0;  ///< how much that varies from strip to strip
};

/// How images are blurred, as standard deviations in pixels. Chroma (colour differences) is blurred
/// more than luma where JPEG stores it at half resolution.
struct ImageBlur {
  double luma_px = 0.95;   ///< measured on simulated scans
  double chroma_px = 1.4;  ///< where strips are too alike to calibrate it
};

/// The colour at the centre of a strip without what the blur mixed in from the background.
Eigen::Vector3d UnblurredCenter(const ColoredStrip& strip, const ImageBlur& blur);

/// The chroma blur at which wide and narrow strips of the same wires have the same colour, between
/// luma_px and 2.5 px; `blur.chroma_px` where there are too few strips, or all equally wide.
double CalibrateChromaBlur(const std::vector<ColoredStrip>& strips, const ImageBlur& blur);

/// The colour most strips agree on. At least one strip.
WireColor EstimateWireColor(const std::vector<ColoredStrip>& strips, const ImageBlur& blur);

/// How what a strip of that width takes away varies about its mean: by the wire's shade and because
/// the background is not straight.
Eigen::Matrix3d MassCovariance(double width_px, const WireColor& color);

/// A width and how far it can be trusted.
struct SolvedWidth {
  double width_px = 0;
  double significance = 0;  ///< width over its standard deviation
  double misfit = 0;        ///< Mahalanobis length of what no width explains
  Eigen::Vector3d weights;  ///< the direction in colour space that tells wire from background
};

/// The width of a strip of known colour: its mass is width times (background - wire colour) where
/// the shade of the wire is only known to lie around its usual value. Generalised least squares.
SolvedWidth SolveWidth(const ColoredStrip& strip, const WireColor& color);

}  // namespace curvefusion
